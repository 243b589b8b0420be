// A frame as it was before anything moved.
#pragma once

#include "io/frame.hpp"

namespace scarp::render {

/// The same points and columns at `position` - `displacement`; the columns are not changed.  Throws
/// std::runtime_error if there is no displacement.
io::Frame undeformed(const io::Frame& frame);

} // namespace scarp::render

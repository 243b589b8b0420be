// What the passes between points and nodes are asked for, and what they report.
#pragma once

#include "core/particles.hpp"

namespace scarp {

/// Of the scatter pass.
enum class Terms { mass_momentum, force, all };

/// By the gather pass.
struct Gathered {
  Real fastest = 0.0; ///< m/s, largest |v_p| and |dx_p / dt|
  /// The first point, in the order of creation, whose new position lies outside the grid or is not
  /// a number.
  std::uint32_t outside = no_point;
};

} // namespace scarp

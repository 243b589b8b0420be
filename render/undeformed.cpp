#include "render/undeformed.hpp"

#include <cstddef>

namespace scarp::render {

io::Frame undeformed(const io::Frame& frame) {
  const std::vector<double>& u = frame.column("displacement").values;
  io::Frame first = frame;
  for (std::size_t i = 0; i < first.position.size(); ++i) first.position[i] -= u[i];
  return first;
}

} // namespace scarp::render

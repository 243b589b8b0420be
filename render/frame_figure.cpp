#include "render/frame_figure.hpp"

#include "render/body.hpp"
#include "render/multi_panel.hpp"
#include "render/solid_figure.hpp"

#include <algorithm>
#include <stdexcept>

namespace scarp::render {

Box united(const Box& a, const Box& b) {
  return {{std::min(a.lower.x, b.lower.x), std::min(a.lower.y, b.lower.y)},
          {std::max(a.upper.x, b.upper.x), std::max(a.upper.y, b.upper.y)}};
}

Box body_view(const io::Frame& frame) {
  const Point lower = {frame.lower[0], frame.lower[2]};
  Point upper = lower;
  const std::vector<std::size_t> thrown = thrown_off(frame);
  auto next_thrown = thrown.begin();
  for (std::size_t p = 0; p < frame.size(); ++p) {
    if (next_thrown != thrown.end() && *next_thrown == p) {
      ++next_thrown;
      continue;
    }
    upper.x = std::max(upper.x, frame.position[3 * p]);
    upper.y = std::max(upper.y, frame.position[3 * p + 2]);
  }
  constexpr double air = 0.04; // of the body's length and height
  upper.x = std::min(upper.x + air * (upper.x - lower.x), frame.upper[0]);
  upper.y = std::min(upper.y + 2.0 * air * (upper.y - lower.y), frame.upper[2]);
  return {lower, upper};
}

Box common_view(std::span<const io::Frame> frames) {
  if (frames.empty()) return {};
  Box view = body_view(frames.front());
  for (const io::Frame& frame : frames.subspan(1)) view = united(view, body_view(frame));
  return view;
}

Image render_frame(const io::Frame& frame, const FrameStyle& style) {
  if (frame.dimension == 3) return render_solid(frame, style);
  return render_panels({&frame, 1}, style);
}

} // namespace scarp::render

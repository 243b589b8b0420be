#include "render/multi_panel.hpp"

#include "render/body_layer.hpp"
#include "render/panel_layout.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>

namespace scarp::render {

Drawing draw_panels(std::span<const io::Frame> frames, const FrameStyle& style) {
  if (frames.empty()) throw std::invalid_argument("a figure without frames");
  PanelContent content =
      panel_content(style, style.view ? *style.view : common_view(frames), frames.size());
  const ColourRange range =
      style.range ? *style.range : common_range(frames, style.field, style.bands);
  content.bars = {{range, style.colours, field_label(frames.front(), style.field),
                   field_unit(style.field), is_category(style.field)}};
  const PanelLayout layout = panel_layout(content, style.width, style.height);
  Drawing drawing(style.width, layout.height);
  for (std::size_t panel = 0; panel < frames.size(); ++panel) {
    const PlotArea area = {content.view, layout.areas[panel]};
    draw_body(drawing, area, frames[panel], style, range);
    draw_panel_frame(drawing, content, layout, panel,
                     fmt::format("t = {:.{}f} s", frames[panel].time, style.time_digits));
    draw_ground(drawing, area, frames[panel], content.font_size);
  }
  draw_panel_surroundings(drawing, content, layout, style.title);
  return drawing;
}

Image render_panels(std::span<const io::Frame> frames, const FrameStyle& style) {
  return rasterize(draw_panels(frames, style));
}

} // namespace scarp::render

#include "render/field_panels.hpp"

#include "render/body_layer.hpp"
#include "render/panel_layout.hpp"

#include <cstddef>
#include <stdexcept>

namespace scarp::render {

Drawing draw_field_panels(const io::Frame& frame, const std::vector<FieldPanel>& fields,
                          const FrameStyle& style) {
  if (fields.empty()) throw std::invalid_argument("a figure without fields");
  PanelContent content =
      panel_content(style, style.view ? *style.view : body_view(frame), fields.size());
  for (const FieldPanel& panel : fields)
    content.bars.push_back(
        {panel.range ? *panel.range : common_range({&frame, 1}, panel.field, style.bands),
         panel.colours, field_label(frame, panel.field), field_unit(panel.field),
         is_category(panel.field)});
  const PanelLayout layout = panel_layout(content, style.width, style.height);
  Drawing drawing(style.width, layout.height);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const PlotArea area = {content.view, layout.areas[i]};
    const ColourBar& bar = content.bars[i];
    FrameStyle own = style;
    own.field = fields[i].field;
    own.colours = bar.colours;
    draw_body(drawing, area, frame, own, bar.range);
    draw_panel_frame(drawing, content, layout, i,
                     fields[i].title.empty() ? bar.label : fields[i].title);
    draw_ground(drawing, area, frame, content.font_size);
  }
  draw_panel_surroundings(drawing, content, layout, style.title);
  return drawing;
}

Image render_field_panels(const io::Frame& frame, const std::vector<FieldPanel>& fields,
                          const FrameStyle& style) {
  return rasterize(draw_field_panels(frame, fields, style));
}

} // namespace scarp::render

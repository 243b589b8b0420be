#include "render/line_chart.hpp"

#include "render/chart_panels.hpp"

#include <stdexcept>

namespace scarp::render {

Drawing draw_chart(const std::vector<Curve>& curves, const ChartStyle& style) {
  if (style.height <= 0 && !style.equal_scales)
    throw std::invalid_argument("a chart's height follows from its width only with equal scales");
  const ChartPanelsStyle alone = {.columns = 1,
                                  .letters = false,
                                  .width = style.width,
                                  .height = style.height,
                                  .font_size = style.font_size};
  return draw_chart_panels({{curves, style}}, alone);
}

Image render_chart(const std::vector<Curve>& curves, const ChartStyle& style) {
  return rasterize(draw_chart(curves, style));
}

} // namespace scarp::render

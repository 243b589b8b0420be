#include "render/chart_panels.hpp"

#include "render/chart_layer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace scarp::render {

namespace {

// In parts of the font's size.
constexpr double chart_edge = 0.7;
constexpr double chart_heading = 2.0; // the line of a title
constexpr double legend_gap = 0.8;

struct Panels {
  const std::vector<Chart>& charts;
  const ChartPanelsStyle& style;
  double font;
  std::size_t columns;
  std::size_t rows;
  bool titled = false;
  std::vector<Box> limits = {};     ///< of each chart
  std::vector<Legend> legends = {}; ///< of each chart
  Legend shared = {};               ///< empty if there is none
};

struct Layout {
  int height = 0; ///< px
  std::vector<PlacedChart> charts;
  std::vector<Point> corners; ///< lower left, px, of each chart's cell
};

/// Height of a plot by its width, where the picture's height is free.
double aspect(const Panels& panels) {
  constexpr double usual = 0.75;
  double equal = 0.0;
  for (std::size_t i = 0; i < panels.charts.size(); ++i)
    if (panels.charts[i].style.equal_scales)
      equal = std::max(equal, panels.limits[i].height() / panels.limits[i].width());
  return equal > 0.0 ? equal : usual;
}

/// `below` is the room for legends below the plots, px.
Layout layout(const Panels& panels, double below) {
  const ChartPanelsStyle& style = panels.style;
  const double font = panels.font;
  const auto rows = static_cast<double>(panels.rows);
  const double cell_width = style.width / static_cast<double>(panels.columns);
  const double below_all =
      panels.shared.empty() ? 0.0
                            : legend_size(panels.shared, font).y + (chart_edge + legend_gap) * font;
  double cell_height = style.height / rows;
  Point lower; // of a plot in its cell
  Point size = {0.85 * cell_width, 0.8 * std::max(cell_height, cell_width / 4.0)};
  Layout plan;
  // Margins depend on ticks, ticks on the size: the second round corrects, the third places.
  for (int round = 0;; ++round) {
    Margins margins;
    plan.charts.clear();
    plan.corners.clear();
    for (std::size_t i = 0; i < panels.charts.size(); ++i) {
      const std::size_t column = i % panels.columns;
      const std::size_t rows_below = panels.rows - 1 - i / panels.columns;
      const Point corner = {static_cast<double>(column) * cell_width,
                            below_all + static_cast<double>(rows_below) * cell_height};
      const Point from = {corner.x + lower.x, corner.y + lower.y};
      plan.corners.push_back(corner);
      plan.charts.push_back(place_chart(panels.charts[i], panels.limits[i], panels.legends[i],
                                        {from, {from.x + size.x, from.y + size.y}}, font));
      const Margins own = axis_margins(plan.charts[i].x, plan.charts[i].y, font);
      margins = {std::max(margins.left, own.left), std::max(margins.right, own.right),
                 std::max(margins.bottom, own.bottom), std::max(margins.top, own.top)};
    }
    if (round == 2) return plan;
    const double above = margins.top + (chart_edge + (panels.titled ? chart_heading : 0.0)) * font;
    lower = {margins.left + chart_edge * font, margins.bottom + chart_edge * font + below};
    size.x = cell_width - lower.x - std::max(chart_edge * font, margins.right + 0.7 * font);
    plan.height = style.height;
    if (style.height == 0) {
      const double needed = rows * (lower.y + above + size.x * aspect(panels)) + below_all;
      plan.height = 2 * static_cast<int>(std::ceil(0.5 * needed));
    }
    cell_height = (plan.height - below_all) / rows;
    size.y = cell_height - lower.y - above;
    if (!(size.x > 4.0 * font) || !(size.y > 2.0 * font))
      throw std::invalid_argument(fmt::format("a picture of {} x {} px leaves no room for curves",
                                              style.width, plan.height));
  }
}

/// Legends that find no free corner go below their plots.
Layout layout_with_legends(Panels& panels) {
  const double font = panels.font;
  for (double below = 0.0;;) {
    Layout plan = layout(panels, below);
    double needed = 0.0;
    for (std::size_t i = 0; i < plan.charts.size(); ++i) {
      Legend& legend = panels.legends[i];
      PlacedChart& chart = plan.charts[i];
      legend.below = legend.below || !chart.legend_box;
      if (legend.empty() || !legend.below) continue;
      const Point size = legend_size(legend, font);
      needed = std::max(needed, size.y + legend_gap * font);
      const Box& plot = chart.area.pixels;
      const double left = 0.5 * (plot.lower.x + plot.upper.x - size.x);
      const double top = plan.corners[i].y + (chart_edge - legend_gap) * font + below;
      chart.legend_box = Box{{left, top - size.y}, {left + size.x, top}};
    }
    if (needed <= below) return plan;
    below = needed;
  }
}

/// Takes the entries out of the charts' legends, each label once, and the notes if all have the
/// same.
Legend shared_legend(std::vector<Legend>& legends, double width, double font) {
  Legend shared;
  shared.below = true;
  for (Legend& legend : legends) {
    for (const LegendEntry& entry : legend.entries)
      if (std::none_of(shared.entries.begin(), shared.entries.end(),
                       [&](const LegendEntry& known) { return known.label == entry.label; }))
        shared.entries.push_back(entry);
    legend.entries.clear();
  }
  if (std::ranges::all_of(
          legends, [&](const Legend& legend) { return legend.notes == legends.front().notes; })) {
    shared.notes = legends.front().notes;
    for (Legend& legend : legends) legend.notes.clear();
  }
  spread(shared, width - 2.0 * chart_edge * font, font);
  return shared;
}

void write_title(Drawing& drawing, const Panels& panels, const Layout& plan, std::size_t i) {
  const Box& plot = plan.charts[i].area.pixels;
  const std::string& title = panels.charts[i].style.title;
  const double font = panels.font;
  const double cell_width = drawing.width / static_cast<double>(panels.columns);
  Words words;
  words.position = {plot.lower.x, plot.upper.y + 0.8 * font};
  if (panels.style.letters) {
    words.text =
        fmt::format("{}){}{}", static_cast<char>('a' + i), title.empty() ? "" : "  ", title);
    const double room = plan.corners[i].x + cell_width - plot.lower.x - chart_edge * font;
    words.size = fitting_size(words.text, room, 1.08 * font);
  } else {
    words.text = title;
    words.size = fitting_size(title, cell_width - chart_edge * font, 1.2 * font);
    words.horizontal = Horizontal::centre;
    words.position.x = 0.5 * (plot.lower.x + plot.upper.x);
  }
  if (!words.text.empty()) drawing.write(words);
}

} // namespace

Drawing draw_chart_panels(const std::vector<Chart>& charts, const ChartPanelsStyle& style) {
  constexpr std::size_t letters = 26;
  if (charts.empty() || charts.size() > letters)
    throw std::invalid_argument(fmt::format("{} charts in one figure; 1 to 26 go", charts.size()));
  if (style.columns < 1) throw std::invalid_argument("a figure needs at least one column");
  const auto columns = std::min(static_cast<std::size_t>(style.columns), charts.size());
  const double font =
      style.font_size > 0.0 ? style.font_size : default_font_size(style.width, style.height);
  Panels panels = {charts, style, font, columns, (charts.size() + columns - 1) / columns};
  for (const Chart& chart : charts) {
    panels.limits.push_back(chart_limits(chart));
    panels.legends.push_back(chart_legend(chart));
    panels.titled = panels.titled || style.letters || !chart.style.title.empty();
  }
  if (style.shared_legend) panels.shared = shared_legend(panels.legends, style.width, font);

  const Layout plan = layout_with_legends(panels);
  Drawing drawing(style.width, plan.height);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const PlacedChart& placed = plan.charts[i];
    draw_placed(drawing, charts[i], placed, font);
    if (placed.legend_box) draw_legend(drawing, panels.legends[i], *placed.legend_box, font);
    write_title(drawing, panels, plan, i);
  }
  if (!panels.shared.empty()) {
    const Point size = legend_size(panels.shared, font);
    const double left = 0.5 * (style.width - size.x);
    const double low = chart_edge * font;
    draw_legend(drawing, panels.shared, {{left, low}, {left + size.x, low + size.y}}, font);
  }
  return drawing;
}

Image render_chart_panels(const std::vector<Chart>& charts, const ChartPanelsStyle& style) {
  return rasterize(draw_chart_panels(charts, style));
}

} // namespace scarp::render

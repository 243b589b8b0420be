#include "render/panel_layout.hpp"

#include "render/frame_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scarp::render {

namespace {

// In parts of the font's size.
constexpr double panel_edge = 0.7;    // between the picture's sides and anything
constexpr double panel_heading = 1.7; // the line with letter and time above a panel
constexpr double panel_gap = 0.5;     // below a panel's ticks
constexpr double bar_gap = 0.9;

Axis x_axis(bool labelled) { return {"x", "m", labelled, {}}; }
Axis z_axis(bool labelled) { return {"z", "m", labelled, {}}; }

/// Bars below every panel part its axis from the panel under it.
bool has_x_labels(const PanelContent& content, bool upright_bars, std::size_t panel) {
  return panel + content.columns >= content.panels || (content.own_bars() && !upright_bars);
}

bool has_z_labels(const PanelContent& content, std::size_t panel) {
  return panel % content.columns == 0;
}

/// A bar below panels from `left` to `right` that hangs from `top`.
Box hanging_bar(double left, double right, double top, double thickness, double font) {
  constexpr double part = 0.7;
  const double width = std::min(right - left, std::max(part * (right - left), 16.0 * font));
  const double from = 0.5 * (left + right - width);
  return {{from, top - thickness}, {from + width, top}};
}

PanelLayout layout(const PanelContent& content, int width, int height, bool upright_bars) {
  const double font = content.font_size;
  double thickness = 0.0;
  for (const ColourBar& bar : content.bars)
    thickness = std::max(thickness, bar_thickness(bar, upright_bars, font));
  const double bar_room = bar_gap * font + thickness;
  const bool beside_each = content.own_bars() && upright_bars;
  const bool below_each = content.own_bars() && !upright_bars;
  const auto rows = static_cast<double>(content.rows());
  const auto columns = static_cast<double>(content.columns);
  PanelLayout plan;
  plan.upright_bars = upright_bars;
  // Margins depend on the ticks, ticks on the size: one correction is enough.
  const double guess = 0.8 * width / columns;
  PlotArea area = {content.view,
                   {{0, 0}, {guess, guess * content.view.height() / content.view.width()}}};
  for (int round = 0; round < 2; ++round) {
    Axis x = x_axis(true);
    Axis z = z_axis(true);
    choose_ticks(area, x, z, font);
    const Margins margins = axis_margins(x, z, font);
    const Margins unlabelled = axis_margins(x_axis(false), z_axis(false), font);
    const double left = panel_edge * font + margins.left;
    const double beside = std::max(panel_edge * font, margins.right + 0.7 * font);
    const double right = beside + (upright_bars ? bar_room : 0.0);
    const double column_gap =
        beside + (beside_each ? bar_room : 0.0) + unlabelled.left + panel_gap * font;
    const double below = panel_edge * font + margins.bottom + (upright_bars ? 0.0 : bar_room);
    const double above = panel_edge * font + (content.titled ? 1.8 * font : 0.0);
    const double row_gap =
        panel_gap * font + (below_each ? margins.bottom + bar_room : unlabelled.bottom);
    const double between = rows * panel_heading * font + (rows - 1.0) * row_gap;
    plan.scale =
        (width - left - right - (columns - 1.0) * column_gap) / (columns * content.view.width());
    if (height > 0)
      plan.scale =
          std::min(plan.scale, (height - below - above - between) / (rows * content.view.height()));
    const double panel_width = plan.scale * content.view.width();
    const double panel_height = plan.scale * content.view.height();
    const double needed = below + above + between + rows * panel_height;
    plan.height = height > 0 ? height : 2 * static_cast<int>(std::ceil(0.5 * needed));
    // What is left over goes half below and half above, and half to each side.
    const double spare_y = 0.5 * (plan.height - needed);
    const double spare_x =
        0.5 * (width - left - right - columns * panel_width - (columns - 1.0) * column_gap);
    plan.areas.clear();
    for (std::size_t panel = 0; panel < content.panels; ++panel) {
      const std::size_t column = panel % content.columns;
      const std::size_t row = panel / content.columns;
      const double from = left + spare_x + static_cast<double>(column) * (panel_width + column_gap);
      const double top = plan.height - above - spare_y - panel_heading * font -
                         static_cast<double>(row) * (panel_height + row_gap + panel_heading * font);
      plan.areas.push_back({{from, top - panel_height}, {from + panel_width, top}});
    }
    plan.bars.clear();
    const Box& first = plan.areas.front();
    const Box& last = plan.areas.back();
    if (content.own_bars()) {
      for (const Box& panel : plan.areas) {
        const double bar_left = panel.upper.x + beside + bar_gap * font - panel_edge * font;
        plan.bars.push_back(
            upright_bars
                ? Box{{bar_left, panel.lower.y}, {bar_left + thickness, panel.upper.y}}
                : hanging_bar(panel.lower.x, panel.upper.x,
                              panel.lower.y - margins.bottom - bar_gap * font, thickness, font));
      }
    } else {
      const double end = first.lower.x + columns * panel_width + (columns - 1.0) * column_gap;
      const double bar_left = end + right - panel_edge * font - thickness;
      plan.bars = {upright_bars
                       ? Box{{bar_left, last.lower.y}, {bar_left + thickness, first.upper.y}}
                       : hanging_bar(first.lower.x, end,
                                     last.lower.y - margins.bottom - bar_gap * font, thickness,
                                     font)};
    }
    area = {content.view, last};
  }
  return plan;
}

} // namespace

PanelContent panel_content(const FrameStyle& style, const Box& view, std::size_t panels) {
  constexpr std::size_t letters = 26;
  if (panels > letters) throw std::invalid_argument("more than 26 panels in one figure");
  if (style.bands < 1) throw std::invalid_argument("a figure needs at least one colour band");
  if (style.columns < 1) throw std::invalid_argument("a figure needs at least one column");
  if (style.width < 1 || style.height < 0)
    throw std::invalid_argument(fmt::format("a picture of {} x {} px", style.width, style.height));
  if (!(view.width() > 0.0) || !(view.height() > 0.0))
    throw std::invalid_argument("the view is empty");
  PanelContent content;
  content.view = view;
  content.panels = panels;
  content.columns = std::min(static_cast<std::size_t>(style.columns), panels);
  content.font_size =
      style.font_size > 0.0 ? style.font_size : default_font_size(style.width, style.height);
  content.titled = !style.title.empty();
  return content;
}

PanelLayout panel_layout(const PanelContent& content, int width, int height) {
  const PanelLayout below = layout(content, width, height, false);
  const PanelLayout beside = layout(content, width, height, true);
  // An upright bar must be long enough for its title.
  const bool long_enough = beside.bars.front().height() > 14.0 * content.font_size;
  // Bars below each panel would part the panels, and their axes with them.
  const bool better = content.own_bars() || beside.scale > below.scale;
  const PanelLayout& best = long_enough && better ? beside : below;
  if (!(best.scale > 0.0))
    throw std::invalid_argument(
        fmt::format("a picture of {} x {} px leaves no room for the body", width, height));
  return best;
}

void draw_panel_frame(Drawing& drawing, const PanelContent& content, const PanelLayout& layout,
                      std::size_t panel, const std::string& text) {
  const double font = content.font_size;
  const PlotArea area = {content.view, layout.areas[panel]};
  Axis x = x_axis(has_x_labels(content, layout.upright_bars, panel));
  Axis z = z_axis(has_z_labels(content, panel));
  choose_ticks(area, x, z, font);
  draw_axes(drawing, area, x, z, font);
  Words words;
  words.size = 1.08 * font;
  words.position = {area.pixels.lower.x + 0.5 * font, area.pixels.upper.y + 0.35 * font};
  words.text =
      content.panels == 1 ? text : fmt::format("{})  {}", static_cast<char>('a' + panel), text);
  drawing.write(words);
}

void draw_panel_surroundings(Drawing& drawing, const PanelContent& content,
                             const PanelLayout& layout, const std::string& title) {
  const double font = content.font_size;
  for (std::size_t i = 0; i < content.bars.size(); ++i)
    draw_bar(drawing, content.bars[i], layout.bars[i], layout.upright_bars, font);
  if (!content.titled) return;
  const Box& first = layout.areas.front();
  const Box& last_in_row = layout.areas[content.columns - 1];
  Words words;
  words.text = title;
  words.size = 1.25 * font;
  words.horizontal = Horizontal::centre;
  words.position = {0.5 * (first.lower.x + last_in_row.upper.x),
                    first.upper.y + (panel_heading + 0.3) * font};
  drawing.write(words);
}

} // namespace scarp::render

#include "render/multi_panel.hpp"

#include "render/body_layer.hpp"
#include "render/colour_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace scarp::render {

namespace {

/// Where everything is, for one direction of the colour bar.  Panels are equal and stacked.
struct Layout {
  bool upright_bar = false;
  int height = 0;         ///< px, of the picture
  double scale = 0.0;     ///< px a metre
  std::vector<Box> areas; ///< px, of the panels from top to bottom
  Box bar;
};

struct Content {
  Box view;
  ColourBar bar;
  std::size_t panels = 1;
  double font_size = 0.0;
  bool titled = false;
};

// In parts of the font's size.
constexpr double edge = 0.7;      // between the picture's sides and anything
constexpr double heading = 1.7;   // the line with letter and time above a panel
constexpr double panel_gap = 0.5; // below a panel's ticks
constexpr double bar_gap = 0.9;

Axis x_axis(bool labelled) { return {"x", "m", labelled, {}}; }
Axis z_axis() { return {"z", "m", true, {}}; }

Layout layout(const Content& content, int width, int height, bool upright_bar) {
  const double font = content.font_size;
  const double thickness = bar_thickness(content.bar, upright_bar, font);
  const auto panels = static_cast<double>(content.panels);
  Layout plan;
  plan.upright_bar = upright_bar;
  // Margins depend on the ticks, ticks on the size: one correction is enough.
  PlotArea area = {
      content.view,
      {{0, 0}, {0.8 * width, 0.8 * width * content.view.height() / content.view.width()}}};
  double below = 0.0;
  double above = 0.0;
  double left = 0.0;
  for (int round = 0; round < 2; ++round) {
    Axis x = x_axis(true);
    Axis z = z_axis();
    choose_ticks(area, x, z, font);
    const Margins margins = axis_margins(x, z, font);
    const double tick_room = axis_margins(x_axis(false), z, font).bottom;
    left = edge * font + margins.left;
    const double right = std::max(edge * font, margins.right + 0.7 * font) +
                         (upright_bar ? bar_gap * font + thickness : 0.0);
    below = edge * font + margins.bottom + (upright_bar ? 0.0 : bar_gap * font + thickness);
    above = edge * font + (content.titled ? 1.8 * font : 0.0);
    const double between =
        panels * heading * font + (panels - 1.0) * (tick_room + panel_gap * font);
    plan.scale = (width - left - right) / content.view.width();
    if (height > 0)
      plan.scale = std::min(plan.scale,
                            (height - below - above - between) / (panels * content.view.height()));
    const double panel_height = plan.scale * content.view.height();
    const double needed = below + above + between + panels * panel_height;
    plan.height = height > 0 ? height : 2 * static_cast<int>(std::ceil(0.5 * needed));
    // What is left over goes half below and half above, and half to each side.
    const double spare_y = 0.5 * (plan.height - needed);
    const double panel_width = plan.scale * content.view.width();
    const double spare_x = 0.5 * (width - left - right - panel_width);
    plan.areas.clear();
    double top = plan.height - above - spare_y;
    for (std::size_t panel = 0; panel < content.panels; ++panel) {
      top -= heading * font;
      const double lower = top - panel_height;
      plan.areas.push_back({{left + spare_x, lower}, {left + spare_x + panel_width, top}});
      top = lower - tick_room - panel_gap * font;
    }
    const Box& last = plan.areas.back();
    const Box& first = plan.areas.front();
    if (upright_bar) {
      const double bar_left = last.upper.x + right - edge * font - thickness;
      plan.bar = {{bar_left, last.lower.y}, {bar_left + thickness, first.upper.y}};
    } else {
      constexpr double part = 0.7; // of the panel's width
      const double bar_width = std::min(last.width(), std::max(part * last.width(), 16.0 * font));
      const double bar_left = 0.5 * (last.lower.x + last.upper.x - bar_width);
      const double bar_top = last.lower.y - margins.bottom - bar_gap * font;
      plan.bar = {{bar_left, bar_top - thickness}, {bar_left + bar_width, bar_top}};
    }
    area = {content.view, last};
  }
  return plan;
}

Layout best_layout(const Content& content, int width, int height) {
  const Layout below = layout(content, width, height, false);
  const Layout beside = layout(content, width, height, true);
  // An upright bar must be long enough for its title.
  const bool long_enough = beside.bar.height() > 14.0 * content.font_size;
  const Layout& best = long_enough && beside.scale > below.scale ? beside : below;
  if (!(best.scale > 0.0))
    throw std::invalid_argument(
        fmt::format("a picture of {} x {} px leaves no room for the body", width, height));
  return best;
}

ColourRange category_range(std::span<const io::Frame> frames, const Field& field) {
  ValueSpread spread = value_spread(frames.front(), field);
  for (const io::Frame& frame : frames) spread = united(spread, value_spread(frame, field));
  const double first = std::round(spread.least);
  const auto bands = static_cast<int>(std::lround(spread.largest - first)) + 1;
  return {first - 0.5, first - 0.5 + bands, bands, false, false};
}

std::string heading_text(const io::Frame& frame, const FrameStyle& style, std::size_t panel,
                         std::size_t panels) {
  std::string time = fmt::format("t = {:.{}f} s", frame.time, style.time_digits);
  if (panels == 1) return time;
  return fmt::format("{})  {}", static_cast<char>('a' + static_cast<int>(panel)), time);
}

} // namespace

Drawing draw_panels(std::span<const io::Frame> frames, const FrameStyle& style) {
  if (frames.empty()) throw std::invalid_argument("a figure without frames");
  constexpr std::size_t letters = 26;
  if (frames.size() > letters) throw std::invalid_argument("more than 26 panels in one figure");
  if (style.bands < 1) throw std::invalid_argument("a figure needs at least one colour band");
  if (style.width < 1 || style.height < 0)
    throw std::invalid_argument(fmt::format("a picture of {} x {} px", style.width, style.height));
  Content content;
  content.view = style.view ? *style.view : common_view(frames);
  if (!(content.view.width() > 0.0) || !(content.view.height() > 0.0))
    throw std::invalid_argument("the view is empty");
  const bool category = is_category(style.field);
  const ColourRange range = style.range ? *style.range
                            : category  ? category_range(frames, style.field)
                                        : common_range(frames, style.field, style.bands);
  content.bar = {range, style.colours, field_label(frames.front(), style.field),
                 field_unit(style.field), category};
  content.panels = frames.size();
  content.font_size =
      style.font_size > 0.0 ? style.font_size : default_font_size(style.width, style.height);
  content.titled = !style.title.empty();

  const double font = content.font_size;
  const Layout plan = best_layout(content, style.width, style.height);
  Drawing drawing(style.width, plan.height);
  Words words;
  words.vertical = Vertical::bottom;
  for (std::size_t panel = 0; panel < frames.size(); ++panel) {
    const PlotArea area = {content.view, plan.areas[panel]};
    draw_body(drawing, area, frames[panel], style, range);
    Axis x = x_axis(panel + 1 == frames.size());
    Axis z = z_axis();
    choose_ticks(area, x, z, font);
    draw_axes(drawing, area, x, z, font);
    draw_ground(drawing, area, frames[panel], font);
    words.size = 1.08 * font;
    words.position = {area.pixels.lower.x + 0.5 * font, area.pixels.upper.y + 0.35 * font};
    words.text = heading_text(frames[panel], style, panel, frames.size());
    drawing.write(words);
  }
  draw_bar(drawing, content.bar, plan.bar, plan.upright_bar, font);
  if (content.titled) {
    words.text = style.title;
    words.size = 1.25 * font;
    words.horizontal = Horizontal::centre;
    words.position = {0.5 * (plan.areas[0].lower.x + plan.areas[0].upper.x),
                      plan.areas[0].upper.y + (heading + 0.3) * font};
    drawing.write(words);
  }
  return drawing;
}

Image render_panels(std::span<const io::Frame> frames, const FrameStyle& style) {
  return rasterize(draw_panels(frames, style));
}

} // namespace scarp::render

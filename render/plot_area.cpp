#include "render/plot_area.hpp"

#include "render/ticks.hpp"

#include <algorithm>
#include <cmath>

namespace scarp::render {

namespace {

// In parts of the font's size.
constexpr double tick_length = 0.32;
constexpr double label_gap = 0.25;
constexpr double title_gap = 0.4;

std::string title(const Axis& axis) {
  const int power = axis.names.empty() ? common_power(axis.ticks) : 0;
  return axis.name + " " + unit_label(axis.unit, power);
}

std::vector<std::string> labels(const Axis& axis) {
  if (!axis.names.empty()) return axis.names;
  return tick_labels(axis.ticks, common_power(axis.ticks));
}

double widest(const std::vector<std::string>& texts, double font_size) {
  double width = 0.0;
  for (const std::string& text : texts) {
    Words words;
    words.text = text;
    words.size = font_size;
    width = std::max(width, text_size(words).x);
  }
  return width;
}

} // namespace

Point PlotArea::to_pixels(Point point) const {
  return {pixels.lower.x + (point.x - world.lower.x) * pixels.width() / world.width(),
          pixels.lower.y + (point.y - world.lower.y) * pixels.height() / world.height()};
}

Polyline PlotArea::to_pixels(const Polyline& line) const {
  Polyline drawn;
  drawn.reserve(line.size());
  for (const Point point : line) drawn.push_back(to_pixels(point));
  return drawn;
}

PlotArea fit_equal(const Box& world, const Box& available, double along_x, double along_y) {
  const double scale =
      std::min(available.width() / world.width(), available.height() / world.height());
  const Point size = {world.width() * scale, world.height() * scale};
  const Point lower = {available.lower.x + along_x * (available.width() - size.x),
                       available.lower.y + along_y * (available.height() - size.y)};
  return {world, {lower, {lower.x + size.x, lower.y + size.y}}};
}

void choose_ticks(const PlotArea& area, Axis& x, Axis& y, double font_size) {
  constexpr int most_ticks = 10;
  if (x.ticks.empty()) {
    for (int most = most_ticks; most >= 2; --most) {
      x.ticks = ticks(area.world.lower.x, area.world.upper.x, most);
      if (x.ticks.size() < 2) break;
      const double spacing = (x.ticks[1] - x.ticks[0]) * area.pixels.width() / area.world.width();
      if (spacing >= widest(labels(x), font_size) + 1.5 * font_size) break;
    }
  }
  if (y.ticks.empty()) {
    const int room = static_cast<int>(area.pixels.height() / (1.9 * font_size));
    y.ticks = ticks(area.world.lower.y, area.world.upper.y, std::clamp(room, 2, 8));
  }
}

Margins axis_margins(const Axis& x, const Axis& y, double font_size) {
  Margins margins;
  margins.bottom = tick_length * font_size;
  margins.left = tick_length * font_size;
  if (x.labelled) margins.bottom += (label_gap + 1.0 + title_gap + 1.2) * font_size;
  if (y.labelled)
    margins.left += (label_gap + title_gap + 1.2) * font_size + widest(labels(y), font_size);
  margins.right = x.labelled ? 0.5 * widest(labels(x), font_size) : 0.0;
  margins.top = 0.5 * font_size;
  return margins;
}

void draw_axes(Drawing& drawing, const PlotArea& area, const Axis& x, const Axis& y,
               double font_size) {
  const Pen pen = {std::max(1.0, 0.07 * font_size)};
  const double tick = tick_length * font_size;
  const Box& box = area.pixels;
  drawing.stroke(Polyline{{box.lower.x, box.upper.y}, box.lower, {box.upper.x, box.lower.y}}, pen);

  Words words;
  words.size = font_size;
  words.horizontal = Horizontal::centre;
  words.vertical = Vertical::top;
  const std::vector<std::string> x_labels = labels(x);
  for (std::size_t i = 0; i < x.ticks.size(); ++i) {
    const double at = area.to_pixels({x.ticks[i], 0.0}).x;
    drawing.stroke(Polyline{{at, box.lower.y}, {at, box.lower.y - tick}}, pen);
    words.text = x_labels[i];
    words.position = {at, box.lower.y - tick - label_gap * font_size};
    if (x.labelled) drawing.write(words);
  }
  words.text = title(x);
  words.size = fitting_size(words.text, box.width() + 2.0 * font_size, font_size);
  words.position = {0.5 * (box.lower.x + box.upper.x),
                    box.lower.y - tick - (label_gap + 1.0 + title_gap) * font_size};
  if (x.labelled) drawing.write(words);

  words.size = font_size;
  words.horizontal = Horizontal::right;
  words.vertical = Vertical::middle;
  const std::vector<std::string> y_labels = labels(y);
  for (std::size_t i = 0; i < y.ticks.size(); ++i) {
    const double at = area.to_pixels({0.0, y.ticks[i]}).y;
    drawing.stroke(Polyline{{box.lower.x, at}, {box.lower.x - tick, at}}, pen);
    words.text = y_labels[i];
    words.position = {box.lower.x - tick - label_gap * font_size, at};
    if (y.labelled) drawing.write(words);
  }
  words.text = title(y);
  words.size = fitting_size(words.text, box.height() + 2.0 * font_size, font_size);
  words.upright = true;
  words.position = {box.lower.x - tick - (label_gap + title_gap) * font_size -
                        widest(y_labels, font_size),
                    0.5 * (box.lower.y + box.upper.y)};
  if (y.labelled) drawing.write(words);
}

double fitting_size(const std::string& text, double room, double font_size) {
  constexpr double least = 0.75;
  return font_size * std::clamp(room / widest({text}, font_size), least, 1.0);
}

double default_font_size(int width, int height) {
  constexpr double of_width = 26.0 / 1920.0;
  constexpr double of_height = 1.0 / 28.0; // a flat picture still holds axes and a colour bar
  double size = of_width * width;
  if (height > 0) size = std::min(size, of_height * height);
  return std::max(11.0, std::round(size));
}

} // namespace scarp::render

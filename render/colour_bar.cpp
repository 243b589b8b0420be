#include "render/colour_bar.hpp"

#include "render/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace scarp::render {

namespace {

// In parts of the font's size.
constexpr double bar_width = 0.85;
constexpr double bar_tick_length = 0.3;
constexpr double bar_label_gap = 0.25;
constexpr double bar_title_gap = 0.4;
constexpr double arrow_length = 0.8;

struct BarTick {
  double part; ///< of the bar's length
  double value;
};

/// One digit, or 2.5, times a power of ten.
bool is_round(double value) {
  const double digits = value / std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  return std::abs(digits - std::round(digits)) < 1e-6 || std::abs(digits - 2.5) < 1e-6;
}

/// Every band's edge if there is room, else every second, third ..., a round step if it can be; a
/// category's number stands in the middle of its band.
std::vector<BarTick> bar_ticks(const ColourBar& bar, double length, double room) {
  const ColourRange& range = bar.range;
  std::vector<BarTick> found;
  if (bar.category) {
    for (int band = 0; band < range.bands; ++band)
      found.push_back({(band + 0.5) / range.bands, range.lower + 0.5 + band});
    return found;
  }
  const std::vector<double> edges = range.edges();
  const double width = (range.upper - range.lower) / range.bands;
  int stride = 1;
  while (stride < range.bands && length * stride / range.bands < room) ++stride;
  for (int wider = stride; wider <= 2 * stride && wider <= range.bands; ++wider) {
    if (!is_round(wider * width)) continue;
    stride = wider;
    break;
  }
  // Count from 0 if it is an edge, so that 0 is named.
  const auto zero = static_cast<int>(std::lround(-range.lower / width));
  const bool zero_inside = zero >= 0 && zero <= range.bands;
  for (int edge = zero_inside ? zero % stride : 0; edge <= range.bands; edge += stride)
    found.push_back(
        {static_cast<double>(edge) / range.bands, edges[static_cast<std::size_t>(edge)]});
  return found;
}

std::pair<std::vector<std::string>, int> bar_labels(const std::vector<BarTick>& ticks) {
  std::vector<double> values;
  values.reserve(ticks.size());
  for (const BarTick& tick : ticks)
    values.push_back(std::abs(tick.value) < 1e-12 ? 0.0 : tick.value);
  const int power = common_power(values);
  return {tick_labels(values, power), power};
}

double widest_label(const ColourBar& bar, double font_size) {
  double width = 0.0;
  for (const std::string& text : bar_labels(bar_ticks(bar, 1.0, 0.0)).first) {
    Words words;
    words.text = text;
    words.size = font_size;
    width = std::max(width, text_size(words).x);
  }
  return width;
}

/// Along and across the bar to the picture.
struct Placement {
  Box box;
  bool upright;

  double length() const { return upright ? box.height() : box.width(); }
  Point at(double along, double across) const {
    return upright ? Point{box.lower.x + across, box.lower.y + along}
                   : Point{box.lower.x + along, box.upper.y - across};
  }
};

} // namespace

double bar_thickness(const ColourBar& bar, bool upright, double font_size) {
  const double label = upright ? widest_label(bar, font_size) : font_size;
  return label + (bar_width + bar_tick_length + bar_label_gap + bar_title_gap + 1.25) * font_size;
}

void draw_bar(Drawing& drawing, const ColourBar& bar, const Box& box, bool upright,
              double font_size) {
  const Placement place = {box, upright};
  const double thickness = bar_width * font_size;
  const double arrow = arrow_length * font_size;
  const double begin = bar.range.values_below && !bar.category ? arrow : 0.0;
  const double end = place.length() - (bar.range.values_above && !bar.category ? arrow : 0.0);
  const double length = end - begin;

  const std::vector<Colour> colours = band_colours(bar.colours, bar.range.bands);
  for (int band = 0; band < bar.range.bands; ++band) {
    const double low = begin + length * band / bar.range.bands;
    const double high = begin + length * (band + 1) / bar.range.bands;
    drawing.fill(Polyline{place.at(low, 0.0), place.at(high, 0.0), place.at(high, thickness),
                          place.at(low, thickness)},
                 colours[static_cast<std::size_t>(band)]);
  }
  // The outline takes the arrows in.
  Polyline outline = {place.at(begin, 0.0)};
  if (begin > 0.0) {
    const Point tip = place.at(0.0, 0.5 * thickness);
    drawing.fill(Polyline{tip, place.at(begin, 0.0), place.at(begin, thickness)}, colours.front());
    outline.push_back(tip);
  }
  outline.push_back(place.at(begin, thickness));
  outline.push_back(place.at(end, thickness));
  if (end < place.length()) {
    const Point tip = place.at(place.length(), 0.5 * thickness);
    drawing.fill(Polyline{tip, place.at(end, 0.0), place.at(end, thickness)}, colours.back());
    outline.push_back(tip);
  }
  outline.push_back(place.at(end, 0.0));
  outline.push_back(outline.front());
  const Pen pen = {std::max(1.0, 0.06 * font_size)};
  drawing.stroke(outline, pen);

  const double label_width = widest_label(bar, font_size);
  const double room = upright ? 1.6 * font_size : label_width + font_size;
  const std::vector<BarTick> ticks = bar_ticks(bar, length, room);
  const auto [labels, power] = bar_labels(ticks);
  Words words;
  words.size = font_size;
  words.horizontal = upright ? Horizontal::left : Horizontal::centre;
  words.vertical = upright ? Vertical::middle : Vertical::top;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double along = begin + length * ticks[i].part;
    const double tick_end = thickness + bar_tick_length * font_size;
    if (!bar.category)
      drawing.stroke(Polyline{place.at(along, thickness), place.at(along, tick_end)}, pen);
    words.position = place.at(along, tick_end + bar_label_gap * font_size);
    words.text = labels[i];
    drawing.write(words);
  }
  const std::string unit = unit_label(bar.unit, power);
  words.text = bar.category || unit.empty() ? bar.label : bar.label + " " + unit;
  words.position =
      place.at(0.5 * place.length(),
               thickness + (bar_tick_length + bar_label_gap + bar_title_gap) * font_size +
                   (upright ? label_width : font_size));
  words.upright = upright;
  drawing.write(words);
}

} // namespace scarp::render

#include "render/legend.hpp"

#include "render/ticks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace scarp::render {

namespace {

// In parts of the font's size.
constexpr double line_height = 1.45;
constexpr double sample_length = 2.6;
constexpr double word_gap = 0.6;
constexpr double group_gap = 0.4;
constexpr double key_column_gap = 1.0;
constexpr double key_width = 1.1;

double text_width(const std::string& text, double font_size) {
  Words words;
  words.text = text;
  words.size = font_size;
  return text_size(words).x;
}

double column_width(const Legend& legend, double font_size) {
  double widest = 0.0;
  for (const LegendEntry& entry : legend.entries)
    widest = std::max(widest, text_width(entry.label, font_size));
  const double apart = legend.columns > 1 ? key_column_gap : 0.0;
  return widest + (sample_length + 2.0 * word_gap + apart) * font_size;
}

std::size_t entry_rows(const Legend& legend) {
  return (legend.entries.size() + legend.columns - 1) / legend.columns;
}

/// Between what stands above the notes and them: in a corner of a plot there is no room to spare.
double notes_gap(const Legend& legend, double font_size) {
  const bool first = legend.entries.empty() && !legend.key;
  return legend.below && !first && !legend.notes.empty() ? group_gap * font_size : 0.0;
}

double widest_label(const ColourKey& key, double font_size) {
  double widest = 0.0;
  for (const std::string& label : tick_labels(key.values))
    widest = std::max(widest, text_width(label, font_size));
  return widest;
}

/// How long one colour of a key is, px: room for its label if they are few.
double key_band(const ColourKey& key, bool lying, double font_size) {
  const auto count = static_cast<double>(key.values.size());
  const double least = 0.2 * font_size;
  const double roomy =
      lying ? widest_label(key, font_size) + word_gap * font_size : 1.3 * font_size;
  const double whole = (lying ? 14.0 : 9.0) * font_size;
  return std::clamp(whole / count, least, std::max(roomy, least));
}

/// Every n-th value is written.
std::size_t label_stride(const ColourKey& key, bool lying, double font_size) {
  const double least = lying ? widest_label(key, font_size) + 0.5 * font_size : 1.2 * font_size;
  return static_cast<std::size_t>(std::ceil(least / key_band(key, lying, font_size)));
}

Point key_size(const ColourKey& key, bool lying, double font_size) {
  const double length = key_band(key, lying, font_size) * static_cast<double>(key.values.size());
  const double title = text_width(key.title, font_size);
  const double label = widest_label(key, font_size);
  if (lying)
    return {std::max(title, length + label),
            (line_height + key_width + word_gap + 1.0) * font_size};
  return {std::max(title, label + (key_width + word_gap) * font_size),
          length + (line_height + 0.3) * font_size};
}

void draw_entry(Drawing& drawing, const LegendEntry& entry, Point left, double font_size) {
  const double end = left.x + sample_length * font_size;
  const double y = left.y;
  if (entry.fill) {
    const double half = 0.5 * font_size;
    const Point middle = {0.5 * (left.x + end), y};
    const Box box = {{middle.x - half, y - half}, {middle.x + half, y + half}};
    drawing.fill(box, *entry.fill);
    drawing.stroke(box, {std::max(1.0, 0.06 * font_size), entry.colour});
  }
  if (entry.line != LineKind::none)
    drawing.stroke(Polyline{left, {end, y}},
                   curve_pen(entry.line, entry.colour, entry.weight, font_size));
  drawing.mark({0.5 * (left.x + end), y}, entry.marker, marker_radius(entry.weight, font_size),
               entry.colour);
  Words words;
  words.position = {end + word_gap * font_size, y};
  words.text = entry.label;
  words.size = font_size;
  words.vertical = Vertical::middle;
  drawing.write(words);
}

/// Upwards or, lying, to the right from the least value.
void draw_key(Drawing& drawing, const ColourKey& key, const Box& box, bool lying,
              double font_size) {
  Words words;
  words.size = font_size;
  words.vertical = Vertical::middle;
  words.horizontal = lying ? Horizontal::centre : Horizontal::left;
  words.text = key.title;
  words.position = {lying ? 0.5 * (box.lower.x + box.upper.x) : box.lower.x,
                    box.upper.y - 0.5 * line_height * font_size};
  drawing.write(words);

  const double band = key_band(key, lying, font_size);
  const double length = band * static_cast<double>(key.values.size());
  const double width = key_width * font_size;
  // The uppermost label of an upright key may stand out above its colour.
  const double top = box.upper.y - (line_height + (lying ? 0.0 : 0.2)) * font_size;
  const Point begin = lying ? Point{0.5 * (box.lower.x + box.upper.x - length), top - width}
                            : Point{box.lower.x, top - length};
  const std::vector<std::string> labels = tick_labels(key.values);
  const std::size_t stride = label_stride(key, lying, font_size);
  if (lying) words.vertical = Vertical::top;
  for (std::size_t i = 0; i < key.values.size(); ++i) {
    const double along = band * static_cast<double>(i);
    const Point lower = lying ? Point{begin.x + along, begin.y} : Point{begin.x, begin.y + along};
    drawing.fill(Box{lower, {lower.x + (lying ? band : width), lower.y + (lying ? width : band)}},
                 key.colours[i]);
    if (i % stride != 0) continue;
    words.text = labels[i];
    words.position = lying ? Point{lower.x + 0.5 * band, lower.y - 0.5 * word_gap * font_size}
                           : Point{lower.x + width + word_gap * font_size, lower.y + 0.5 * band};
    drawing.write(words);
  }
}

} // namespace

Pen curve_pen(LineKind line, Colour colour, double weight, double font_size) {
  Pen pen = {std::max(1.0, std::max(1.2, 0.11 * font_size) * weight), colour};
  if (line == LineKind::dashed) pen.dashes = {0.55 * font_size, 0.32 * font_size};
  if (line == LineKind::dotted) pen.dashes = {0.12 * font_size, 0.2 * font_size};
  return pen;
}

double marker_radius(double weight, double font_size) {
  return std::max(2.5, 0.24 * font_size) * weight;
}

Point legend_size(const Legend& legend, double font_size) {
  Point size;
  if (!legend.entries.empty())
    size = {column_width(legend, font_size) * static_cast<double>(legend.columns),
            static_cast<double>(entry_rows(legend)) * line_height * font_size};
  if (legend.key) {
    const Point key = key_size(*legend.key, legend.below, font_size);
    size = {std::max(size.x, key.x), size.y + key.y + (size.y > 0.0 ? group_gap * font_size : 0.0)};
  }
  size.y += notes_gap(legend, font_size);
  for (const std::string& note : legend.notes) {
    size.x = std::max(size.x, text_width(note, font_size));
    size.y += line_height * font_size;
  }
  return size;
}

void spread(Legend& legend, double width, double font_size) {
  const std::size_t entries = legend.entries.size();
  legend.columns = std::max<std::size_t>(entries, 1);
  while (legend.columns > 1 && legend_size(legend, font_size).x > width) --legend.columns;
  const std::size_t rows = entry_rows(legend);
  if (rows > 0) legend.columns = (entries + rows - 1) / rows; // rows of equal length
}

std::optional<Box> free_corner(const Obstacles& obstacles, const Box& area, Point size,
                               double font_size) {
  const double clear = 0.6 * font_size;
  const double left = area.lower.x + clear;
  const double right = area.upper.x - size.x - clear;
  const double low = area.lower.y + clear;
  const double high = area.upper.y - size.y - 0.2 * font_size;
  if (right < left || high < low) return std::nullopt;
  const std::array<Point, 4> corners = {
      Point{right, high}, {right, low}, {left, high}, {left, low}};
  for (const Point corner : corners) {
    const Box box = {{corner.x - clear, corner.y - clear},
                     {corner.x + size.x + clear, corner.y + size.y + clear}};
    if (!obstacles.meet(box)) return Box{corner, {corner.x + size.x, corner.y + size.y}};
  }
  return std::nullopt;
}

void draw_legend(Drawing& drawing, const Legend& legend, const Box& box, double font_size) {
  const double width = column_width(legend, font_size);
  const std::size_t rows = entry_rows(legend);
  for (std::size_t i = 0; i < legend.entries.size(); ++i) {
    const std::size_t column = i / rows;
    const std::size_t row = i % rows;
    draw_entry(drawing, legend.entries[i],
               {box.lower.x + static_cast<double>(column) * width,
                box.upper.y - (static_cast<double>(row) + 0.5) * line_height * font_size},
               font_size);
  }
  double y = box.upper.y - static_cast<double>(rows) * line_height * font_size;
  if (legend.key) {
    if (!legend.entries.empty()) y -= group_gap * font_size;
    const double bottom = y - key_size(*legend.key, legend.below, font_size).y;
    draw_key(drawing, *legend.key, {{box.lower.x, bottom}, {box.upper.x, y}}, legend.below,
             font_size);
    y = bottom;
  }
  y -= notes_gap(legend, font_size);
  Words words;
  words.size = font_size;
  words.vertical = Vertical::middle;
  for (const std::string& note : legend.notes) {
    words.text = note;
    words.position = {box.lower.x, y - 0.5 * line_height * font_size};
    drawing.write(words);
    y -= line_height * font_size;
  }
}

} // namespace scarp::render

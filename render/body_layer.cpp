#include "render/body_layer.hpp"

#include "render/contour.hpp"
#include "render/node_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

namespace scarp::render {

namespace {

/// The nodes in and just around a box.
NodeField cropped(const NodeField& field, const Box& box) {
  const auto line = [&](double from, double at, std::size_t nodes, int beyond) {
    const double place = std::floor((at - from) / field.cell_size) + beyond;
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(nodes - 1)));
  };
  const std::size_t left =
      std::min(line(field.lower.x, box.lower.x, field.nodes_x, -1), field.nodes_x - 2);
  const std::size_t low =
      std::min(line(field.lower.y, box.lower.y, field.nodes_z, -1), field.nodes_z - 2);
  const std::size_t right = std::max(line(field.lower.x, box.upper.x, field.nodes_x, 2), left + 1);
  const std::size_t high = std::max(line(field.lower.y, box.upper.y, field.nodes_z, 2), low + 1);
  NodeField part = field;
  part.lower = {field.x(left), field.z(low)};
  part.nodes_x = right - left + 1;
  part.nodes_z = high - low + 1;
  part.values.clear();
  for (std::size_t k = low; k <= high; ++k)
    for (std::size_t i = left; i <= right; ++i) part.values.push_back(field.at(i, k));
  return part;
}

/// Fine enough that the straight sides of a cell's triangles do not show.
std::size_t refinement(double cell_px) {
  constexpr double coarse = 12.0;
  return cell_px > coarse ? 4 : 2;
}

void draw_bands(Drawing& drawing, const PlotArea& area, const NodeField& body,
                const NodeField& field, const std::vector<double>& edges,
                const std::vector<Colour>& colours) {
  Polyline drawn;
  filled_bands(body, field, edges, [&](const Polyline& polygon, std::size_t band) {
    const bool inside = std::all_of(polygon.begin(), polygon.end(),
                                    [&](Point point) { return area.world.contains(point); });
    drawn.clear();
    if (inside) {
      for (const Point point : polygon) drawn.push_back(area.to_pixels(point));
      drawing.fill(drawn, colours[band]);
    } else {
      drawing.fill(area.to_pixels(clipped_polygon(polygon, area.world)), colours[band]);
    }
  });
}

/// One part of the body for each number: where its share of the volume around is the largest.
void draw_categories(Drawing& drawing, const PlotArea& area, const io::Frame& frame,
                     const std::vector<double>& values, const NodeField& body, std::size_t times,
                     const ColourRange& range, const std::vector<Colour>& colours) {
  std::set<long> numbers;
  for (const double value : values) numbers.insert(std::lround(value));
  std::vector<NodeField> shares;
  for (const long number : numbers) {
    std::vector<double> is_number(values.size());
    for (std::size_t p = 0; p < values.size(); ++p)
      is_number[p] = std::lround(values[p]) == number ? 1.0 : 0.0;
    shares.push_back(refined_smooth(cropped(node_average(frame, is_number), area.world), times));
  }
  std::size_t own = 0;
  for (const long number : numbers) {
    NodeField lead = shares[own];
    for (std::size_t node = 0; node < lead.values.size(); ++node) {
      double other = 0.0;
      for (std::size_t s = 0; s < shares.size(); ++s)
        if (s != own) other = std::max(other, shares[s].values[node]);
      lead.values[node] -= other;
    }
    // The part of the body in front: where both the fraction and the lead allow it.
    for (std::size_t node = 0; node < lead.values.size(); ++node)
      lead.values[node] = std::min(body.values[node], 0.5 + lead.values[node]);
    const double band = std::clamp(static_cast<double>(number) - range.lower - 0.5, 0.0,
                                   static_cast<double>(range.bands - 1));
    draw_bands(drawing, area, lead, lead, {0.0, 1.0}, {colours[static_cast<std::size_t>(band)]});
    ++own;
  }
}

void draw_discs(Drawing& drawing, const PlotArea& area, const io::Frame& frame,
                const std::vector<double>& values, const ColourRange& range,
                const std::vector<Colour>& colours) {
  const std::vector<double>& V0 = initial_volumes(frame);
  constexpr double part = 0.42; // of the points' spacing; neighbours stay apart
  for (std::size_t p = 0; p < frame.size(); ++p) {
    const Point at = {frame.position[3 * p], frame.position[3 * p + 2]};
    if (!area.world.contains(at)) continue;
    const double band = range.bands * (values[p] - range.lower) / (range.upper - range.lower);
    const double chosen = std::clamp(std::floor(band), 0.0, range.bands - 1.0);
    const double radius = std::max(0.6, part * std::sqrt(V0[p]) * area.scale());
    drawing.mark(area.to_pixels(at), radius < 1.5 ? Marker::square : Marker::circle, radius,
                 colours[static_cast<std::size_t>(chosen)]);
  }
}

void stroke_outline(Drawing& drawing, const PlotArea& area, const NodeField& body, const Pen& pen) {
  for (const Polyline& line : contour_lines(body, body_level))
    for (const Polyline& part : clipped(line, area.world))
      drawing.stroke(area.to_pixels(part), pen);
}

} // namespace

void draw_body(Drawing& drawing, const PlotArea& area, const io::Frame& frame,
               const FrameStyle& style, const ColourRange& range) {
  const std::vector<double> values = field_values(frame, style.field);
  const std::vector<Colour> colours = band_colours(style.colours, range.bands);
  const double outline = std::max(1.0, area.pixels.width() / 1100.0);
  const NodeField fraction = cropped(volume_fraction(frame), area.world);
  if (style.draw_points) {
    draw_discs(drawing, area, frame, values, range, colours);
    return;
  }
  const std::size_t times = refinement(frame.cell_size * area.scale());
  const NodeField body = refined(fraction, times);
  if (is_category(style.field)) {
    draw_categories(drawing, area, frame, values, body, times, range, colours);
  } else {
    const NodeField field = refined_smooth(cropped(node_average(frame, values), area.world), times);
    draw_bands(drawing, area, body, field, range.edges(), colours);
  }
  stroke_outline(drawing, area, body, {outline, ink});
}

void draw_ground(Drawing& drawing, const PlotArea& area, const io::Frame& frame, double font_size) {
  const Polyline ground = {{frame.lower[0], frame.lower[2]}, {frame.upper[0], frame.lower[2]}};
  for (const Polyline& part : clipped(ground, area.world))
    drawing.stroke(area.to_pixels(part), {std::max(1.5, 0.14 * font_size), ink});
}

} // namespace scarp::render

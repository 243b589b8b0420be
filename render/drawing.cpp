#include "render/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace scarp::render {

namespace {

Polyline circle(Point centre, double radius) {
  const int sides = std::clamp(static_cast<int>(4.0 * std::sqrt(radius) + 4.0), 6, 32);
  Polyline ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return ring;
}

/// The drawn parts of a dashed line.
std::vector<Polyline> dashed(const Polyline& line, const std::vector<double>& dashes) {
  std::vector<Polyline> parts;
  std::size_t dash = 0;
  double left = dashes.front(); // of the current dash
  bool begun = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point a = line[i];
    const Point b = line[i + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    double done = 0.0;
    while (done < length) {
      const double end = std::min(length, done + left);
      const auto at = [&](double s) {
        return Point{a.x + (b.x - a.x) * s / length, a.y + (b.y - a.y) * s / length};
      };
      if (dash % 2 == 0) {
        if (!begun) parts.push_back({at(done)});
        parts.back().push_back(at(end));
        begun = true;
      }
      left -= end - done;
      done = end;
      if (left <= 1e-6 * dashes[dash]) {
        dash = (dash + 1) % dashes.size();
        left = std::max(dashes[dash], 1.0);
        begun = false;
      }
    }
  }
  return parts;
}

} // namespace

Colour mixed(Colour a, Colour b, double part) {
  const auto channel = [part](unsigned char from, unsigned char to) {
    return static_cast<unsigned char>(std::lround(from + part * (to - from)));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

Box covered(const Words& words) {
  Point size = text_size(words);
  if (words.upright) std::swap(size.x, size.y);
  const Point lower = {words.position.x - 0.5 * static_cast<int>(words.horizontal) * size.x,
                       words.position.y - 0.5 * static_cast<int>(words.vertical) * size.y};
  return {lower, {lower.x + size.x, lower.y + size.y}};
}

void Drawing::triangle(Point a, Point b, Point c, Colour colour) {
  for (const Point corner : {a, b, c}) {
    corners.push_back(static_cast<float>(corner.x));
    corners.push_back(static_cast<float>(corner.y));
  }
  colours.push_back(colour);
}

void Drawing::fill(const Polyline& convex, Colour colour) {
  for (std::size_t i = 2; i < convex.size(); ++i)
    triangle(convex[0], convex[i - 1], convex[i], colour);
}

void Drawing::fill(const Box& box, Colour colour) {
  fill(Polyline{box.lower, {box.upper.x, box.lower.y}, box.upper, {box.lower.x, box.upper.y}},
       colour);
}

void Drawing::stroke(const Polyline& line, const Pen& pen) {
  if (!pen.dashes.empty()) {
    const Pen solid = {pen.width, pen.colour};
    for (const Polyline& part : dashed(line, pen.dashes)) stroke(part, solid);
    return;
  }
  const double half = 0.5 * pen.width;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point a = line[i];
    const Point b = line[i + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length == 0.0) continue;
    const Point side = {-(b.y - a.y) / length * half, (b.x - a.x) / length * half};
    fill(Polyline{{a.x + side.x, a.y + side.y},
                  {a.x - side.x, a.y - side.y},
                  {b.x - side.x, b.y - side.y},
                  {b.x + side.x, b.y + side.y}},
         pen.colour);
    if (i > 0 && pen.width > 1.0) fill(circle(a, half), pen.colour); // round joint
  }
}

void Drawing::stroke(const Box& box, const Pen& pen) {
  const double half = 0.5 * pen.width; // the corners are filled
  stroke(Polyline{{box.lower.x - half, box.lower.y}, {box.upper.x + half, box.lower.y}}, pen);
  stroke(Polyline{{box.lower.x - half, box.upper.y}, {box.upper.x + half, box.upper.y}}, pen);
  stroke(Polyline{{box.lower.x, box.lower.y}, {box.lower.x, box.upper.y}}, pen);
  stroke(Polyline{{box.upper.x, box.lower.y}, {box.upper.x, box.upper.y}}, pen);
}

void Drawing::mark(Point centre, Marker marker, double radius, Colour colour) {
  switch (marker) {
  case Marker::none:
    return;
  case Marker::circle:
    fill(circle(centre, radius), colour);
    return;
  case Marker::open_circle:
    fill(circle(centre, radius), colour);
    fill(circle(centre, 0.62 * radius), white);
    return;
  case Marker::square:
    fill(Box{{centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}},
         colour);
    return;
  case Marker::diamond:
    fill(Polyline{{centre.x - radius, centre.y},
                  {centre.x, centre.y - radius},
                  {centre.x + radius, centre.y},
                  {centre.x, centre.y + radius}},
         colour);
    return;
  }
}

} // namespace scarp::render

// A picture before it has pixels: coloured triangles and words.  Figures are built as drawings, so
// tests can look at data instead of pixels; only rasterize() knows VTK.
#pragma once

#include "render/geometry.hpp"
#include "render/image.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace scarp::render {

struct Colour {
  unsigned char red = 0;
  unsigned char green = 0;
  unsigned char blue = 0;

  bool operator==(const Colour&) const = default;
};

inline constexpr Colour black = {0, 0, 0};
inline constexpr Colour white = {255, 255, 255};
inline constexpr Colour ink = {38, 38, 38}; ///< axes and words

/// `part` 0...1 of the way from `a` to `b`.
Colour mixed(Colour a, Colour b, double part);

enum class Horizontal { left, centre, right };
enum class Vertical { bottom, middle, top };

struct Words {
  Point position; ///< px; the anchor
  std::string text;
  double size = 24.0; ///< px
  Colour colour = ink;
  Horizontal horizontal = Horizontal::left;
  Vertical vertical = Vertical::bottom;
  bool bold = false;
  bool upright = false; ///< reading upwards; the alignment stays that of the picture
};

struct Pen {
  double width = 2.0; ///< px
  Colour colour = ink;
  std::vector<double> dashes = {}; ///< px, alternately drawn and not; empty: solid
};

enum class Marker { none, circle, open_circle, square, diamond };

/// Lengths in pixels, the origin in the lower left corner, y up.  Later shapes cover earlier ones;
/// words stand above all shapes.
struct Drawing {
  Drawing(int width_px, int height_px) : width(width_px), height(height_px) {}

  void fill(const Polyline& convex, Colour colour);
  void fill(const Box& box, Colour colour);
  void stroke(const Polyline& line, const Pen& pen);
  void stroke(const Box& box, const Pen& pen);
  /// `radius` is half the marker's width.
  void mark(Point centre, Marker marker, double radius, Colour colour);
  void write(Words words) { texts.push_back(std::move(words)); }

  int width;
  int height;
  Image backdrop;              ///< drawn first if it has pixels; same size
  std::vector<float> corners;  ///< x y of three corners a triangle
  std::vector<Colour> colours; ///< one a triangle
  std::vector<Words> texts;

 private:
  void triangle(Point a, Point b, Point c, Colour colour);
};

/// Size of the words' box in pixels before turning, with the font that rasterize() uses.
Point text_size(const Words& words);
/// The box that the words cover, px.
Box covered(const Words& words);

/// Four samples a pixel.  Throws std::runtime_error if there is no OpenGL (it says what to install)
/// or if VTK reports an error; std::invalid_argument if the size is not within 1...16384 px.
Image rasterize(const Drawing& drawing);

} // namespace scarp::render

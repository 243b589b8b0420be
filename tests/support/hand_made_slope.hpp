// A small slope of 45 degrees with a load on its crest, and the figures of it that tests draw.
#pragma once

#include "render/lattice_figure.hpp"
#include "render/model_figure.hpp"
#include "tests/support/hand_made_frames.hpp"

#include <vector>

namespace scarp::test {

inline const render::Polyline slope_outline = {{0, 0},  {40, 0},  {40, 4},
                                               {26, 4}, {16, 14}, {0, 14}}; // m
inline const render::Polyline load_outline = {{8, 14}, {16, 14}, {16, 16}, {8, 16}};
inline constexpr render::Colour load_colour = {250, 200, 100};

inline io::Frame slope_frame() {
  io::Frame frame = empty_frame(1.0, 40.0, 20.0);
  fill(frame, [](double x, double z) {
    return render::is_inside({x, z}, slope_outline) || render::is_inside({x, z}, load_outline);
  });
  return frame;
}

inline render::ModelStyle slope_style() {
  render::ModelStyle style;
  style.left = {render::Support::roller, "symmetry"};
  style.bottom = {render::Support::fixed, "fixed"};
  style.parts = {{slope_outline, "slope"}, {load_outline, "load", load_colour}};
  style.places = {{{16, 14}, "A"}, {{21, 9}, "B"}, {{26, 4}, "C"}};
  style.dimensions = {{{0, 0}, {26, 0}, "", -3.6}, {{26, 0}, {40, 0}, "foreland", -3.6},
                      {{40, 4}, {40, 0}, "", 2.0}, {{0, 0}, {0, 14}, "", 4.4},
                      {{8, 14}, {8, 16}, "", 1.2}, {{8, 16}, {16, 16}, "", 1.0}};
  style.notes = {"c = 20 kPa", "φ = 25°"};
  return style;
}

/// Squares of 0.5 m, and triangles where the face cuts them.
inline std::vector<render::LatticePiece> slope_pieces() {
  std::vector<render::LatticePiece> pieces;
  constexpr double side = 0.5;
  for (int row = 0; row < 28; ++row) {
    for (int column = 0; column < 80; ++column) {
      const double x = side * column;
      const double z = side * row;
      const double beyond = x + z - 30.0; // of the lower left corner beyond the face x + z = 30
      if (beyond <= -2.0 * side || z < 4.0)
        pieces.push_back({{{x, z}, {x + side, z}, {x + side, z + side}, {x, z + side}},
                          {x + 0.5 * side, z + 0.5 * side}});
      else if (beyond < 0.0)
        pieces.push_back(
            {{{x, z}, {x + side, z}, {x, z + side}}, {x + side / 3.0, z + side / 3.0}, true});
    }
  }
  return pieces;
}

inline render::LatticeStyle slope_lattice_style() {
  render::LatticeStyle style;
  style.cell_size = 1.0;
  style.view = {{22.8, 2.6}, {28.2, 6.4}};
  style.sides = {slope_outline};
  return style;
}

} // namespace scarp::test

// A close look at where material points stand in the background grid.
#pragma once

#include "render/drawing.hpp"
#include "render/image.hpp"

#include <string>
#include <vector>

namespace scarp::render {

/// The part of the body that one material point stands for.
struct LatticePiece {
  Polyline outline; ///< m, convex, not closed
  Point point;      ///< m, of the material point: the centroid
  bool cut = false; ///< by the body's side, so less than a full square
};

struct LatticeStyle {
  double cell_size = 0.0;           ///< m, of the background grid
  Point node = {};                  ///< m, any node of it
  Box view = {};                    ///< m
  std::vector<Polyline> sides = {}; ///< m; of the body, drawn thick
  std::string full_label = "full square";
  std::string cut_label = "cut by the face";
  std::string grid_label = "background grid";
  std::string side_label = "free surface";
  std::string title = {};
  int width = 1600;       ///< px
  int height = 0;         ///< px; 0: what the view needs (an even number)
  double font_size = 0.0; ///< px; 0: by the picture's size
};

/// Pieces lightly filled, full and cut ones in two colours, their points as dots, the grid's lines,
/// axes, and below them a legend of what there is in the view.  Throws std::invalid_argument if
/// cell size or view make no sense, there is no piece in the view or no room; std::runtime_error
/// if drawing fails.
Image render_lattice(const std::vector<LatticePiece>& pieces, const LatticeStyle& style);

/// The same before it has pixels.
Drawing draw_lattice(const std::vector<LatticePiece>& pieces, const LatticeStyle& style);

} // namespace scarp::render

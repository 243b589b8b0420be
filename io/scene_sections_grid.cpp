// The grid, its sides and planes across it.
#include "io/scene_sections.hpp"

#include <cstddef>
#include <string>
#include <utility>

namespace scarp::io {

namespace {

Option<Grid> wall(std::string key, std::size_t axis, std::size_t side, std::string help) {
  return Declaration<Grid>{
      .key = std::move(key),
      .unit = "",
      .allowed = "'fixed', 'symmetry', 'free' or { kind = 'friction', coefficient = NUMBER >= 0 }",
      .help = std::move(help),
      .read = [=](const toml::node& node, int,
                  Grid& grid) { return read_wall(node, grid.walls[axis][side]); },
      .write = [=](const Grid& grid, int) -> Json {
        const Wall& w = grid.walls[axis][side];
        const std::string& kind = wall_words[static_cast<std::size_t>(w.kind)];
        if (w.kind != WallKind::friction) return kind;
        return {{"kind", kind}, {"coefficient", w.friction_coefficient}};
      }};
}

} // namespace

Section<Grid> grid_section() {
  return {.name = "grid",
          .help = "The background grid of square or cubic cells, and the lattice of points.",
          .options = {
              whole_number<Grid>("dimension", &Grid::dimension, 2, 3,
                                 "2: plane strain in x and z; 3: x, y and z. z points up."),
              required(number<Grid>("cell_size_m", "m", &Grid::cell_size, {.above = 0},
                                    "Edge of a cell.")),
              required(vector<Grid>("lower_m", "m", &Grid::lower, "Lower corner of the grid.")),
              required(vector<Grid>("upper_m", "m", &Grid::upper,
                                    "Upper corner, a whole number of cells from the lower one.")),
              whole_number<Grid>("points_per_cell", &Grid::points_per_cell, 1, 10,
                                 "Material points along each edge of a filled cell."),
          }};
}

Section<Grid> walls_section() {
  return {.name = "walls",
          .help = "What the sides of the grid do. 'fixed': no velocity; 'symmetry': no velocity "
                  "across; 'free': nothing; friction: no velocity into the wall, Coulomb friction "
                  "along it.",
          .options = {
              wall("x_lower", 0, 0, "Left side."),
              wall("x_upper", 0, 1, "Right side."),
              only_in_3d(wall("y_lower", 1, 0, "Front side.")),
              only_in_3d(wall("y_upper", 1, 1, "Back side.")),
              wall("z_lower", 2, 0, "Bottom."),
              wall("z_upper", 2, 1, "Top."),
          }};
}

Section<Gate> gate_section() {
  return {.name = "gate",
          .help = "A plane across the grid that acts as a symmetry plane until it is taken away; "
                  "any number of [[gate]].",
          .options = {
              name<Gate>("Name in messages and overrides."),
              word<Gate, int>("axis", &Gate::axis, {{"x", 0}, {"y", 1}, {"z", 2}},
                              "The axis that the plane is normal to; y in 3-D only."),
              required(number<Gate>("position_m", "m", &Gate::position, {},
                                    "Coordinate of the plane, on a grid plane.")),
              required(number<Gate>("release_time_s", "s", &Gate::release_time, {.at_least = 0},
                                    "When it is taken away.")),
          }};
}

} // namespace scarp::io

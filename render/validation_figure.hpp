// The final profile of a plane-strain run over an experiment's.
#pragma once

#include "io/frame.hpp"
#include "io/table.hpp"
#include "render/line_chart.hpp"

#include <optional>
#include <string>

namespace scarp::render {

struct ValidationStyle {
  /// Columns x_m, z_m in m; none: only the model is drawn.
  std::optional<io::Table> surface = {};
  std::optional<io::Table> failure = {};
  std::string model_name = "scarp";
  std::string experiment_name = "experiment";
  std::string title = {};
  int width = 2000;       ///< px
  int height = 0;         ///< px; 0: what the profile needs
  double font_size = 0.0; ///< px; 0: by the picture's size
};

/// Free surface (BodyShape::height_at) and failure line (at undeformed positions) of the frame, the
/// experiment's points, and dashed the undeformed outline, with equal scales.  The legend tells the
/// number of points and the errors of surface_error() and failure_error().  The column
/// `displacement` is needed only for the failure line and the outline, which are left out without
/// it. Throws as measure_body() and render_chart().
Image render_validation(const io::Frame& frame, const ValidationStyle& style);

/// The same before it has pixels, and its curves.
Drawing draw_validation(const io::Frame& frame, const ValidationStyle& style);
std::vector<Curve> validation_curves(const io::Frame& frame, const ValidationStyle& style);

} // namespace scarp::render

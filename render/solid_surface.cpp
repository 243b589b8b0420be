#include "render/solid_surface.hpp"

#include "render/node_field.hpp"
#include "render/vtk_errors.hpp"
#include "render/vtk_window.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace scarp::render {

namespace {

/// The grid's nodes with one layer around them, which closes the surface at the grid's sides.
struct SolidNodes {
  explicit SolidNodes(const io::Frame& frame) : h(frame.cell_size) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cells = (frame.upper[axis] - frame.lower[axis]) / h;
      if (!(h > 0.0) || !(cells > 0.5)) throw std::invalid_argument("the frame's grid has no cell");
      nodes[axis] = static_cast<std::size_t>(std::lround(cells)) + 3;
      origin[axis] = frame.lower[axis] - h;
    }
    fraction.assign(nodes[0] * nodes[1] * nodes[2], 0.0);
    value.assign(fraction.size(), 0.0);
  }

  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return i + nodes[0] * (j + nodes[1] * k);
  }

  double h; ///< m
  std::array<std::size_t, 3> nodes = {};
  Vector origin = {};
  std::vector<double> fraction;
  std::vector<double> value;
};

void carry_points(SolidNodes& grid, const io::Frame& frame, const std::vector<double>& values) {
  const std::vector<double>& V0 = initial_volumes(frame);
  for (std::size_t p = 0; p < frame.size(); ++p) {
    std::array<std::size_t, 3> cell = {};
    std::array<double, 3> part = {};
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = frame.position[3 * p + axis];
      inside = inside && x >= frame.lower[axis] && x <= frame.upper[axis];
      if (!inside) break;
      const double place = (x - grid.origin[axis]) / grid.h;
      cell[axis] = std::min(static_cast<std::size_t>(place), grid.nodes[axis] - 3);
      part[axis] = place - static_cast<double>(cell[axis]);
    }
    if (!inside) continue;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::array<std::size_t, 3> up = {corner & 1U, (corner >> 1U) & 1U, corner >> 2U};
      double N = 1.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        N *= up[axis] == 1 ? part[axis] : 1.0 - part[axis];
      const std::size_t node = grid.index(cell[0] + up[0], cell[1] + up[1], cell[2] + up[2]);
      grid.fraction[node] += V0[p] * N;
      grid.value[node] += V0[p] * N * values[p];
    }
  }
}

/// Divides by the weights; nodes that no point reaches take the mean of their neighbours.
void average(SolidNodes& grid) {
  const std::vector<double> weight = grid.fraction;
  for (std::size_t node = 0; node < weight.size(); ++node)
    if (weight[node] > 0.0) grid.value[node] /= weight[node];
  std::vector<double> extended = grid.value;
  for (std::size_t k = 0; k < grid.nodes[2]; ++k) {
    for (std::size_t j = 0; j < grid.nodes[1]; ++j) {
      for (std::size_t i = 0; i < grid.nodes[0]; ++i) {
        const std::size_t node = grid.index(i, j, k);
        if (weight[node] > 0.0) continue;
        double sum = 0.0;
        int count = 0;
        for (std::size_t c = k > 0 ? k - 1 : 0; c <= std::min(k + 1, grid.nodes[2] - 1); ++c) {
          for (std::size_t b = j > 0 ? j - 1 : 0; b <= std::min(j + 1, grid.nodes[1] - 1); ++b) {
            for (std::size_t a = i > 0 ? i - 1 : 0; a <= std::min(i + 1, grid.nodes[0] - 1); ++a) {
              const std::size_t other = grid.index(a, b, c);
              if (!(weight[other] > 0.0)) continue;
              sum += grid.value[other];
              ++count;
            }
          }
        }
        if (count > 0) extended[node] = sum / count;
      }
    }
  }
  grid.value = extended;

  // To volume fractions: h^3 a node, half of it for each side of the grid the node lies on.
  for (std::size_t k = 0; k < grid.nodes[2]; ++k) {
    for (std::size_t j = 0; j < grid.nodes[1]; ++j) {
      for (std::size_t i = 0; i < grid.nodes[0]; ++i) {
        double volume = grid.h * grid.h * grid.h;
        const std::array<std::size_t, 3> at = {i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (at[axis] == 1 || at[axis] + 2 == grid.nodes[axis]) volume *= 0.5;
        grid.fraction[grid.index(i, j, k)] /= volume;
      }
    }
  }
}

vtkNew<vtkDoubleArray> array(const char* name, const std::vector<double>& values) {
  vtkNew<vtkDoubleArray> data;
  data->SetName(name);
  data->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), data->GetPointer(0));
  return data;
}

void make_surface(const SolidNodes& grid, const io::Frame& frame, vtkPolyData& surface) {
  vtkNew<vtkImageData> image;
  image->SetOrigin(grid.origin.data());
  image->SetSpacing(grid.h, grid.h, grid.h);
  image->SetDimensions(static_cast<int>(grid.nodes[0]), static_cast<int>(grid.nodes[1]),
                       static_cast<int>(grid.nodes[2]));
  image->GetPointData()->SetScalars(array("fraction", grid.fraction));
  image->GetPointData()->AddArray(array("value", grid.value));
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.5);
  contour->ComputeNormalsOn();
  contour->InterpolateAttributesOn();
  contour->Update();
  surface.ShallowCopy(contour->GetOutput());
  vtkPoints* const points = surface.GetPoints();
  for (vtkIdType p = 0; points != nullptr && p < points->GetNumberOfPoints(); ++p) {
    Vector x = {};
    points->GetPoint(p, x.data());
    for (std::size_t axis = 0; axis < 3; ++axis) // the outer layer is beyond the grid
      x[axis] = std::clamp(x[axis], frame.lower[axis], frame.upper[axis]);
    points->SetPoint(p, x.data());
  }
}

/// The camera that draws the view's pixels exactly.
void aim(vtkCamera& camera, const ObliqueView& view, const SolidBox& box, int width, int height) {
  const Box& world = view.area.world;
  const Box& pixels = view.area.pixels;
  const double scale = view.area.scale();
  const double u = world.lower.x + (0.5 * width - pixels.lower.x) / scale;
  const double v = world.lower.y + (0.5 * height - pixels.lower.y) / scale;
  const Vector right = ObliqueView::right();
  const Vector up = ObliqueView::up();
  const Vector forward = ObliqueView::forward();
  double depth = 0.0;
  double size = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    depth += 0.5 * (box.lower[axis] + box.upper[axis]) * forward[axis];
    size += box.upper[axis] - box.lower[axis];
  }
  Vector focus = {};
  Vector eye = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    focus[axis] = u * right[axis] + v * up[axis] + depth * forward[axis];
    eye[axis] = focus[axis] - 2.0 * size * forward[axis];
  }
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(focus.data());
  camera.SetPosition(eye.data());
  camera.SetViewUp(up.data());
  camera.SetParallelScale(0.5 * height / scale);
  camera.SetClippingRange(0.01 * size, 6.0 * size);
}

} // namespace

Image draw_surface(const io::Frame& frame, const std::vector<double>& values, const SolidBox& box,
                   const ObliqueView& view, const ColourRange& range, ColourMap colours, int width,
                   int height) {
  VtkErrors errors;
  SolidNodes grid(frame);
  carry_points(grid, frame, values);
  average(grid);
  vtkNew<vtkPolyData> surface;
  make_surface(grid, frame, *surface);

  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(range.bands);
  table->SetTableRange(range.lower, range.upper);
  const std::vector<Colour> bands = band_colours(colours, range.bands);
  for (std::size_t band = 0; band < bands.size(); ++band)
    table->SetTableValue(static_cast<vtkIdType>(band), bands[band].red / 255.0,
                         bands[band].green / 255.0, bands[band].blue / 255.0, 1.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("value");
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn(); // sharp bands
  vtkNew<vtkActor> body;
  body->SetMapper(mapper);
  body->GetProperty()->SetAmbient(0.45);
  body->GetProperty()->SetDiffuse(0.6);
  body->GetProperty()->SetSpecular(0.0);

  vtkNew<vtkPlaneSource> plane;
  const double ground_z = box.lower[2] - 1e-3 * (box.upper[0] - box.lower[0]); // under the body
  plane->SetOrigin(box.lower[0], box.lower[1], ground_z);
  plane->SetPoint1(box.upper[0], box.lower[1], ground_z);
  plane->SetPoint2(box.lower[0], box.upper[1], ground_z);
  vtkNew<vtkPolyDataMapper> plane_mapper;
  plane_mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> ground;
  ground->SetMapper(plane_mapper);
  ground->GetProperty()->SetColor(0.91, 0.91, 0.9);
  ground->GetProperty()->LightingOff();

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(ground);
  if (surface->GetNumberOfPoints() > 0) renderer->AddActor(body);
  aim(*renderer->GetActiveCamera(), view, box, width, height);
  vtkNew<vtkLight> sun; // from the upper left of the picture
  sun->SetLightTypeToCameraLight();
  sun->SetPosition(-0.7, 1.0, 1.0);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(sun);
  Image image = draw(*renderer, width, height);
  errors.check("drawing a surface");
  return image;
}

} // namespace scarp::render

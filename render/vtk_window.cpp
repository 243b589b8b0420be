#include "render/vtk_window.hpp"

#include "render/osmesa_window.hpp"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace scarp::render {

Image draw(vtkRenderer& renderer, int width, int height) {
  constexpr int largest_side = 16384; // llvmpipe's largest texture
  if (width < 1 || height < 1 || width > largest_side || height > largest_side)
    throw std::invalid_argument(
        fmt::format("a picture of {} x {} px: 1 to {} px a side", width, height, largest_side));
  OsmesaWindow::install_as_default();
  vtkNew<OsmesaWindow> window;
  window->SetSize(width, height);
  window->SetMultiSamples(4); // llvmpipe has no more
  window->AddRenderer(&renderer);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels, 0);
  window->RemoveRenderer(&renderer);

  Image image = {width, height, {}};
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(width);
  image.rgb.resize(row_bytes * static_cast<std::size_t>(height));
  for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row) {
    const unsigned char* const from = pixels->GetPointer(0) + row * row_bytes;
    std::copy_n(from, row_bytes,
                image.rgb.data() + (static_cast<std::size_t>(height) - 1 - row) * row_bytes);
  }
  return image;
}

} // namespace scarp::render

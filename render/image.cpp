#include "render/image.hpp"

#include "render/vtk_errors.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>

#include <unistd.h>

namespace scarp::render {

namespace {

// zlib level: figures are flat areas, where higher levels cost time and save little.
constexpr int compression_level = 2;

std::size_t row_bytes(const Image& image) { return 3 * static_cast<std::size_t>(image.width); }

std::size_t expected_bytes(const Image& image) {
  return row_bytes(image) * static_cast<std::size_t>(image.height);
}

/// Whether the file's chunks (length, name, data, checksum) run on to the last one.  libpng ends
/// the program at a file that breaks off.
bool is_whole_png(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  constexpr std::size_t signature = 8;
  constexpr std::size_t frame = 12; // of a chunk without its data
  if (bytes.rfind("\x89PNG", 0) != 0) return false;
  for (std::size_t at = signature; at + frame <= bytes.size();) {
    if (bytes.compare(at + 4, 4, "IEND") == 0) return true;
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
      length = 256 * length + static_cast<unsigned char>(bytes[at + i]);
    at += frame + length;
  }
  return false;
}

} // namespace

void write_png(const std::filesystem::path& file, const Image& image) {
  if (image.width <= 0 || image.height <= 0 || image.rgb.size() != expected_bytes(image))
    throw std::invalid_argument(fmt::format("{}: an image of {} x {} px with {} bytes",
                                            file.string(), image.width, image.height,
                                            image.rgb.size()));
  VtkErrors errors;
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* target = static_cast<unsigned char*>(data->GetScalarPointer());
  for (int row = image.height; row-- > 0;) { // VTK's rows start at the bottom
    const auto begin = image.rgb.begin() + static_cast<std::ptrdiff_t>(row_bytes(image)) * row;
    target = std::copy(begin, begin + static_cast<std::ptrdiff_t>(row_bytes(image)), target);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->SetCompressionLevel(compression_level);
  writer->WriteToMemoryOn();
  writer->Write();
  errors.check(file.string());
  vtkUnsignedCharArray* const bytes = writer->GetResult();

  std::filesystem::path temporary = file;
  temporary += fmt::format(".{}.tmp", getpid());
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes->GetPointer(0)),
            static_cast<std::streamsize>(bytes->GetNumberOfValues()));
  out.close();
  std::error_code failure;
  if (!out) {
    std::filesystem::remove(temporary, failure);
    throw std::runtime_error(fmt::format("cannot write {}", file.string()));
  }
  std::filesystem::rename(temporary, file, failure);
  if (failure) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(fmt::format("cannot write {}: {}", file.string(), failure.message()));
  }
}

Image read_png(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw std::runtime_error(fmt::format("{}: no such file", file.string()));
  if (!is_whole_png(file))
    throw std::runtime_error(fmt::format("{}: not a whole PNG file", file.string()));
  VtkErrors errors;
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  errors.check(file.string());
  vtkImageData* const data = reader->GetOutput();
  if (data->GetScalarType() != VTK_UNSIGNED_CHAR)
    throw std::runtime_error(fmt::format("{}: not 8 bits a channel", file.string()));

  Image image;
  image.width = data->GetDimensions()[0];
  image.height = data->GetDimensions()[1];
  image.rgb.reserve(expected_bytes(image));
  const int channels = data->GetNumberOfScalarComponents();
  const int green = channels >= 3 ? 1 : 0;
  const int blue = channels >= 3 ? 2 : 0;
  for (int row = image.height; row-- > 0;) {
    for (int column = 0; column < image.width; ++column) {
      const auto* pixel = static_cast<const unsigned char*>(data->GetScalarPointer(column, row, 0));
      image.rgb.insert(image.rgb.end(), {pixel[0], pixel[green], pixel[blue]});
    }
  }
  return image;
}

} // namespace scarp::render

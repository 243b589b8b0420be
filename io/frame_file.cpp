#include "io/frame_file.hpp"

#include "io/text.hpp"
#include "io/vtk_errors.hpp"

#include <fmt/format.h>

#include <vtkCellArray.h>
#include <vtkDataCompressor.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <span>
#include <stdexcept>

namespace scarp::io {
namespace {

void check(const Frame& frame) {
  if (frame.position.size() % 3 != 0)
    throw std::runtime_error(
        fmt::format("frame: {} position values are not x y z triples", frame.position.size()));
  std::set<std::string> names;
  for (const Column& column : frame.columns) {
    if (column.name.empty() || !names.insert(column.name).second)
      throw std::runtime_error(
          fmt::format("frame: field name '{}' is empty or used twice", column.name));
    const std::size_t expected = frame.size() * static_cast<std::size_t>(column.components);
    if (column.components < 1 || column.values.size() != expected)
      throw std::runtime_error(
          fmt::format("frame: field '{}' has {} values instead of {} points times {} components",
                      column.name, column.values.size(), frame.size(), column.components));
  }
}

template <typename Array>
vtkNew<Array> make_array(const std::string& name, int components, auto&& values) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(std::size(values)) / components);
  std::copy(std::begin(values), std::end(values), array->GetPointer(0));
  return array;
}

// Errors of the decompressor reach nobody in VTK's own reader, so this one observes it too.
class FrameReader : public vtkXMLPolyDataReader {
 public:
  static FrameReader* New() { VTK_STANDARD_NEW_BODY(FrameReader); }
  vtkNew<VtkErrors> errors;

 protected:
  FrameReader() {
    errors->observe(*this);
    SetReaderErrorObserver(errors);
    SetParserErrorObserver(errors);
  }
  int ReadXMLInformation() override {
    const int done = vtkXMLPolyDataReader::ReadXMLInformation();
    if (XMLParser != nullptr && XMLParser->GetCompressor() != nullptr)
      errors->observe(*XMLParser->GetCompressor());
    return done;
  }
};

// VTK reads what there is of a file that was cut off.
void check_complete(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw std::runtime_error("cannot be opened for reading");
  constexpr std::streamoff tail_length = 64;
  stream.seekg(0, std::ios::end);
  stream.seekg(-std::min<std::streamoff>(tail_length, stream.tellg()), std::ios::end);
  const std::string tail{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (tail.find("</VTKFile>") == std::string::npos)
    throw std::runtime_error("is not a complete VTK file (cut off?)");
}

template <std::size_t Size>
std::array<double, Size> field_values(vtkFieldData& fields, const char* name) {
  vtkDataArray* array = fields.GetArray(name);
  if (array == nullptr || array->GetNumberOfValues() != static_cast<vtkIdType>(Size))
    throw std::runtime_error(
        fmt::format("has no field data '{}' of {} value(s): not written by scarp", name, Size));
  std::array<double, Size> values{};
  for (std::size_t i = 0; i < Size; ++i)
    values[i] = array->GetVariantValue(static_cast<vtkIdType>(i)).ToDouble();
  return values;
}

std::vector<double> all_values(vtkDataArray& array) {
  const int components = array.GetNumberOfComponents();
  std::vector<double> values(static_cast<std::size_t>(array.GetNumberOfValues()));
  for (vtkIdType tuple = 0; tuple < array.GetNumberOfTuples(); ++tuple)
    array.GetTuple(tuple, &values[static_cast<std::size_t>(tuple * components)]);
  return values;
}

Frame to_frame(vtkPolyData& data) {
  Frame frame;
  vtkFieldData& fields = *data.GetFieldData();
  frame.time = field_values<1>(fields, "TimeValue")[0];
  frame.step = std::lround(field_values<1>(fields, "Step")[0]);
  frame.dimension = static_cast<int>(field_values<1>(fields, "Dimension")[0]);
  frame.cell_size = field_values<1>(fields, "CellSize")[0];
  frame.lower = field_values<3>(fields, "Lower");
  frame.upper = field_values<3>(fields, "Upper");
  if (data.GetPoints() != nullptr) frame.position = all_values(*data.GetPoints()->GetData());

  vtkPointData& columns = *data.GetPointData();
  for (int i = 0; i < columns.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = columns.GetArray(i);
    if (array == nullptr) continue;
    const char* name = columns.GetArrayName(i);
    if (static_cast<std::size_t>(array->GetNumberOfTuples()) != frame.size())
      throw std::runtime_error(fmt::format("field '{}' has {} entries for {} points",
                                           name != nullptr ? name : "", array->GetNumberOfTuples(),
                                           frame.size()));
    frame.columns.push_back(
        {name != nullptr ? name : "", array->GetNumberOfComponents(), all_values(*array)});
  }
  return frame;
}

} // namespace

std::string encode_frame(const Frame& frame) {
  check(frame);
  const auto count = static_cast<vtkIdType>(frame.size());
  vtkNew<vtkPolyData> data;

  vtkNew<vtkPoints> points;
  points->SetData(make_array<vtkDoubleArray>("Points", 3, frame.position));
  data->SetPoints(points);

  // One vertex a point, not one poly-vertex: ParaView's Threshold keeps or drops whole cells.
  vtkNew<vtkCellArray> vertices;
  vertices->Use32BitStorage();
  vertices->AllocateExact(count, count);
  for (vtkIdType point = 0; point < count; ++point) vertices->InsertNextCell(1, &point);
  data->SetVerts(vertices);

  for (const Column& column : frame.columns)
    data->GetPointData()->AddArray(
        make_array<vtkDoubleArray>(column.name, column.components, column.values));

  vtkFieldData& fields = *data->GetFieldData();
  const auto add = [&]<typename Array>(vtkNew<Array> array) { fields.AddArray(array); };
  add(make_array<vtkDoubleArray>("TimeValue", 1, std::array{frame.time}));
  add(make_array<vtkTypeInt64Array>("Step", 1, std::array{frame.step}));
  add(make_array<vtkTypeInt64Array>("Dimension", 1, std::array{frame.dimension}));
  add(make_array<vtkDoubleArray>("CellSize", 1, std::array{frame.cell_size}));
  add(make_array<vtkDoubleArray>("Lower", 3, frame.lower));
  add(make_array<vtkDoubleArray>("Upper", 3, frame.upper));

  vtkNew<VtkErrors> errors;
  vtkNew<vtkXMLPolyDataWriter> writer;
  errors->observe(*writer);
  writer->SetInputData(data);
  writer->SetDataModeToBinary();
  writer->SetCompressionLevel(1); // a quarter faster than the default 5, 1 % larger
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0 || !errors->text().empty())
    throw std::runtime_error(fmt::format("frame: VTK cannot encode it: {}", errors->text()));
  return writer->GetOutputString();
}

Frame read_frame(const std::filesystem::path& file) {
  try {
    check_complete(file);
    vtkNew<FrameReader> reader;
    // The pipeline reports what its reader has reported, in more words.
    vtkNew<VtkErrors> pipeline_errors;
    pipeline_errors->observe(*reader->GetExecutive());
    reader->SetFileName(file.c_str());
    reader->Update();
    for (const std::string& text : {reader->errors->text(), pipeline_errors->text()})
      if (!text.empty()) throw std::runtime_error(text);
    return to_frame(*reader->GetOutput());
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

} // namespace scarp::io

#include "io/series.hpp"

#include "io/atomic_file.hpp"
#include "io/frame_file.hpp"
#include "io/text.hpp"
#include "io/vtk_errors.hpp"

#include <fmt/format.h>

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace scarp::io {
namespace {
namespace fs = std::filesystem;

std::string frame_name(const std::string& name, std::size_t index) {
  return fmt::format("{}_{:06}.vtp", name, index);
}

bool is_frame_of(const std::string& series, std::string_view file) {
  if (!file.starts_with(series + "_")) return false;
  file.remove_prefix(series.size() + 1);
  if (file.ends_with(".partial")) file.remove_suffix(std::string_view(".partial").size());
  if (!file.ends_with(".vtp")) return false;
  file.remove_suffix(std::string_view(".vtp").size());
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return file.size() >= 6 && std::ranges::all_of(file, is_digit);
}

// The .pvd goes first: at no moment does it list a file that is gone.
void remove_series(const fs::path& directory, const std::string& name, const fs::path& keep) {
  fs::remove(directory / (name + ".pvd"));
  std::vector<fs::path> frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const bool old = is_frame_of(name, entry.path().filename().string()) && entry.path() != keep;
    if (old && entry.is_regular_file()) frames.push_back(entry.path());
  }
  for (const fs::path& frame : frames) fs::remove(frame);
}

std::string xml_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string collection(const std::string& name, const std::vector<double>& times) {
  std::string text = "<?xml version=\"1.0\"?>\n"
                     "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                     "  <Collection>\n";
  for (std::size_t i = 0; i < times.size(); ++i)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                        number_text(times[i]), xml_escaped(frame_name(name, i)));
  return text + "  </Collection>\n</VTKFile>\n";
}

fs::path find_collection(const fs::path& where) {
  if (!fs::exists(where))
    throw std::runtime_error(
        fmt::format("{}: there is no such series (.pvd file or directory)", where.string()));
  if (!fs::is_directory(where)) {
    if (where.extension() == ".pvd") return where;
    throw std::runtime_error(fmt::format("{}: is not a .pvd file", where.string()));
  }
  std::vector<std::string> collections;
  for (const fs::directory_entry& entry : fs::directory_iterator(where))
    if (entry.path().extension() == ".pvd") collections.push_back(entry.path().filename().string());
  std::ranges::sort(collections);
  if (collections.size() == 1) return where / collections.front();
  throw std::runtime_error(
      collections.empty()
          ? fmt::format("{}: the directory holds no .pvd file", where.string())
          : fmt::format("{}: the directory holds {} series, {}: name one of the .pvd files",
                        where.string(), collections.size(), quoted_list(collections, "and")));
}

std::string attribute(vtkXMLDataElement& element, const char* name) {
  const char* value = element.GetAttribute(name);
  if (value == nullptr)
    throw std::runtime_error(fmt::format("a DataSet has no attribute '{}'", name));
  return value;
}

} // namespace

SeriesWriter::SeriesWriter(fs::path directory, std::string name)
    : directory_(std::move(directory)), name_(std::move(name)) {
  if (name_.empty() || name_.find('/') != std::string::npos)
    throw std::runtime_error(fmt::format("'{}' is no name for a series of files", name_));
  std::error_code error;
  fs::create_directories(directory_, error);
  if (error || !fs::is_directory(directory_))
    throw std::runtime_error(fmt::format("{}: cannot make the directory: {}", directory_.string(),
                                         error ? error.message() : "a file is in the way"));
}

void SeriesWriter::write(const Frame& frame) {
  std::vector<double> times = times_;
  times.push_back(frame.time);
  const fs::path file = directory_ / frame_name(name_, times_.size());

  StagedFile frame_file(file, encode_frame(frame));
  StagedFile collection_file(directory_ / (name_ + ".pvd"), collection(name_, times));
  if (times_.empty()) remove_series(directory_, name_, StagedFile::staging_path(file));
  frame_file.commit();
  collection_file.commit();
  times_ = std::move(times);
}

SeriesReader::SeriesReader(const fs::path& where) {
  const fs::path file = find_collection(where);
  name_ = file.stem().string();
  std::istringstream text(read_text(file));
  vtkNew<VtkErrors> errors;
  vtkNew<vtkXMLDataParser> parser;
  errors->observe(*parser);
  parser->SetStream(&text);
  try {
    if (parser->Parse() == 0 || !errors->text().empty())
      throw std::runtime_error(fmt::format("is not valid XML: {}", errors->text()));
    vtkXMLDataElement* root = parser->GetRootElement();
    vtkXMLDataElement* list =
        root == nullptr ? nullptr : root->FindNestedElementWithName("Collection");
    if (list == nullptr) throw std::runtime_error("holds no <Collection>");
    for (int i = 0; i < list->GetNumberOfNestedElements(); ++i) {
      vtkXMLDataElement& entry = *list->GetNestedElement(i);
      entries_.push_back({parse_number(attribute(entry, "timestep")),
                          file.parent_path() / attribute(entry, "file")});
    }
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Frame SeriesReader::read(std::size_t index) const { return read_frame(entries_.at(index).file); }

} // namespace scarp::io

#include "io/vtk_errors.hpp"

#include <vtkObject.h>

#include <algorithm>
#include <string_view>

namespace scarp::io {

void VtkErrors::Execute(vtkObject*, unsigned long, void* data) {
  if (data == nullptr) return;
  // VTK's text is "ERROR: In FILE, line N\nCLASS (ADDRESS): MESSAGE\n\n".
  std::string_view message = static_cast<const char*>(data);
  const std::size_t prefix = message.find("): ");
  if (prefix != std::string_view::npos) message.remove_prefix(prefix + 3);
  // VTK notes the range of every vector beside it and cannot read an infinite one back; nobody
  // needs the note, and the values are whole.
  if (message.find("vtkDataArray::L2_NORM_RANGE") != std::string_view::npos) return;
  std::string line(message);
  std::ranges::replace(line, '\n', ' ');
  line.erase(line.find_last_not_of(' ') + 1);
  if (!text_.empty()) text_ += "; ";
  text_ += line;
}

void VtkErrors::observe(vtkObject& object) {
  object.AddObserver(vtkCommand::ErrorEvent, this);
  object.AddObserver(vtkCommand::WarningEvent, this);
}

} // namespace scarp::io

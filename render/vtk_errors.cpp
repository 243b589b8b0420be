#include "render/vtk_errors.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <stdexcept>

namespace scarp::render {

namespace {

class KeepingWindow : public vtkOutputWindow {
 public:
  static KeepingWindow* New();
  KeepingWindow(const KeepingWindow&) = delete;
  KeepingWindow& operator=(const KeepingWindow&) = delete;

  void DisplayText(const char* text) override {
    if (first.empty() && text != nullptr) first = text;
  }
  // Debug text is no error; everything else is.
  void DisplayDebugText(const char*) override {}

  std::string first;

 protected:
  KeepingWindow() = default;
};

vtkStandardNewMacro(KeepingWindow);

} // namespace

struct VtkErrors::Messages {
  vtkSmartPointer<vtkOutputWindow> previous;
  vtkSmartPointer<KeepingWindow> kept;
  vtkLogger::Verbosity verbosity = vtkLogger::GetCurrentVerbosityCutoff();
};

VtkErrors::VtkErrors() : messages_(std::make_unique<Messages>()) {
  messages_->previous = vtkOutputWindow::GetInstance();
  messages_->kept = vtkSmartPointer<KeepingWindow>::New();
  vtkOutputWindow::SetInstance(messages_->kept);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkErrors::~VtkErrors() {
  vtkLogger::SetStderrVerbosity(messages_->verbosity);
  vtkOutputWindow::SetInstance(messages_->previous);
}

void VtkErrors::check(const std::string& action) const {
  const std::string& first = messages_->kept->first;
  if (!first.empty()) throw std::runtime_error(action + ": " + first);
}

} // namespace scarp::render

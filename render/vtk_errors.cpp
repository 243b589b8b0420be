#include "render/vtk_errors.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <stdexcept>

namespace scarp::render {

struct VtkErrors::Messages {
  class Window : public vtkOutputWindow {
   public:
    static Window* New();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    void DisplayText(const char* text) override {
      if (first.empty() && text != nullptr) first = text;
    }
    // Debug text is no error; everything else is.
    void DisplayDebugText(const char*) override {}

    std::string first;

   protected:
    Window() = default;
  };

  vtkSmartPointer<vtkOutputWindow> previous;
  vtkSmartPointer<Window> kept;
  vtkLogger::Verbosity verbosity = vtkLogger::GetCurrentVerbosityCutoff();
};

vtkStandardNewMacro(VtkErrors::Messages::Window);

VtkErrors::VtkErrors() : messages_(std::make_unique<Messages>()) {
  messages_->previous = vtkOutputWindow::GetInstance();
  messages_->kept = vtkSmartPointer<Messages::Window>::New();
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

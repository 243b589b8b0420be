// VTK reports through events; here they become text.
#pragma once

#include <vtkCommand.h>

#include <string>

namespace scarp::io {

/// Collects the error and warning texts of the VTK objects it observes.
class VtkErrors : public vtkCommand {
 public:
  static VtkErrors* New() { return new VtkErrors; }
  void Execute(vtkObject* sender, unsigned long event, void* data) override;

  /// Makes the object report here instead of printing.
  void observe(vtkObject& object);
  /// What was reported so far, in one line; empty: nothing.
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

} // namespace scarp::io

// VTK reports errors as text on a global window; here they become exceptions.
#pragma once

#include <memory>
#include <string>

namespace scarp::render {

/// While it lives, VTK's error and warning messages are kept instead of printed; the previous
/// message window comes back at the end.  Not for several threads at once: VTK has one window.
class VtkErrors {
 public:
  VtkErrors();
  ~VtkErrors();
  VtkErrors(const VtkErrors&) = delete;
  VtkErrors& operator=(const VtkErrors&) = delete;

  /// Throws std::runtime_error "ACTION: MESSAGE" with the first message there was, if any.
  void check(const std::string& action) const;

 private:
  struct Messages;
  std::unique_ptr<Messages> messages_;
};

} // namespace scarp::render

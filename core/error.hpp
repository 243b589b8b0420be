// What goes wrong during a run.
#pragma once

#include <array>
#include <stdexcept>
#include <string>

namespace scarp {

/// The scene cannot be simulated as it is.
class SetupError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The run cannot go on.  A point that would leave the grid is still where it was before the step.
class RunError : public std::runtime_error {
 public:
  RunError(const std::string& what, long step, double time, std::size_t point,
           std::array<double, 3> position)
      : std::runtime_error(what), step_(step), time_(time), point_(point), position_(position) {}

  long step() const { return step_; }
  double time() const { return time_; }                               ///< s
  std::size_t point() const { return point_; }                        ///< in the order of creation
  const std::array<double, 3>& position() const { return position_; } ///< m, x y z

 private:
  long step_;
  double time_;
  std::size_t point_;
  std::array<double, 3> position_;
};

} // namespace scarp

// The parts that random scenes are made of.
#pragma once

#include "core/scene.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace scarp::apps {

/// The standard's distributions differ from library to library; its engine does not.
class Random {
 public:
  Random(std::uint64_t seed, std::size_t number) {
    std::seed_seq mixed = {seed & 0xffffffffU, seed >> 32U, number & 0xffffffffU, number >> 32U};
    engine_.seed(mixed);
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  bool chance(double part) { return between(0.0, 1.0) < part; }
  int whole(int low, int high) { return low + static_cast<int>(between(0.0, high - low + 1.0)); }

 private:
  std::mt19937_64 engine_;
};

/// x and z in cells, from the grid's lower corner.
using Shape = std::vector<std::array<double, 2>>;

/// A scene that has its grid, its method and the size of its body, but no body yet.  Lengths are in
/// cells and times in parts of the run until finish().
class StressDraft {
 public:
  StressDraft(Preset preset, std::uint64_t seed, std::size_t number);

  /// The grid around the body, its walls, and how long the run takes.
  Scene finish();

 protected:
  /// A new one, and its name; `contrast`: its density by that of the first.
  std::string material(double contrast = 1.0);
  /// m/s, any direction, up to a part of the last material's wave speed.
  std::array<double, 3> speed(double part_of_wave);
  void add(Shape shape, const std::string& material, std::array<double, 3> velocity = {0, 0, 0});

  Random random_;
  Scene scene_;
  double x_ = 0.0; ///< cells, lower corner of the body
  double z_ = 0.0;
  double width_ = 1.0; ///< cells
  double height_ = 1.0;
  double depth_ = 1.0;
  double stiffness_ = 1.0; ///< Young's modulus by the body's weight per area
  double gate_ = 0.0;      ///< cells; 0: none
  bool confined_ = false;

 private:
  void start_grid();
  void start_body();
  void choose_gravity();
  void choose_method(Preset preset);
  DruckerPrager soil(double weight);
  Wall wall();
  void close_grid();
  void scale();
  void choose_time();

  std::array<double, 3> cells_ = {};
};

} // namespace scarp::apps

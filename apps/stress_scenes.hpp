// Seeded random scenes that try the solver's stability.
#pragma once

#include "core/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scarp::apps {

struct StressScene {
  std::size_t number = 0;
  std::string family; ///< what it tries: one of stress_families()
  Scene scene;        ///< at most about 500 points and 3000 steps
};

const std::vector<std::string>& stress_families();

/// Scene `number` of a seed; it depends on these two only, and is the same on every machine.
StressScene stress_scene(Preset preset, std::uint64_t seed, std::size_t number);

} // namespace scarp::apps

// The state that a stage begins from: the last frame of another run.
#pragma once

#include "core/simulation.hpp"
#include "io/frame.hpp"

#include <filesystem>
#include <memory>

namespace scarp::io {

/// Throws std::runtime_error if the frame lacks a field (it was written with some only).
Snapshot snapshot_of(const Frame& frame);

/// make_simulation(scene), with the state of the run that a stage begins from, if one does; a path
/// that is not absolute starts at the working directory.  Throws SetupError, also if that run ended
/// at another time than the stages before this one last; std::runtime_error if it cannot be read.
std::unique_ptr<Simulation> make_simulation_from_files(const Scene& scene);

} // namespace scarp::io

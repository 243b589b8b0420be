// What a run leaves on disk: DIR/NAME.pvd with its frames, DIR/history.csv, DIR/run.json.
#pragma once

#include "core/run.hpp"
#include "io/frame.hpp"
#include "io/history.hpp"
#include "io/series.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scarp::io {

/// The chosen fields (all, if none is named) of the present state.
Frame frame_of(const Simulation& simulation, const Scene& scene);

/// Writes as the run goes on, so that a killed run leaves complete frames and rows.  Functions
/// throw std::runtime_error when something cannot be written.
class RunRecorder : public Observer {
 public:
  RunRecorder(const Scene& scene, const Simulation& simulation, std::filesystem::path directory,
              const std::string& name, int threads);

  void frame(const Simulation& simulation) override;
  void history(const Simulation& simulation, const Energies& energies) override;

  /// run.json: version, scene with every option, points, steps, step sizes, wall time, speed, peak
  /// memory, energies, how the run ended.  `failure` is the message of a run that could not go on.
  void finish(const Simulation& simulation, const std::optional<RunSummary>& summary,
              const std::string& failure);

  double wall_seconds() const;

 private:
  Scene scene_;
  std::filesystem::path directory_;
  int threads_;
  SeriesWriter series_;
  std::optional<HistoryWriter> history_;
  std::vector<std::size_t> monitored_; ///< points
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace scarp::io

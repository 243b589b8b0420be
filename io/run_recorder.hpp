// What a run leaves on disk: DIR/NAME.pvd with its frames, DIR/history.csv, DIR/run.json.
#pragma once

#include "core/run.hpp"
#include "io/frame.hpp"
#include "io/frame_queue.hpp"
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

/// Writes as the run goes on, so that a killed run leaves complete frames and rows: rows at once,
/// frames from copies and by another thread, which may still be at the last ones when the run is
/// further.  Functions throw std::runtime_error when something cannot be written, of a frame at the
/// next call of any of them.  Without finish() the destructor still writes the frames it was given.
class RunRecorder : public Observer {
 public:
  RunRecorder(const Scene& scene, const Simulation& simulation, std::filesystem::path directory,
              const std::string& name, int threads);

  void frame(const Simulation& simulation) override;
  void history(const Simulation& simulation, const Energies& energies) override;
  /// Only asks whether the frames could be written.
  void progress(const Simulation& simulation) override;

  /// What is written and when, and what is left out: for the user to read.
  std::vector<PlanLine> plan() const;

  /// Waits for the last frame, then writes run.json: version, scene with every option, points,
  /// steps, step sizes, wall time, speed, peak memory, energies, how the run ended.  `failure` is
  /// the message of a run that could not go on.
  void finish(const Simulation& simulation, const std::optional<RunSummary>& summary,
              const std::string& failure);

  double wall_seconds() const;

 private:
  Scene scene_;
  std::filesystem::path directory_;
  int threads_;
  SeriesWriter series_; ///< of the thread that writes frames until finish() has waited for it
  std::optional<HistoryWriter> history_;
  std::vector<std::size_t> monitored_; ///< points
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  FrameQueue frames_; ///< last: its thread uses series_
};

} // namespace scarp::io

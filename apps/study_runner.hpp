// The runs of a study, side by side, each a process of its own.
#pragma once

#include "io/study_file.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace scarp::apps {

/// Every count-th scenario, beginning with number `index`, from 1 to count.
struct StudyShard {
  std::size_t index = 1;
  std::size_t count = 1;
};

struct StudyOptions {
  std::filesystem::path out;
  int jobs = 0;    ///< runs side by side; 0: as many as there are processors
  int threads = 1; ///< of each run
  StudyShard shard;
};

struct StudyOutcome {
  std::size_t scenarios = 0;       ///< of the shard
  std::size_t kept = 0;            ///< finished in an earlier call
  std::size_t finished = 0;        ///< those and the ones run now
  std::vector<std::string> failed; ///< names
  int signal = 0;                  ///< that ended the study before its time
  double wall = 0.0;               ///< s
};

/// Runs what has not finished yet.  A scenario runs in OUT/NAME.partial, which becomes OUT/NAME
/// once it has ended well and OUT/NAME.failed if not; both hold log.txt.  A finished one is run
/// again if its scene has changed.  What several scenarios begin with runs once, in OUT/shared.
/// Tells on stderr why a scenario failed and, on a terminal, how far the study is.
/// Throws UsageError if the directory is no directory, is in use, or holds something else under a
/// scenario's name.
StudyOutcome run_study(const io::Study& study, const StudyOptions& options);

} // namespace scarp::apps

// A file that only one process at a time, or only those that agree, may hold.
#pragma once

#include <filesystem>

namespace scarp::apps {

/// Held until it goes, or the process ends in whatever way (flock).
class FileLock {
 public:
  enum class Kind { alone, together };

  /// Makes the file if there is none.  Throws UsageError if another process holds the lock in a way
  /// that does not go with this one, std::system_error if the file cannot be opened.
  FileLock(const std::filesystem::path& file, Kind kind);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  int descriptor_;
};

} // namespace scarp::apps

// Files that are either complete or not there, whatever happens while they are written.
#pragma once

#include <filesystem>
#include <string_view>

namespace scarp::io {

/// A complete file under the name PATH.partial, flushed to disk, that `commit` gives its real name.
/// Staging several files before the first commit keeps them consistent when the disk is full.
class StagedFile {
 public:
  /// Throws std::runtime_error with path and reason, leaving nothing behind.  A target that is
  /// there and is no regular file (a directory, a device) is an error.
  StagedFile(std::filesystem::path target, std::string_view content);
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  /// Removes the staged file unless it was committed.
  ~StagedFile();

  /// Renames onto the target, replacing a file of that name.  Throws std::runtime_error.
  void commit();

  /// The name that a target has until it is committed.
  static std::filesystem::path staging_path(const std::filesystem::path& target);

 private:
  std::filesystem::path target_;
  bool committed_ = false;
};

/// Stages and commits one file.  Throws std::runtime_error, with an older file as it was.
void write_atomically(const std::filesystem::path& target, std::string_view content);

} // namespace scarp::io

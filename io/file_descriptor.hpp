// An open file of the operating system, for writers that must know that their bytes arrived.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace scarp::io {

/// What an errno value means to a user; ENOSPC and EDQUOT say "disk full".
std::string errno_text(int error);

/// Writes to one file; every error is a std::runtime_error with the path and the errno text.
class FileDescriptor {
 public:
  /// Makes the file or empties the one there is.
  explicit FileDescriptor(std::filesystem::path path);
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  ~FileDescriptor();

  /// Appends all of the data, or throws with the file cut back to the length it had.
  void write(std::string_view data);
  /// Forces what was written to the disk.
  void sync();
  /// Closes the file; some file systems report a failed write only here.
  void close();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t length_ = 0;
};

/// Forces the names in a directory to the disk.  Throws std::runtime_error.
void sync_directory(const std::filesystem::path& directory);

} // namespace scarp::io

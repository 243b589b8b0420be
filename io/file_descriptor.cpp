#include "io/file_descriptor.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace scarp::io {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view what, int error) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), what, errno_text(error)));
}

// File systems that cannot sync (EINVAL) have nothing to be synced.
bool synced(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL; }

} // namespace

std::string errno_text(int error) {
  const std::string text = std::generic_category().message(error);
  return error == ENOSPC || error == EDQUOT ? fmt::format("disk full ({})", text) : text;
}

FileDescriptor::FileDescriptor(std::filesystem::path path) : path_(std::move(path)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(path_, "cannot open for writing", errno);
}

FileDescriptor::FileDescriptor(FileDescriptor&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)),
      length_(other.length_) {}

FileDescriptor::~FileDescriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void FileDescriptor::write(std::string_view data) {
  std::size_t done = 0;
  while (done < data.size()) {
    const ssize_t count = ::write(descriptor_, data.data() + done, data.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      if (::ftruncate(descriptor_, static_cast<off_t>(length_)) == 0)
        ::lseek(descriptor_, static_cast<off_t>(length_), SEEK_SET);
      fail(path_, "cannot write", error);
    }
    done += static_cast<std::size_t>(count);
  }
  length_ += data.size();
}

void FileDescriptor::sync() {
  if (!synced(descriptor_)) fail(path_, "cannot flush", errno);
}

void FileDescriptor::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, "cannot close", errno);
}

void sync_directory(const std::filesystem::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail(directory, "cannot open the directory", errno);
  const bool done = synced(descriptor);
  const int error = errno;
  ::close(descriptor);
  if (!done) fail(directory, "cannot flush the directory", error);
}

} // namespace scarp::io

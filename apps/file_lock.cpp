#include "apps/file_lock.hpp"

#include "apps/usage.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace scarp::apps {

FileLock::FileLock(const std::filesystem::path& file, Kind kind)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), file.string());
  if (::flock(descriptor_, (kind == Kind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return;
  const int error = errno;
  ::close(descriptor_);
  if (error == EWOULDBLOCK)
    throw UsageError("another process is at this study: it holds " + file.string());
  throw std::system_error(error, std::generic_category(), file.string());
}

FileLock::~FileLock() { ::close(descriptor_); }

} // namespace scarp::apps

#include "io/atomic_file.hpp"

#include "io/file_descriptor.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>
#include <utility>

namespace scarp::io {
namespace fs = std::filesystem;

fs::path StagedFile::staging_path(const fs::path& target) {
  fs::path staged = target;
  staged += ".partial";
  return staged;
}

StagedFile::StagedFile(fs::path target, std::string_view content) : target_(std::move(target)) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw std::runtime_error(
        fmt::format("{}: cannot write: there is something of that name that is no regular file",
                    target_.string()));

  FileDescriptor file(staging_path(target_));
  try {
    file.write(content);
    file.sync();
    file.close();
  } catch (...) {
    fs::remove(file.path(), error);
    throw;
  }
}

StagedFile::~StagedFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(staging_path(target_), ignored);
}

void StagedFile::commit() {
  std::error_code error;
  fs::rename(staging_path(target_), target_, error);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot rename '{}' to this name: {}",
                                         target_.string(), staging_path(target_).string(),
                                         errno_text(error.value())));
  committed_ = true;
  sync_directory(target_.has_parent_path() ? target_.parent_path() : fs::path("."));
}

void write_atomically(const fs::path& target, std::string_view content) {
  StagedFile staged(target, content);
  staged.commit();
}

} // namespace scarp::io

#include "io/atomic_file.hpp"
#include "io/file_descriptor.hpp"
#include "io/json_record.hpp"

#include "io_files.hpp"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cmath>
#include <stdexcept>

using namespace scarp;
using namespace scarp::io;
using namespace scarp::test;

TEST(AtomicFile, ReplacesAFileAndLeavesNothingElse) {
  const fs::path directory = fresh_directory();
  write_atomically(directory / "a.txt", "old");
  write_atomically(directory / "a.txt", std::string("n\0w", 3));
  EXPECT_EQ(content(directory / "a.txt"), std::string("n\0w", 3));
  EXPECT_EQ(names_in(directory), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, AFailedWriteKeepsTheOldFileAndSaysWhy) {
  const fs::path directory = fresh_directory();
  const fs::path file = write_file(directory / "a.txt", "old");
  std::string error;
  {
    const FileSizeLimit limit(1000);
    error = error_of<std::runtime_error>([&] { write_atomically(file, std::string(5000, 'x')); });
  }
  EXPECT_EQ(error, file.string() + ".partial: cannot write: File too large");
  EXPECT_EQ(content(file), "old");
  EXPECT_EQ(names_in(directory), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, AStagedFileIsRemovedUnlessCommitted) {
  const fs::path directory = fresh_directory();
  {
    const StagedFile staged(directory / "a.txt", "text");
    EXPECT_EQ(names_in(directory), std::vector<std::string>{"a.txt.partial"});
  }
  EXPECT_TRUE(names_in(directory).empty());
}

TEST(AtomicFile, NamesTheDirectoryThatIsMissing) {
  const fs::path file = fresh_directory() / "none" / "a.txt";
  EXPECT_EQ(error_of<std::runtime_error>([&] { write_atomically(file, ""); }),
            file.string() + ".partial: cannot open for writing: No such file or directory");
}

TEST(AtomicFile, DoesNotReplaceADevice) {
  EXPECT_EQ(error_of<std::runtime_error>([] { write_atomically("/dev/full", "x"); }),
            "/dev/full: cannot write: there is something of that name that is no regular file");
}

TEST(AtomicFile, AFullDiskIsCalledThat) {
  EXPECT_EQ(errno_text(ENOSPC), "disk full (No space left on device)");
  EXPECT_EQ(errno_text(EACCES), "Permission denied");
}

TEST(JsonRecord, KeepsTheOrderOfKeysAndWritesNullForNan) {
  const fs::path file = fresh_directory() / "run.json";
  write_json(file, nlohmann::ordered_json{{"z", 1}, {"a", {0.1, std::nan("")}}});
  EXPECT_EQ(content(file), "{\n  \"z\": 1,\n  \"a\": [\n    0.1,\n    null\n  ]\n}\n");
}

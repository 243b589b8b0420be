#include "io/history.hpp"
#include "io/table.hpp"

#include "io_files.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace scarp::io;
using namespace scarp::test;

namespace {

std::string read_error(const std::string& text) {
  const fs::path file = write_file(fresh_directory() / "t.csv", text);
  std::string error = error_of<std::runtime_error>([&] { read_table(file); });
  return error.substr(error.find("t.csv"));
}

} // namespace

TEST(Table, ReadsCommentsHeaderAndNumbers) {
  const fs::path file = write_file(fresh_directory() / "t.csv",
                                   "# source\r\nx_m, z_m\r\n\r\n0.25,-1e-3\r\n# more\n3 , nan\n");
  const Table table = read_table(file);
  EXPECT_EQ(table.names, (std::vector<std::string>{"x_m", "z_m"}));
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.column("x_m"), (std::vector<double>{0.25, 3.0}));
  EXPECT_EQ(table.column("z_m")[0], -1e-3);
  EXPECT_TRUE(std::isnan(table.column("z_m")[1]));
  EXPECT_EQ(error_of<std::runtime_error>([&] { table.column("z"); }),
            "the table has no column 'z'; it has 'x_m' and 'z_m' (did you mean 'z_m'?)");
}

TEST(Table, ReadsWords) {
  const fs::path file = write_file(fresh_directory() / "t.csv", "# source\nname,x_m\n\na b , 3\n");
  const TextTable table = read_text_table(file);
  EXPECT_EQ(table.names, (std::vector<std::string>{"name", "x_m"}));
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"a b", "3"}));
  EXPECT_EQ(table.lines, std::vector<int>{4});
}

TEST(Table, ReadsTheReferenceData) {
  const fs::path data = fs::path(SCARP_SOURCE_DIR) / "data" / "reference";
  EXPECT_EQ(read_table(data / "wu2017_table1.csv").rows(), 29U);
  EXPECT_GT(read_table(data / "bui2008_surface.csv").column("x_m").size(), 10U);
}

TEST(Table, ErrorsNameFileAndLine) {
  EXPECT_EQ(read_error("# c\na,b\n1,2\n3\n"), "t.csv:4: 1 values for 2 columns");
  EXPECT_EQ(read_error("a,b\n1,2x\n"), "t.csv:2: column 'b': '2x' is not a number");
  EXPECT_EQ(read_error("a,b\n1,\n"), "t.csv:2: column 'b': '' is not a number");
  EXPECT_EQ(read_error("a,a\n"), "t.csv:1: two columns are named 'a'");
  EXPECT_EQ(read_error("a,\n"), "t.csv:1: a column has no name");
  EXPECT_EQ(read_error("# nothing\n"), "t.csv: the table has no header line");
  EXPECT_EQ(error_of<std::runtime_error>([] { read_table("/none.csv"); }),
            "/none.csv: cannot read: No such file or directory");
}

TEST(History, RowsReadBackExactlyWhileTheRunGoesOn) {
  const fs::path file = fresh_directory() / "history.csv";
  const std::vector<std::vector<double>> rows = {
      {0.0, 1.0 / 3.0}, {0.1, -5e-324}, {1e22, std::numeric_limits<double>::infinity()}};
  HistoryWriter writer(file, {"time_s", "kinetic_energy_J"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    writer.row(rows[i]);
    const Table table = read_table(file);
    ASSERT_EQ(table.rows(), i + 1);
    EXPECT_EQ(table.columns[0][i], rows[i][0]);
    EXPECT_EQ(table.columns[1][i], rows[i][1]);
  }
  EXPECT_EQ(content(file).substr(0, 24), "time_s,kinetic_energy_J\n");
}

TEST(History, AFullDiskIsCalledThat) {
  EXPECT_EQ(error_of<std::runtime_error>([] { HistoryWriter("/dev/full", {"time_s"}); }),
            "/dev/full: cannot write: disk full (No space left on device)");
}

TEST(History, AFailedRowLeavesTheRowsBefore) {
  const fs::path file = fresh_directory() / "history.csv";
  HistoryWriter writer(file, {"time_s", "x_m"});
  writer.row(std::vector{1.0, 2.0});
  const std::string before = content(file);
  {
    const FileSizeLimit limit(before.size() + 3);
    EXPECT_EQ(error_of<std::runtime_error>([&] {
                writer.row(std::vector{3.125, 4.125});
              }),
              file.string() + ": cannot write: File too large");
  }
  EXPECT_EQ(content(file), before);
  writer.row(std::vector{5.0, 6.0});
  EXPECT_EQ(content(file), before + "5,6\n");
}

TEST(History, RejectsWhatATableCannotHold) {
  const fs::path file = write_file(fresh_directory() / "history.csv", "old");
  EXPECT_EQ(error_of<std::runtime_error>([&] {
              HistoryWriter(file, {"a", "a"});
            }),
            file.string() + ": 'a' is no column name, or is there twice");
  EXPECT_EQ(content(file), "old");
  HistoryWriter writer(file, {"a"});
  EXPECT_EQ(error_of<std::runtime_error>([&] {
              writer.row(std::vector{1.0, 2.0});
            }),
            file.string() + ": 2 values for 1 columns");
}

#include "io/series.hpp"

#include "io_files.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

using namespace scarp::io;
using namespace scarp::test;

namespace {

constexpr double tiny = 5e-324;

Frame small_frame(double time, long step) {
  return {.time = time,
          .step = step,
          .dimension = 2,
          .cell_size = 0.1,
          .lower = {-1.0, 0.0, 1.0 / 3.0},
          .upper = {2.0, 0.0, 1e300},
          .position = {0.1, 0.0, 0.2, 1.0 / 3.0, 0.0, -tiny},
          .columns = {{"density", 1, {2650.0, std::nextafter(2650.0, 3000.0)}},
                      {"velocity", 3, {1, 2, 3, -4, 5, -6}},
                      {"stress", 6, {11, 22, 33, 12, 23, 13, -11, -22, -33, -12, -23, -13}}}};
}

// Values that do not compress, so that the file is as large as the points are many.
Frame large_frame(double time, std::size_t points) {
  Frame frame;
  frame.time = time;
  std::uint64_t state = 1;
  for (std::size_t i = 0; i < 3 * points; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    frame.position.push_back(static_cast<double>(state >> 11));
  }
  return frame;
}

void expect_equal(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.dimension, b.dimension);
  EXPECT_EQ(a.cell_size, b.cell_size);
  EXPECT_EQ(a.lower, b.lower);
  EXPECT_EQ(a.upper, b.upper);
  EXPECT_EQ(a.position, b.position);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    EXPECT_EQ(a.columns[i].name, b.columns[i].name);
    EXPECT_EQ(a.columns[i].components, b.columns[i].components);
    EXPECT_EQ(a.columns[i].values, b.columns[i].values);
  }
}

// What reading says, having checked that VTK itself printed nothing.
std::string read_error(const fs::path& where) {
  testing::internal::CaptureStderr();
  std::string error = error_of<std::runtime_error>([&] { SeriesReader(where).read(0); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return error;
}

} // namespace

TEST(Series, ReadsBackExactlyWhatWasWritten) {
  const fs::path directory = fresh_directory() / "a" / "b";
  const std::vector<Frame> frames = {small_frame(0.0, 0), small_frame(0.1 + 0.2, 1L << 40),
                                     small_frame(1e-20, 7)};
  SeriesWriter writer(directory, "pile");
  for (const Frame& frame : frames) writer.write(frame);
  EXPECT_EQ(writer.frames(), 3U);

  const SeriesReader reader(directory);
  EXPECT_EQ(reader.name(), "pile");
  ASSERT_EQ(reader.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(reader.time(i), frames[i].time);
    expect_equal(reader.read(i), frames[i]);
  }
  EXPECT_EQ(names_in(directory), (std::vector<std::string>{"pile.pvd", "pile_000000.vtp",
                                                           "pile_000001.vtp", "pile_000002.vtp"}));
}

TEST(Series, TensorsKeepTheirOrder) {
  const fs::path directory = fresh_directory();
  SeriesWriter(directory, "pile").write(small_frame(0.0, 0));
  const Frame frame = SeriesReader(directory / "pile.pvd").read(0);
  const Column& stress = frame.column("stress");
  EXPECT_EQ(std::vector(stress.values.begin() + 6, stress.values.end()),
            (std::vector<double>{-11, -22, -33, -12, -23, -13}));
  EXPECT_TRUE(frame.has("density"));
  EXPECT_EQ(error_of<std::runtime_error>([&] { frame.column("strain"); }),
            "the frame has no field 'strain'; it has 'density', 'velocity' and 'stress'");
}

TEST(Series, FilesAreWhatParaViewReads) {
  const fs::path directory = fresh_directory();
  SeriesWriter(directory, "pile").write(small_frame(0.25, 0));
  EXPECT_EQ(content(directory / "pile.pvd"),
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
            "  <Collection>\n"
            "    <DataSet timestep=\"0.25\" part=\"0\" file=\"pile_000000.vtp\"/>\n"
            "  </Collection>\n"
            "</VTKFile>\n");
  const std::string vtp = content(directory / "pile_000000.vtp");
  for (const char* part :
       {"type=\"PolyData\"", "vtkZLibDataCompressor", "NumberOfVerts=\"2\"", "Name=\"TimeValue\"",
        "type=\"Float64\" Name=\"stress\" NumberOfComponents=\"6\" format=\"binary\""})
    EXPECT_NE(vtp.find(part), std::string::npos) << part;
}

TEST(Series, AFrameWithoutPointsIsAFrame) {
  const fs::path directory = fresh_directory();
  Frame empty;
  empty.columns = {{"density", 1, {}}};
  SeriesWriter(directory, "none").write(empty);
  EXPECT_EQ(SeriesReader(directory).read(0).size(), 0U);
}

TEST(Series, NotANumberSurvives) {
  const fs::path directory = fresh_directory();
  Frame frame = small_frame(0.0, 0);
  frame.columns[0].values = {std::nan(""), std::numeric_limits<double>::infinity()};
  SeriesWriter(directory, "nan").write(frame);
  const Frame back = SeriesReader(directory).read(0);
  EXPECT_TRUE(std::isnan(back.column("density").values[0]));
  EXPECT_TRUE(std::isinf(back.column("density").values[1]));
  EXPECT_EQ(back.column("velocity").values, frame.columns[1].values);
}

TEST(Series, TheFirstFrameReplacesAnOlderSeriesAndNothingElse) {
  const fs::path directory = fresh_directory();
  SeriesWriter old(directory, "pile");
  for (const double time : {0.0, 1.0, 2.0}) old.write(small_frame(time, 0));
  for (const char* other : {"pile_1.vtp", "pile_00000a.vtp", "pile_2_000000.vtp", "notes.txt"})
    write_file(directory / other, "mine");
  write_file(directory / "pile_000007.vtp.partial", "left by a killed run");

  SeriesWriter writer(directory, "pile");
  EXPECT_EQ(SeriesReader(directory).size(), 3U);
  writer.write(small_frame(5.0, 0));
  EXPECT_EQ(SeriesReader(directory).time(0), 5.0);
  EXPECT_EQ(names_in(directory),
            (std::vector<std::string>{"notes.txt", "pile.pvd", "pile_000000.vtp", "pile_00000a.vtp",
                                      "pile_1.vtp", "pile_2_000000.vtp"}));
}

TEST(Series, AWriterWithoutFramesLeavesNothing) {
  const fs::path directory = fresh_directory();
  { const SeriesWriter writer(directory, "pile"); }
  EXPECT_TRUE(names_in(directory).empty());
}

TEST(Series, AFailedWriteLeavesTheSeriesAsItWas) {
  const fs::path directory = fresh_directory();
  SeriesWriter writer(directory, "pile");
  writer.write(small_frame(0.0, 0));
  writer.write(small_frame(1.0, 1));
  const std::vector<std::string> before = names_in(directory);
  {
    const FileSizeLimit limit(20000);
    EXPECT_EQ(error_of<std::runtime_error>([&] { writer.write(large_frame(2.0, 5000)); }),
              (directory / "pile_000002.vtp.partial: cannot write: File too large").string());
  }
  EXPECT_EQ(names_in(directory), before);
  EXPECT_EQ(SeriesReader(directory).size(), 2U);
  expect_equal(SeriesReader(directory).read(1), small_frame(1.0, 1));

  const Frame large = large_frame(3.0, 5000);
  writer.write(large);
  EXPECT_EQ(SeriesReader(directory).size(), 3U);
  expect_equal(SeriesReader(directory).read(2), large);
}

TEST(Series, AFailedFirstFrameLeavesTheOlderSeries) {
  const fs::path directory = fresh_directory();
  SeriesWriter(directory, "pile").write(small_frame(0.5, 0));
  SeriesWriter writer(directory, "pile");
  {
    const FileSizeLimit limit(20000);
    EXPECT_THROW(writer.write(large_frame(2.0, 5000)), std::runtime_error);
  }
  expect_equal(SeriesReader(directory).read(0), small_frame(0.5, 0));
}

TEST(Series, RejectsColumnsThatDoNotFit) {
  SeriesWriter writer(fresh_directory(), "pile");
  Frame frame = small_frame(0.0, 0);
  frame.columns[1].values.pop_back();
  EXPECT_EQ(error_of<std::runtime_error>([&] { writer.write(frame); }),
            "frame: field 'velocity' has 5 values instead of 2 points times 3 components");
  frame = small_frame(0.0, 0);
  frame.columns[1].name = "density";
  EXPECT_EQ(error_of<std::runtime_error>([&] { writer.write(frame); }),
            "frame: field name 'density' is empty or used twice");
}

TEST(Series, SaysWhatItLookedForAndFound) {
  const fs::path directory = fresh_directory();
  EXPECT_EQ(read_error(directory / "none"), (directory / "none").string() +
                                                ": there is no such series (.pvd file or "
                                                "directory)");
  EXPECT_EQ(read_error(directory), directory.string() + ": the directory holds no .pvd file");
  EXPECT_EQ(read_error(write_file(directory / "a.txt", "")),
            (directory / "a.txt").string() + ": is not a .pvd file");
  write_file(directory / "b.pvd", "");
  write_file(directory / "a.pvd", "");
  EXPECT_EQ(read_error(directory),
            directory.string() + ": the directory holds 2 series, 'a.pvd' and 'b.pvd': name one of "
                                 "the .pvd files");
}

TEST(Series, BrokenCollectionsGiveOneError) {
  const fs::path file = fresh_directory() / "a.pvd";
  const auto error = [&](const std::string& text) {
    return read_error(write_file(file, text)).substr(file.string().size());
  };
  EXPECT_EQ(
      error("<VTKFile><Collection>"),
      ": is not valid XML: Error parsing XML in stream at line 1, column 21, byte index 21: no "
      "element found");
  EXPECT_EQ(error("<VTKFile></VTKFile>"), ": holds no <Collection>");
  EXPECT_EQ(error("<VTKFile><Collection><DataSet timestep=\"0\"/></Collection></VTKFile>"),
            ": a DataSet has no attribute 'file'");
  EXPECT_EQ(
      error("<VTKFile><Collection><DataSet timestep=\"x\" file=\"a\"/></Collection></VTKFile>"),
      ": 'x' is not a number");
}

TEST(Series, BrokenFramesGiveOneError) {
  const fs::path directory = fresh_directory();
  const fs::path file = directory / "pile_000000.vtp";
  SeriesWriter(directory, "pile").write(large_frame(0.0, 3000));
  const std::string whole = content(file);

  for (const double part : {0.0, 0.01, 0.3, 0.9, 0.999})
    EXPECT_EQ(read_error(write_file(file, whole.substr(0, static_cast<std::size_t>(
                                                              part * double(whole.size()))))
                             .parent_path()),
              file.string() + ": is not a complete VTK file (cut off?)");

  std::string damaged = whole;
  for (std::size_t i = whole.size() / 2; i < whole.size() / 2 + 64; ++i) damaged[i] = '\x55';
  write_file(file, damaged);
  EXPECT_EQ(read_error(directory),
            file.string() + ": Zlib error while uncompressing data.; Cannot read points array from "
                            "Points in piece 0.  The data array in the element may be too short.");

  std::string nameless = whole;
  nameless.replace(nameless.find("\"Step\""), 6, "\"Stop\"");
  write_file(file, nameless);
  EXPECT_EQ(read_error(directory),
            file.string() + ": has no field data 'Step' of 1 value(s): not written by scarp");

  write_file(file, "<VTKFile><PolyData></VTKFile>");
  EXPECT_EQ(read_error(directory).substr(0, file.string().size() + 29),
            file.string() + ": Error parsing XML in stream");

  fs::remove(file);
  EXPECT_EQ(read_error(directory), file.string() + ": cannot be opened for reading");
}

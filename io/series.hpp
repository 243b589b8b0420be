// DIR/NAME.pvd with DIR/NAME_000000.vtp ...: a time series that ParaView opens.
#pragma once

#include "io/frame.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace scarp::io {

/// Writes frames one by one.  After each call the series on disk is complete and loadable: every
/// file is written under another name, flushed to disk and renamed, the .pvd last.
class SeriesWriter {
 public:
  /// Makes the directory if there is none.  An older series of the same name is removed when the
  /// first frame is written.  Throws std::runtime_error.
  SeriesWriter(std::filesystem::path directory, std::string name);

  /// Writes one frame: compressed inline binary .vtp, all columns, and TimeValue, Step, Dimension,
  /// CellSize, Lower, Upper as field data.  Not appended data: Debian 12's ParaView 5.11 reads none
  /// since a security update of expat.  Throws std::runtime_error (a full disk says so), with the
  /// series as it was before the call.
  void write(const Frame& frame);

  std::size_t frames() const { return times_.size(); }

 private:
  std::filesystem::path directory_;
  std::string name_;
  std::vector<double> times_;
};

/// A series on disk.  Frames are read one at a time.
class SeriesReader {
 public:
  /// `where` is a .pvd file, or a directory that holds exactly one.  Throws std::runtime_error that
  /// says what was looked for and found.
  explicit SeriesReader(const std::filesystem::path& where);

  std::size_t size() const { return entries_.size(); }
  double time(std::size_t index) const { return entries_.at(index).time; }
  std::filesystem::path file(std::size_t index) const { return entries_.at(index).file; }
  std::string name() const { return name_; }
  Frame read(std::size_t index) const;

 private:
  struct Entry {
    double time;
    std::filesystem::path file;
  };
  std::string name_;
  std::vector<Entry> entries_;
};

} // namespace scarp::io

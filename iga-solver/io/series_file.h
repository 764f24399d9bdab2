// SPDX-License-Identifier: GPL-2.0-or-later
// An HDF5 file of number series that grow row by row, and can be read whenever the run is killed.
#pragma once

#include <string>
#include <vector>

#include "geometry_io/file_lock.h"
#include "geometry_io/hdf5_handle.h"

namespace io {

using geometry_io::Hdf5Handle;

/// Every function throws std::runtime_error, naming the file, if HDF5 fails.  Nobody else writes to it
/// meanwhile.
class SeriesFile {
 public:
  /// Creates the file; it is `path`.part, and an older file stays, until the first row is complete.
  explicit SeriesFile(const std::string& path);
  SeriesFile(SeriesFile&&) = default;
  /// Without a row there is no file.
  ~SeriesFile();
  /// Opens a file that is there, to go on with it.
  static SeriesFile open(const std::string& path);
  void set_attribute(const std::string& name, const std::string& value);
  std::string attribute(const std::string& name) const;
  /// Data set [rows] (width 1) or [rows][width] of doubles with attribute `unit`; '/' in the name makes
  /// groups.  Returns the index for append.
  int add_series(const std::string& name, int width, const std::string& unit);
  /// A data set that is there; the index as above.  Also throws if its shape is another.
  int find_series(const std::string& name, int width);
  void append(int series, const double* row);
  /// Ends a row: all that was appended reaches the file, and then `value` of the first series, whose rows are
  /// those that are complete.
  void end_row(double value);
  /// Rows that every series has: a killed run may have left some with one more.
  hsize_t rows() const;
  /// All rows of a series of width 1.
  std::vector<double> values(int series) const;
  /// Drops the rows after the first `rows` of each series.
  void keep_rows(hsize_t rows);
  const std::string& path() const { return path_; }

 private:
  struct Series {
    Hdf5Handle data_set;
    hsize_t rows, width;
  };
  SeriesFile(std::string path, geometry_io::FileLock lock, hid_t (*open)(const std::string& path));
  template <class Result>
  Result check(Result result, const char* action) const;
  void expect_room() const;
  void flush();
  void write_attribute(hid_t object, const std::string& name, const std::string& value);

  std::string path_;
  geometry_io::FileLock lock_;
  bool unfinished_ = false;  // has not its name yet
  Hdf5Handle file_;
  std::vector<Series> series_;
};

}  // namespace io

// SPDX-License-Identifier: GPL-2.0-or-later
// An HDF5 file of number series that grow row by row.
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

namespace io {

/// Owns one HDF5 identifier.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// Every function throws std::runtime_error, naming the file, if HDF5 fails.
class SeriesFile {
 public:
  /// Creates the file, replacing an older one.
  explicit SeriesFile(std::string path);
  void set_attribute(const std::string& name, const std::string& value);
  /// Data set [rows] (width 1) or [rows][width] of doubles with attribute `unit`; '/' in the name makes
  /// groups.  Returns the index for append.
  int add_series(const std::string& name, int width, const std::string& unit);
  void append(int series, const double* row);
  /// Everything appended so far reaches the file, which then is complete as it stands.
  void flush();
  const std::string& path() const { return path_; }

 private:
  struct Series {
    Hdf5Handle data_set;
    hsize_t rows, width;
  };
  template <class Result>
  Result check(Result result, const char* action) const;
  void write_attribute(hid_t object, const std::string& name, const std::string& value);

  std::string path_;
  Hdf5Handle file_;
  std::vector<Series> series_;
};

}  // namespace io

// SPDX-License-Identifier: GPL-2.0-or-later
// An HDF5 file in memory: numbers and texts by path, with errors that name file, path and what was found.
#pragma once

#include <string>
#include <vector>

#include "geometry_io/hdf5_handle.h"

namespace geometry_io {

/// Values of a data set, the last index fastest.
struct Hdf5Array {
  std::vector<hsize_t> shape;
  std::vector<double> values;
};
/// "[3][2]", or "one value".
std::string shape_text(const std::vector<hsize_t>& shape);

/// Every function throws nurbs::InputError "file: path: what is there, what is expected".
class Hdf5Input {
 public:
  Hdf5Input(const std::string& bytes, std::string file);

  /// Attributes of the object at `path`.
  std::string text(const std::string& path, const char* attribute) const;
  std::vector<int> integers(const std::string& path, const char* attribute) const;

  bool has(const std::string& path) const;
  /// Names in a group, sorted.
  std::vector<std::string> members(const std::string& group) const;
  Hdf5Array numbers(const std::string& data_set) const;
  std::vector<std::string> texts(const std::string& data_set) const;

  [[noreturn]] void fail(const std::string& path, const std::string& message) const;

 private:
  struct Source;
  Source attribute(const std::string& path, const char* name) const;
  Source data_set(const std::string& path) const;
  std::vector<std::string> read_texts(const Source& source) const;

  SilentHdf5Errors silent_;
  std::string file_name_;
  Hdf5Handle file_;
};

/// Every function throws std::runtime_error if HDF5 fails.
class Hdf5Output {
 public:
  Hdf5Output();

  void set_text(const std::string& path, const char* attribute, const std::string& value);
  void set_integers(const std::string& path, const char* attribute, const std::vector<int>& values);
  void add_group(const std::string& path);
  void add_numbers(const std::string& data_set, const std::vector<hsize_t>& shape, const double* values);
  void add_texts(const std::string& data_set, const std::vector<std::string>& values);

  /// The whole file.
  std::string bytes() const;

 private:
  void set_attribute(const std::string& path, const char* name, hid_t type, hid_t space, const void* values);
  void add_data_set(const std::string& path, hid_t file_type, hid_t memory_type, hid_t space,
                    const void* values);

  SilentHdf5Errors silent_;
  Hdf5Handle file_;
};

}  // namespace geometry_io

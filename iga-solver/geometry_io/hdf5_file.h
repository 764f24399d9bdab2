// SPDX-License-Identifier: GPL-2.0-or-later
// An HDF5 file in memory: numbers and texts by path, with errors that name file, path and what was found.
#pragma once

#include <string>
#include <vector>

#include "geometry_io/hdf5_contents.h"
#include "geometry_io/hdf5_handle.h"

namespace geometry_io {

/// "[3][2]", or "one value".
std::string shape_text(const std::vector<std::uint64_t>& shape);

/// Every function throws InputError "file: path: what is there, what is expected".
class Hdf5Input {
 public:
  /// An HDF5 file, or what unpacked_hdf5 makes of it.
  Hdf5Input(const std::string& bytes, std::string file);

  /// Attributes of the object at `path`.
  const std::string& text(const std::string& path, const char* attribute) const;
  std::vector<int> integers(const std::string& path, const char* attribute) const;

  bool has(const std::string& path) const { return contents_.count(path) > 0; }
  bool has(const std::string& path, const char* attribute) const;
  /// Names in a group, sorted.
  std::vector<std::string> members(const std::string& group) const;
  const Hdf5Value& numbers(const std::string& data_set) const;
  const std::vector<std::string>& texts(const std::string& data_set) const;

  [[noreturn]] void fail(const std::string& path, const std::string& message) const;

 private:
  const Hdf5Object& object(const std::string& path) const;
  const Hdf5Value& attribute(const std::string& path, const char* name) const;
  const Hdf5Value& data_set(const std::string& path) const;

  std::string file_name_;
  Hdf5Contents contents_;
};

/// The file's contents as bytes that others can parse without HDF5: by this process if this program wrote the
/// file, else by one of its own (hdf5_process.h).  Throws InputError.
std::string unpacked_hdf5(const std::string& bytes, const std::string& file);

/// Every function throws std::runtime_error if HDF5 fails.
class Hdf5Output {
 public:
  Hdf5Output();

  void set_text(const std::string& path, const char* attribute, const std::string& value);
  void set_integers(const std::string& path, const char* attribute, const std::vector<int>& values);
  void add_group(const std::string& path);
  void add_numbers(const std::string& data_set, const std::vector<hsize_t>& shape, const double* values);
  void add_texts(const std::string& data_set, const std::vector<std::string>& values);

  /// All of it, groups before what is in them.
  void add(const Hdf5Contents& contents);

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

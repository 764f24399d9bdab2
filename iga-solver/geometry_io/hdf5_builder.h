// SPDX-License-Identifier: GPL-2.0-or-later
// Contents of an HDF5 file that are made, not read; hdf5_file() in hdf5_file.h writes them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "geometry_io/hdf5_contents.h"

namespace geometry_io {

class Hdf5Builder {
 public:
  void set_text(const std::string& path, const std::string& attribute, const std::string& value) {
    contents_[path].attributes[attribute] = texts_value({}, {value});
  }
  void set_integers(const std::string& path, const std::string& attribute, const std::vector<int>& values) {
    Hdf5Value& to = contents_[path].attributes[attribute];
    to.kind = Hdf5Value::Kind::integers;
    if (values.size() != 1) to.shape = {values.size()};
    to.numbers.assign(values.begin(), values.end());
  }
  void add_group(const std::string& path) { contents_[path]; }
  void add_numbers(const std::string& path, std::vector<std::uint64_t> shape, std::vector<double> values) {
    Hdf5Object& object = contents_[path];
    object.is_group = false;
    object.values.kind = Hdf5Value::Kind::numbers;
    object.values.shape = std::move(shape);
    object.values.numbers = std::move(values);
  }
  void add_texts(const std::string& path, const std::vector<std::string>& values) {
    Hdf5Object& object = contents_[path];
    object.is_group = false;
    object.values = texts_value({values.size()}, values);
  }
  const Hdf5Contents& contents() const { return contents_; }

 private:
  static Hdf5Value texts_value(std::vector<std::uint64_t> shape, const std::vector<std::string>& texts) {
    Hdf5Value value;
    value.kind = Hdf5Value::Kind::texts;
    value.shape = std::move(shape);
    value.texts = texts;
    return value;
  }
  Hdf5Contents contents_;
};

}  // namespace geometry_io

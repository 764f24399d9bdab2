// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <stdexcept>

#include "geometry_io/hdf5_file.h"
#include "geometry_io/hdf5_seal.h"

namespace geometry_io {
namespace {

template <class Result>
Result check(Result result, const char* action) {
  if (result < 0) throw std::runtime_error(std::string("HDF5 cannot ") + action);
  return result;
}

hid_t create_in_memory() {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr size_t kIncrement = 1 << 16;
  H5Pset_fapl_core(access, kIncrement, false);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  check(H5Pset_userblock(creation, kSealSize), "leave room for a seal");
  return H5Fcreate(kNameInMemory, H5F_ACC_TRUNC, creation, access);
}

// Text of fixed length, with a NUL behind it: on text of variable length HDF5 crashes if the file is damaged.
Hdf5Handle text_type(size_t longest) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, longest + 1), "make a text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "make a text type");
  return type;
}

}  // namespace

Hdf5Output::Hdf5Output() : file_(create_in_memory(), H5Fclose) {
  check<hid_t>(file_, "make a file in memory");
}

void Hdf5Output::set_text(const std::string& path, const char* name, const std::string& value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  set_attribute(path, name, text_type(value.size()), space, value.c_str());
}

void Hdf5Output::set_integers(const std::string& path, const char* name, const std::vector<int>& values) {
  const hsize_t count = values.size();
  const Hdf5Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
  set_attribute(path, name, H5T_NATIVE_INT, space, values.data());
}

void Hdf5Output::set_attribute(const std::string& path, const char* name, hid_t type, hid_t space,
                               const void* values) {
  const Hdf5Handle attribute(
      H5Acreate_by_name(file_, path.c_str(), name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  check<hid_t>(attribute, "make an attribute");
  check(H5Awrite(attribute, type, values), "write an attribute");
}

void Hdf5Output::add_group(const std::string& path) {
  check<hid_t>(Hdf5Handle(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose),
               "make a group");
}

void Hdf5Output::add_numbers(const std::string& path, const std::vector<hsize_t>& shape,
                             const double* values) {
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  add_data_set(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, values);
}

void Hdf5Output::add_texts(const std::string& path, const std::vector<std::string>& values) {
  size_t longest = 0;
  for (const std::string& value : values) longest = std::max(longest, value.size());
  std::string texts;
  for (std::string value : values) {
    value.resize(longest + 1, '\0');
    texts += value;
  }
  const hsize_t count = values.size();
  const Hdf5Handle type = text_type(longest), space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  add_data_set(path, type, type, space, texts.data());
}

void Hdf5Output::add_data_set(const std::string& path, hid_t file_type, hid_t memory_type, hid_t space,
                              const void* values) {
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(creation, false), "leave out times");  // the same contents are the same bytes
  const Hdf5Handle data_set(
      H5Dcreate2(file_, path.c_str(), file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  check<hid_t>(data_set, "make a data set");
  check(H5Dwrite(data_set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write a data set");
}

void Hdf5Output::add(const Hdf5Contents& contents) {
  for (const auto& [path, object] : contents) {
    const Hdf5Value& value = object.values;
    if (object.is_group && path != "/")
      add_group(path);
    else if (!object.is_group && value.kind == Hdf5Value::Kind::texts)
      add_texts(path, value.texts);
    else if (!object.is_group)
      add_numbers(path, {value.shape.begin(), value.shape.end()}, value.numbers.data());
    for (const auto& [name, attribute] : object.attributes)
      if (attribute.kind == Hdf5Value::Kind::texts)
        set_text(path, name.c_str(), attribute.texts.front());
      else
        set_integers(path, name.c_str(), {attribute.numbers.begin(), attribute.numbers.end()});
  }
}

std::string Hdf5Output::bytes() const {
  check(H5Fflush(file_, H5F_SCOPE_LOCAL), "finish a file");
  const ssize_t size = check(H5Fget_file_image(file_, nullptr, 0), "measure a file");
  std::string image(kSealSize + size, '\0');  // HDF5 leaves the user block out
  check(H5Fget_file_image(file_, image.data() + kSealSize, size), "copy a file");
  seal(image);
  return image;
}

}  // namespace geometry_io

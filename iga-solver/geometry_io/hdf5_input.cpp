// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "geometry_io/hdf5_file.h"
#include "nurbs/file_kind.h"
#include "nurbs/input_error.h"

namespace geometry_io {

// An attribute or a data set, opened.
struct Hdf5Input::Source {
  std::string name;  // for messages
  Hdf5Handle object, type, space;
  herr_t (*read)(hid_t object, hid_t type, void* values);

  std::vector<hsize_t> shape() const {
    std::vector<hsize_t> shape(std::max(H5Sget_simple_extent_ndims(space), 0));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    return shape;
  }
  hsize_t count() const { return std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0); }
  H5T_class_t kind() const { return H5Tget_class(type); }
  const char* described() const {
    switch (kind()) {
      case H5T_INTEGER:
        return "whole numbers";
      case H5T_FLOAT:
        return "numbers";
      case H5T_STRING:
        return "text";
      default:
        return "values of another type";
    }
  }
};

namespace {

constexpr hsize_t kMaxValues = std::numeric_limits<int>::max();

// The file lives in memory: HDF5's "core" driver on a copy of the bytes.
hid_t open_image(const std::string& bytes) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr size_t kIncrement = 1 << 16;
  H5Pset_fapl_core(access, kIncrement, false);
  // The interface takes an image that is not const, and copies it.
  if (H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()) < 0) return H5I_INVALID_HID;
  return H5Fopen(kNameInMemory, H5F_ACC_RDONLY, access);
}

herr_t read_data_set(hid_t object, hid_t type, void* values) {
  return H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

// Text of fixed length as it stands in its field: up to the first NUL, without the padding.
std::string trimmed(const char* text, size_t size) {
  std::string value(text, std::find(text, text + size, '\0'));
  value.erase(value.find_last_not_of(' ') + 1);
  return value;
}

}  // namespace

std::string shape_text(const std::vector<hsize_t>& shape) {
  std::string text;
  for (const hsize_t n : shape) text += fmt::format("[{}]", n);
  return text.empty() ? "one value" : text;
}

Hdf5Input::Hdf5Input(const std::string& bytes, std::string file)
    : file_name_(std::move(file)), file_(open_image(bytes), H5Fclose) {
  if (file_ >= 0) return;
  const nurbs::FileKind kind = nurbs::kind_of_file(file_name_, bytes);
  if (kind != nurbs::FileKind::xml && kind != nurbs::FileKind::binary)
    nurbs::expect_kind(nurbs::FileKind::hdf5, file_name_, bytes);
  throw nurbs::InputError(file_name_ + (kind == nurbs::FileKind::hdf5
                                            ? ": damaged or incomplete, HDF5 cannot open it"
                                            : ": is no HDF5 file, expected one by its name"));
}

void Hdf5Input::fail(const std::string& path, const std::string& message) const {
  throw nurbs::InputError(nurbs::one_line(fmt::format("{}: {}: {}", file_name_, path, message)));
}

Hdf5Input::Source Hdf5Input::attribute(const std::string& path, const char* name) const {
  if (path != "/" && !has(path)) fail(path, "is missing");
  if (H5Aexists_by_name(file_, path.c_str(), name, H5P_DEFAULT) <= 0)
    fail(path, fmt::format("attribute '{}' is missing", name));
  Hdf5Handle object(H5Aopen_by_name(file_, path.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  Hdf5Handle type(H5Aget_type(object), H5Tclose), space(H5Aget_space(object), H5Sclose);
  return {fmt::format("attribute '{}'", name), std::move(object), std::move(type), std::move(space), H5Aread};
}

Hdf5Input::Source Hdf5Input::data_set(const std::string& path) const {
  if (!has(path)) fail(path, "is missing");
  Hdf5Handle object(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (object < 0) fail(path, "is no data set, expected one");
  Hdf5Handle type(H5Dget_type(object), H5Tclose), space(H5Dget_space(object), H5Sclose);
  return {path, std::move(object), std::move(type), std::move(space), read_data_set};
}

std::string Hdf5Input::text(const std::string& path, const char* name) const {
  const std::vector<std::string> texts = read_texts(attribute(path, name));
  if (texts.size() != 1)
    fail(path, fmt::format("attribute '{}' has {} texts, expected one", name, texts.size()));
  return texts.front();
}

std::vector<std::string> Hdf5Input::texts(const std::string& path) const {
  return read_texts(data_set(path));
}

std::vector<std::string> Hdf5Input::read_texts(const Source& source) const {
  if (source.kind() != H5T_STRING)
    fail(source.name, fmt::format("holds {}, expected text", source.described()));
  if (source.count() > kMaxValues) fail(source.name, fmt::format("{} texts, expected fewer", source.count()));
  const size_t count = source.count();
  std::vector<std::string> texts;
  if (H5Tis_variable_str(source.type) > 0) {
    std::vector<char*> read(count);
    if (source.read(source.object, source.type, read.data()) < 0) fail(source.name, "cannot be read");
    for (const char* one : read) texts.emplace_back(one == nullptr ? "" : one);
    H5Dvlen_reclaim(source.type, source.space, H5P_DEFAULT, read.data());
  } else {
    const size_t size = H5Tget_size(source.type);
    std::vector<char> read(count * size);
    if (source.read(source.object, source.type, read.data()) < 0) fail(source.name, "cannot be read");
    for (size_t i = 0; i < count; ++i) texts.push_back(trimmed(&read[i * size], size));
  }
  return texts;
}

std::vector<int> Hdf5Input::integers(const std::string& path, const char* name) const {
  const Source source = attribute(path, name);
  if (source.kind() != H5T_INTEGER)
    fail(path, fmt::format("{} holds {}, expected whole numbers", source.name, source.described()));
  std::vector<int> values(source.count());
  if (source.read(source.object, H5T_NATIVE_INT, values.data()) < 0)
    fail(path, fmt::format("{} cannot be read", source.name));
  return values;
}

bool Hdf5Input::has(const std::string& path) const {
  // Every part of the path must be asked for: HDF5 fails on a missing one in between.
  for (size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1))
    if (H5Lexists(file_, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Input::members(const std::string& path) const {
  if (!has(path)) fail(path, "is missing");
  const Hdf5Handle group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), H5Gclose);
  if (group < 0) fail(path, "is no group, expected one");
  std::vector<std::string> names;
  const auto append = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names) < 0)
    fail(path, "cannot be listed");
  return names;
}

Hdf5Array Hdf5Input::numbers(const std::string& path) const {
  const Source source = data_set(path);
  if (source.kind() != H5T_FLOAT && source.kind() != H5T_INTEGER)
    fail(path, fmt::format("holds {}, expected numbers", source.described()));
  if (source.count() > kMaxValues)
    fail(path, fmt::format("{} numbers, expected at most {}", source.count(), kMaxValues));
  Hdf5Array array{source.shape(), std::vector<double>(source.count())};
  if (source.read(source.object, H5T_NATIVE_DOUBLE, array.values.data()) < 0) fail(path, "cannot be read");
  return array;
}

}  // namespace geometry_io

// SPDX-License-Identifier: GPL-2.0-or-later
// The only place where HDF5's library reads geometry (histories: io/series_file.h).
#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "geometry_io/hdf5_contents.h"
#include "geometry_io/hdf5_handle.h"

namespace geometry_io {
namespace {

constexpr hsize_t kMaxValues = std::numeric_limits<int>::max();
constexpr int kDepth = 3;  // /patches/0/knots_xi
const std::set<std::string> kGroups{"patches", "surfaces", "state",    "faces",  "loops",
                                    "trims",   "edges",    "vertices", "solids", "healed"};

// The file lives in memory: HDF5's "core" driver on a copy of the bytes.
hid_t open_image(const std::string& bytes) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr size_t kIncrement = 1 << 16;
  H5Pset_fapl_core(access, kIncrement, false);
  // The interface takes an image that is not const, and copies it.
  if (H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()) < 0) return H5I_INVALID_HID;
  return H5Fopen(kNameInMemory, H5F_ACC_RDONLY, access);
}

// An attribute or a data set, opened.
struct Source {
  hid_t object;
  Hdf5Handle type, space;
  hsize_t bytes_in_file;
  herr_t (*read)(hid_t object, hid_t type, void* values);

  hsize_t count() const { return std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0); }
};

herr_t read_data_set(hid_t object, hid_t type, void* values) {
  return H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

// Text of fixed length as it stands in its field: up to the first NUL, without the padding.
std::string trimmed(const char* text, size_t size) {
  std::string value(text, std::find(text, text + size, '\0'));
  value.erase(value.find_last_not_of(' ') + 1);
  return value;
}

bool read_numbers(const Source& source, Hdf5Value& value) {
  value.numbers.resize(source.count());
  return source.read(source.object, H5T_NATIVE_DOUBLE, value.numbers.data()) >= 0;
}

bool read_variable_texts(const Source& source, Hdf5Value& value) {
  std::vector<char*> read(source.count());
  if (source.read(source.object, source.type, read.data()) < 0) return false;
  for (const char* one : read) value.texts.emplace_back(one == nullptr ? "" : one);
  H5Dvlen_reclaim(source.type, source.space, H5P_DEFAULT, read.data());
  return true;
}

bool read_fixed_texts(const Source& source, Hdf5Value& value) {
  const size_t size = H5Tget_size(source.type);
  std::vector<char> read(source.count() * size);
  if (source.read(source.object, source.type, read.data()) < 0) return false;
  for (hsize_t i = 0; i < source.count(); ++i) value.texts.push_back(trimmed(&read[i * size], size));
  return true;
}

std::vector<std::uint64_t> shape_of(hid_t space) {
  if (H5Sget_simple_extent_type(space) == H5S_NULL) return {0};
  std::vector<hsize_t> shape(std::max(H5Sget_simple_extent_ndims(space), 0));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return {shape.begin(), shape.end()};
}

// An error of HDF5 is a problem of this value, which is told if it is needed.
Hdf5Value read_value(const Source& source) {
  Hdf5Value value;
  value.shape = shape_of(source.space);
  const H5T_class_t type = H5Tget_class(source.type);
  if (type == H5T_INTEGER || type == H5T_FLOAT)
    value.kind = type == H5T_INTEGER ? Hdf5Value::Kind::integers : Hdf5Value::Kind::numbers;
  else if (type == H5T_STRING)
    value.kind = Hdf5Value::Kind::texts;
  else
    return value;

  const hsize_t size = std::max<size_t>(H5Tget_size(source.type), 1);
  if (source.count() > kMaxValues || source.count() > kMaxPacking * source.bytes_in_file / size) {
    value.problem = "holds " + std::to_string(source.count()) + " values in " +
                    std::to_string(source.bytes_in_file) + " bytes of the file, expected fewer";
    return value;
  }
  if (source.count() == 0) return value;
  const bool variable = H5Tis_variable_str(source.type) > 0;
  const bool good = value.kind != Hdf5Value::Kind::texts ? read_numbers(source, value)
                    : variable                           ? read_variable_texts(source, value)
                                                         : read_fixed_texts(source, value);
  if (good) return value;
  value.numbers.clear();
  value.texts.clear();
  value.problem = "cannot be read";
  return value;
}

class Unpacker {
 public:
  explicit Unpacker(hid_t file) : file_(file) {}

  Hdf5Contents unpack() {
    Hdf5Object& root = contents_["/"];
    add_attributes("/", root);
    for (const std::string& name : members("/"))
      if (kGroups.count(name) > 0) add("/" + name, 1);
    return std::move(contents_);
  }

 private:
  void add(const std::string& path, int depth) {
    Hdf5Object& object = contents_[path];
    add_attributes(path, object);
    const Hdf5Handle data_set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
    object.is_group = data_set < 0;
    if (!object.is_group)
      object.values = read_value({data_set,
                                  {H5Dget_type(data_set), H5Tclose},
                                  {H5Dget_space(data_set), H5Sclose},
                                  H5Dget_storage_size(data_set),
                                  read_data_set});
    else if (depth < kDepth)
      for (const std::string& name : members(path)) add(path + "/" + name, depth + 1);
  }

  std::vector<std::string> members(const std::string& path) const {
    std::vector<std::string> names;
    const Hdf5Handle group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), H5Gclose);
    if (group < 0) return names;
    const auto append = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
      static_cast<std::vector<std::string>*>(out)->emplace_back(name);
      return 0;
    };
    if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names) < 0)
      throw std::runtime_error("damaged or incomplete, HDF5 cannot list " + path);
    return names;
  }

  void add_attributes(const std::string& path, Hdf5Object& out) const {
    const Hdf5Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
    if (object < 0) return;
    std::vector<std::string> names;
    const auto append = [](hid_t, const char* name, const H5A_info_t*, void* all) -> herr_t {
      static_cast<std::vector<std::string>*>(all)->emplace_back(name);
      return 0;
    };
    if (H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names) < 0)
      throw std::runtime_error("damaged or incomplete, HDF5 cannot list the attributes of " + path);
    for (const std::string& name : names) {
      const Hdf5Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
      if (attribute < 0) continue;
      out.attributes[name] = read_value({attribute,
                                         {H5Aget_type(attribute), H5Tclose},
                                         {H5Aget_space(attribute), H5Sclose},
                                         H5Aget_storage_size(attribute),
                                         H5Aread});
    }
  }

  hid_t file_;
  Hdf5Contents contents_;
};

}  // namespace

Hdf5Contents unpack_hdf5(const std::string& bytes) {
  const SilentHdf5Errors silent;
  const Hdf5Handle file(open_image(bytes), H5Fclose);
  if (file < 0) throw std::runtime_error("damaged or incomplete, HDF5 cannot open it");
  return Unpacker(file).unpack();
}

}  // namespace geometry_io

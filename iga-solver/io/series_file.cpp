// SPDX-License-Identifier: GPL-2.0-or-later
#include "io/series_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "geometry_io/regular_file.h"

namespace io {

namespace {

// A kill while a chunk is added may leave a file that HDF5 cannot open: not often.
constexpr hsize_t kRowsPerChunk = 1024;

using SilentErrors = geometry_io::SilentHdf5Errors;

// Of the unfinished file.  Another run's may have got its name since somebody looked.
geometry_io::FileLock lock_new(const std::string& path) {
  const std::string problem = geometry_io::problem_as_output(path);
  if (!problem.empty()) throw std::runtime_error(fmt::format("{}: cannot write here: {}", path, problem));
  geometry_io::FileLock lock(geometry_io::unfinished_name(path), path);
  if (!geometry_io::is_locked(path)) return lock;
  geometry_io::discard_file(path);
  throw std::runtime_error(geometry_io::in_use(path));
}

// HDF5 would lock a file itself, but only once it has emptied it.
Hdf5Handle access_without_locks() {
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  return access;
}

hid_t create_file(const std::string& path) {
  const SilentErrors silent;
  return H5Fcreate(geometry_io::unfinished_name(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT,
                   access_without_locks());
}

hid_t open_file(const std::string& path) {
  const SilentErrors silent;
  std::error_code unknown;
  if (std::filesystem::file_size(path, unknown) == 0) return -1;  // HDF5 would begin a new one in it
  return H5Fopen(path.c_str(), H5F_ACC_RDWR, access_without_locks());
}

}  // namespace

template <class Result>
Result SeriesFile::check(Result result, const char* action) const {
  if (result < 0) throw std::runtime_error(fmt::format("{}: HDF5 cannot {}", path_, action));
  return result;
}

SeriesFile::SeriesFile(std::string path, geometry_io::FileLock lock, hid_t (*open)(const std::string& path))
    : path_(std::move(path)), lock_(std::move(lock)), file_(open(path_), H5Fclose) {}

SeriesFile::SeriesFile(const std::string& path) : SeriesFile(path, lock_new(path), create_file) {
  check<hid_t>(file_, "create this file (does the folder exist, may it be written to?)");
  unfinished_ = true;
}

SeriesFile::~SeriesFile() {
  if (unfinished_ && file_ >= 0) geometry_io::discard_file(path_);
}

SeriesFile SeriesFile::open(const std::string& path) {
  SeriesFile file(path, geometry_io::FileLock(path), open_file);
  file.check<hid_t>(file.file_, "open this file to go on with it");
  return file;
}

std::string SeriesFile::attribute(const std::string& name) const {
  const SilentErrors silent;
  const Hdf5Handle attribute(H5Aopen(file_, name.c_str(), H5P_DEFAULT), H5Aclose);
  check<hid_t>(attribute, ("find the attribute '" + name + "'").c_str());
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
  const bool one_text = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
                        H5Sget_simple_extent_npoints(space) == 1;
  if (!one_text) return "";
  std::string text(H5Tget_size(type), '\0');
  check(H5Aread(attribute, type, text.data()), "read an attribute");
  return text.c_str();  // up to the first NUL
}

void SeriesFile::set_attribute(const std::string& name, const std::string& value) {
  const SilentErrors silent;
  write_attribute(file_, name, value);
}

void SeriesFile::write_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, value.size() + 1), "make a text type");
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  check(H5Awrite(attribute, type, value.c_str()), "write an attribute");
}

int SeriesFile::add_series(const std::string& name, int width, const std::string& unit) {
  const SilentErrors silent;
  const int rank = width == 1 ? 1 : 2;
  const hsize_t columns = width;
  const hsize_t size[2] = {0, columns}, limit[2] = {H5S_UNLIMITED, columns},
                chunk[2] = {kRowsPerChunk, columns};
  const Hdf5Handle space(H5Screate_simple(rank, size, limit), H5Sclose);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_chunk(creation, rank, chunk), "set a chunk size");
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  check(H5Pset_create_intermediate_group(links, 1), "make groups");
  Hdf5Handle data_set(H5Dcreate2(file_, name.c_str(), H5T_NATIVE_DOUBLE, space, links, creation, H5P_DEFAULT),
                      H5Dclose);
  check<hid_t>(data_set, ("create the data set '" + name + "'").c_str());
  write_attribute(data_set, "unit", unit);
  series_.push_back({std::move(data_set), 0, columns});
  return static_cast<int>(series_.size()) - 1;
}

int SeriesFile::find_series(const std::string& name, int width) {
  const SilentErrors silent;
  Hdf5Handle data_set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  check<hid_t>(data_set, ("find the data set '" + name + "'").c_str());
  const Hdf5Handle space(H5Dget_space(data_set), H5Sclose);
  hsize_t size[2] = {0, 1};
  const bool fits = H5Sget_simple_extent_ndims(space) == (width == 1 ? 1 : 2) &&
                    H5Sget_simple_extent_dims(space, size, nullptr) >= 0 && size[1] == hsize_t(width);
  if (!fits) throw std::runtime_error(fmt::format("{}: data set '{}' has another shape", path_, name));
  series_.push_back({std::move(data_set), size[0], size[1]});
  return static_cast<int>(series_.size()) - 1;
}

hsize_t SeriesFile::rows() const {
  hsize_t least = series_.empty() ? 0 : series_.front().rows;
  for (const Series& s : series_) least = std::min(least, s.rows);
  return least;
}

std::vector<double> SeriesFile::values(int series) const {
  const SilentErrors silent;
  const Series& s = series_.at(series);
  // A killed run may have left rows whose chunk is not there yet.
  const hsize_t stored = H5Dget_storage_size(s.data_set);
  if (s.rows > kRowsPerChunk + geometry_io::kMaxPacking * stored / sizeof(double))
    throw std::runtime_error(fmt::format("{}: a data set has {} rows in {} bytes of the file, expected fewer",
                                         path_, s.rows, stored));
  std::vector<double> values(s.rows * s.width);
  check(H5Dread(s.data_set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "read a data set");
  return values;
}

void SeriesFile::keep_rows(hsize_t rows) {
  const SilentErrors silent;
  for (Series& s : series_) {
    const hsize_t size[2] = {rows, s.width};
    check(H5Dset_extent(s.data_set, size), "shorten a data set");
    s.rows = rows;
    if (&s == &series_.front()) flush();  // from now on the others' rows do not count
  }
}

void SeriesFile::append(int series, const double* row) {
  const SilentErrors silent;
  Series& s = series_.at(series);
  const hsize_t size[2] = {s.rows + 1, s.width}, start[2] = {s.rows, 0}, count[2] = {1, s.width};
  const int rank = s.width == 1 ? 1 : 2;
  check(H5Dset_extent(s.data_set, size), "extend a data set");
  const Hdf5Handle in_file(H5Dget_space(s.data_set), H5Sclose);
  check(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start, nullptr, count, nullptr), "select a row");
  const Hdf5Handle in_memory(H5Screate_simple(rank, count, nullptr), H5Sclose);
  check(H5Dwrite(s.data_set, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, row), "write a row");
  ++s.rows;
}

void SeriesFile::end_row(double value) {
  flush();
  append(0, &value);
  flush();
  if (!unfinished_) return;
  const std::string problem = geometry_io::finish_file(path_);
  if (!problem.empty()) throw std::runtime_error(fmt::format("{}: cannot write here: {}", path_, problem));
  unfinished_ = false;
}

// HDF5 does not survive a write that fails: it crashes when it is closed.  So the room for what it is about
// to write is asked for before (the file gets no longer by that, and file systems that cannot promise any are
// trusted), and without it HDF5 may go on in memory, where nobody looks.
void SeriesFile::expect_room() const {
  constexpr hsize_t kOfItsOwn = 1 << 16;  // [bytes] that HDF5 adds while it writes, beside new chunks
  hsize_t size = 0, more = kOfItsOwn;
  for (const Series& s : series_) more += kRowsPerChunk * s.width * sizeof(double);
  void* handle = nullptr;
  check(H5Fget_filesize(file_, &size), "tell its size");
  check(H5Fget_vfd_handle(file_, H5P_DEFAULT, &handle), "tell its descriptor");
  const int descriptor = *static_cast<int*>(handle);
  if (fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size + more)) == 0 ||
      errno == EOPNOTSUPP)
    return;
  const std::string problem = std::generic_category().message(errno);
  if (const int memory = memfd_create("lost", MFD_CLOEXEC); memory >= 0) {
    dup2(memory, descriptor);
    close(memory);
  }
  throw std::runtime_error(fmt::format("{}: cannot write here: {}", path_, problem));
}

void SeriesFile::flush() {
  const SilentErrors silent;
  expect_room();
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flush this file");
}

}  // namespace io

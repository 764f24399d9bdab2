// SPDX-License-Identifier: GPL-2.0-or-later
// Ownership and quiet for HDF5's C interface.
#pragma once

#include <hdf5.h>

#include <utility>

namespace geometry_io {

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

/// Files in memory need a name, too; HDF5 refuses one that is a file on the disk, and no file can have this.
constexpr const char* kNameInMemory = "/dev/null/geometry";

/// Bytes from one byte of a file: the most that deflate can do.
constexpr hsize_t kMaxPacking = 1032;

/// HDF5 prints its error stack unless told not to; a library must leave that to its caller.
class SilentHdf5Errors {
 public:
  SilentHdf5Errors() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SilentHdf5Errors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  SilentHdf5Errors(const SilentHdf5Errors&) = delete;

 private:
  H5E_auto2_t print_;
  void* data_;
};

}  // namespace geometry_io

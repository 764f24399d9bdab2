// SPDX-License-Identifier: GPL-2.0-or-later
// Files that are written for as long as a run takes, by one run alone.
#pragma once

#include <string>

namespace geometry_io {

/// While it is there nobody else's lock is.  The system lets go of it with the process, however that ends, so
/// a killed run is in nobody's way.  File systems that know no locks, and files that cannot be opened, are
/// not locked.
class FileLock {
 public:
  /// Makes the file if it is not there.  Throws std::runtime_error, in_use, if somebody else has it: of what
  /// it is to become, if that has another name.
  explicit FileLock(const std::string& path) : FileLock(path, path) {}
  FileLock(const std::string& path, const std::string& to_become);
  FileLock(FileLock&& other) noexcept;
  ~FileLock();
  FileLock& operator=(FileLock&&) = delete;

 private:
  void open(const std::string& path);
  void close();

  int descriptor_ = -1;
};

/// Whether somebody writes the file: another process, or another FileLock of this one.
bool is_locked(const std::string& path);
/// For messages.
std::string in_use(const std::string& path);

}  // namespace geometry_io

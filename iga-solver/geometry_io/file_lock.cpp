// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/file_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <utility>

namespace geometry_io {

namespace {

// False if somebody else has a lock in the way.  Not flock: HDF5 has those, where the environment asks for
// it.
bool lock(int descriptor, short kind) {
  struct flock whole {};
  whole.l_type = kind, whole.l_whence = SEEK_SET;
  return descriptor < 0 || fcntl(descriptor, F_OFD_SETLK, &whole) == 0 ||
         (errno != EAGAIN && errno != EACCES);
}

bool is_file_of(int descriptor, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

FileLock::FileLock(const std::string& path, const std::string& to_become) {
  do {
    open(path);
    if (!lock(descriptor_, F_WRLCK)) {
      close();
      throw std::runtime_error(in_use(to_become));
    }
  } while (descriptor_ >= 0 && !is_file_of(descriptor_, path));  // renamed since it was opened
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() { close(); }

// Programs that this one starts do not inherit the lock.
void FileLock::open(const std::string& path) {
  close();
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
}

void FileLock::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

std::string in_use(const std::string& path) {
  return fmt::format("{} is being written by another solid or run, expected another name", path);
}

// Who only reads it has a shared lock.
bool is_locked(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  const bool is_free = lock(descriptor, F_RDLCK);
  if (descriptor >= 0) ::close(descriptor);
  return !is_free;
}

}  // namespace geometry_io

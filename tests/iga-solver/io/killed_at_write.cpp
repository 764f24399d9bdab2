// SPDX-License-Identifier: GPL-2.0-or-later
// Preloaded into a program: ends it with SIGKILL before its write number KILL_AT, from 0, to a file whose
// name has ".h5" in it; or lets no such file be longer than FULL_AT bytes, as on a disk that is full.
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

namespace {

bool is_hdf5(int file) {
  char name[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t length = readlink(link.c_str(), name, sizeof name);
  return length > 0 && std::string(name, length).find(".h5") != std::string::npos;
}

void count_write(int file) {
  static long left = std::getenv("KILL_AT") ? std::atol(std::getenv("KILL_AT")) : -1;
  if (is_hdf5(file) && left-- == 0) kill(getpid(), SIGKILL);
}

bool has_no_room(int file, long end) {
  static const long limit = std::getenv("FULL_AT") ? std::atol(std::getenv("FULL_AT")) : -1;
  return limit >= 0 && end > limit && is_hdf5(file);
}

template <class Offset>
ssize_t write_there(const char* function, int file, const void* bytes, size_t size, Offset offset) {
  count_write(file);
  if (has_no_room(file, static_cast<long>(offset + size))) {
    errno = ENOSPC;
    return -1;
  }
  using Write = ssize_t (*)(int, const void*, size_t, Offset);
  return reinterpret_cast<Write>(dlsym(RTLD_NEXT, function))(file, bytes, size, offset);
}

}  // namespace

extern "C" ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  return write_there("pwrite", file, bytes, size, offset);
}
extern "C" ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t offset) {
  return write_there("pwrite64", file, bytes, size, offset);
}
extern "C" int fallocate(int file, int mode, off_t offset, off_t size) {
  if (has_no_room(file, offset + size)) {
    errno = ENOSPC;
    return -1;
  }
  using Allocate = int (*)(int, int, off_t, off_t);
  return reinterpret_cast<Allocate>(dlsym(RTLD_NEXT, "fallocate"))(file, mode, offset, size);
}
extern "C" int fallocate64(int file, int mode, off64_t offset, off64_t size) {
  return fallocate(file, mode, offset, size);
}

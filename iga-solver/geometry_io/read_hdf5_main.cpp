// SPDX-License-Identifier: GPL-2.0-or-later
// nurbs-read-hdf5: an HDF5 file on standard input; its contents, or one line that says what is wrong, on
// standard output.  Others start it to be safe from what HDF5 does with a damaged file (hdf5_process.h);
// nobody else needs it.
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "geometry_io/hdf5_contents.h"

namespace {

constexpr unsigned kPatience = 600;  // seconds
constexpr rlim_t kGrace = 5;         // seconds between SIGXCPU, which says what it was, and SIGKILL
#ifdef NURBS_ADDRESS_SANITIZER       // which takes terabytes of addresses
constexpr rlim_t kMemory = RLIM_INFINITY;
#else
constexpr rlim_t kMemory = rlim_t{8} << 30;  // bytes
#endif

void limit(int resource, rlim_t most, rlim_t grace = 0) {
  const rlimit both{most, most + grace};
  setrlimit(resource, &both);
}

// Seconds of the processor that a file may take: a tenth of them is plenty.
rlim_t seconds_for(std::size_t bytes) { return 10 + bytes / 10000000; }

void limit_myself() {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, kMemory);
  alarm(kPatience);
}

std::string standard_input() {
  std::string bytes;
  char part[1 << 16];
  for (size_t n; (n = std::fread(part, 1, sizeof part, stdin)) > 0;) bytes.append(part, n);
  return bytes;
}

int write(const std::string& bytes, int code) {
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  return std::fflush(stdout) == 0 ? code : 2;
}

}  // namespace

int main() {
  limit_myself();
  try {
    const std::string bytes = standard_input();
    limit(RLIMIT_CPU, seconds_for(bytes.size()), kGrace);
    return write(geometry_io::encoded(geometry_io::unpack_hdf5(bytes)), 0);
  } catch (const std::bad_alloc&) {
    return write("needs more memory than it may have", 1);
  } catch (const std::exception& error) {
    return write(error.what(), 1);
  }
}

// SPDX-License-Identifier: GPL-2.0-or-later
// What programs have in common that read one file for another program (reader_process.h): the file on
// standard input; what is in it, or one line that says what is wrong, on standard output; limits of time and
// memory.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace geometry_io {

#ifdef NURBS_ADDRESS_SANITIZER  // which takes terabytes of addresses
constexpr rlim_t kMemory = RLIM_INFINITY;
#else
constexpr rlim_t kMemory = rlim_t{8} << 30;  // bytes
#endif

inline void limit(int resource, rlim_t most, rlim_t grace = 0) {
  const rlimit both{most, most + grace};
  setrlimit(resource, &both);
}

inline std::string standard_input() {
  std::string bytes;
  char part[1 << 16];
  for (size_t n; (n = std::fread(part, 1, sizeof part, stdin)) > 0;) bytes.append(part, n);
  return bytes;
}

inline int write_answer(int file, const std::string& bytes, int code) {
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t more = write(file, bytes.data() + done, bytes.size() - done);
    if (more <= 0) return 2;
    done += more;
  }
  return code;
}

/// `read(bytes)` is the answer; it may take `seconds` and 1 s for each `bytes_per_second` of the processor.
/// What a library prints on standard output is lost.
template <class Read>
int answer_with(rlim_t seconds, rlim_t bytes_per_second, Read read) {
  constexpr unsigned kPatience = 600;  // seconds
  constexpr rlim_t kGrace = 5;         // seconds between SIGXCPU, which says what it was, and SIGKILL
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, kMemory);
  alarm(kPatience);
  const int out = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
  try {
    const std::string bytes = standard_input();
    limit(RLIMIT_CPU, seconds + bytes.size() / bytes_per_second, kGrace);
    return write_answer(out, read(bytes), 0);
  } catch (const std::bad_alloc&) {
    return write_answer(out, "needs more memory than it may have", 1);
  } catch (const std::exception& error) {
    return write_answer(out, error.what(), 1);
  }
}

}  // namespace geometry_io

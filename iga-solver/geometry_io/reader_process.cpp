// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/reader_process.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "geometry_io/hdf5_contents.h"

extern char** environ;

namespace geometry_io {
namespace {

namespace fs = std::filesystem;

// A file in memory, without a name.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("geometry", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw std::runtime_error(fmt::format("no file in memory: {}", std::strerror(errno)));
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int descriptor() const { return descriptor_; }

  void write(const std::string& bytes) const {
    for (size_t done = 0; done < bytes.size();) {
      const ssize_t more = pwrite(descriptor_, bytes.data() + done, bytes.size() - done, done);
      if (more < 0) throw std::runtime_error(fmt::format("no memory for a file: {}", std::strerror(errno)));
      done += more;
    }
  }
  std::string read() const {
    std::string bytes(lseek(descriptor_, 0, SEEK_END), '\0');
    size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t more = pread(descriptor_, bytes.data() + done, bytes.size() - done, done);
      if (more <= 0) break;
      done += more;
    }
    bytes.resize(done);
    return bytes;
  }

 private:
  int descriptor_;
};

fs::path folder_of_program() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

// Where the code of this function lies: the program, or a library that it has loaded.
fs::path folder_of_library() {
  Dl_info info;
  std::error_code error;
  if (dladdr(reinterpret_cast<const void*>(&folder_of_library), &info) == 0 || info.dli_fname == nullptr)
    return {};
  return fs::canonical(info.dli_fname, error).parent_path();
}

// The reader's path, or its bare name, which posix_spawnp looks up in PATH.
std::string find_reader(const char* name) {
  for (const fs::path& start : {folder_of_program(), folder_of_library()})
    for (fs::path folder = start; folder.has_relative_path(); folder = folder.parent_path())
      for (const char* below : {"", "bin", "iga-solver/app"}) {
        const fs::path reader = folder / below / name;
        if (access(reader.c_str(), X_OK) == 0) return reader;
      }
  return name;
}

// Starts the reader with `in` and `out` as its standard files, all signals as they are by default.
pid_t start(const ReaderProgram& program, const std::vector<std::string>& words, const MemoryFile& in,
            const MemoryFile& out) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", 1, 0);  // for writing
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);

  pid_t process = 0;
  std::vector<char*> arguments{const_cast<char*>(program.name)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int problem = posix_spawnp(&process, find_reader(program.name).c_str(), &files, &attributes,
                                   arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (problem != 0)
    throw std::runtime_error(
        fmt::format("{} (program {}: {})", program.without, program.name, std::strerror(problem)));
  return process;
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return 0;  // somebody else has waited: what it wrote decides
  return status;
}

}  // namespace

const ReaderProgram kHdf5Reader{"nurbs-read-hdf5", "HDF5",
                                "HDF5 of another program, which needs the program 'nurbs-read-hdf5' to be "
                                "read, expected beside this one or "
                                "in PATH; or a file that nurbs-convert wrote"};
const ReaderProgram kStepReader{"nurbs-read-step", "OpenCASCADE",
                                "STEP and IGES are read by the program 'nurbs-read-step', expected beside "
                                "this one or in PATH: it is built where OpenCASCADE is found, which "
                                "inputs/setup installs; or take a file that nurbs-convert wrote (.h5)"};

std::string read_in_own_process(const ReaderProgram& program, const std::string& bytes,
                                const std::vector<std::string>& arguments) {
  const MemoryFile in, out;
  in.write(bytes);
  const int status = wait_for(start(program, arguments, in, out));
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM))
    throw std::runtime_error(fmt::format("damaged: {} comes to no end with it", program.parser));
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    throw std::runtime_error(fmt::format("{} was killed: more time or memory than allowed", program.name));
  if (WIFSIGNALED(status))
    throw std::runtime_error(
        fmt::format("damaged: {} crashes on it ({})", program.parser, strsignal(WTERMSIG(status))));
  std::string answer = out.read();
  if (is_encoded(answer)) return answer;
  throw std::runtime_error(answer.empty() ? fmt::format("damaged: {} gives up on it", program.parser)
                                          : answer);
}

}  // namespace geometry_io

// SPDX-License-Identifier: GPL-2.0-or-later
// replay FOLDER...: a fuzz target on every file of the folders, without a fuzzer and with any compiler.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "geometry_io/regular_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);

int main(int argc, char** argv) {
  LLVMFuzzerInitialize(&argc, &argv);
  int count = 0;
  for (int i = 1; i < argc; ++i)
    for (const auto& file : std::filesystem::directory_iterator(argv[i])) {
      std::printf("%s\n", file.path().c_str());
      std::fflush(stdout);  // the last line names the file that ended the program
      const std::string bytes = geometry_io::read_regular_file(file.path()).bytes;
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      ++count;
    }
  return count > 0 ? 0 : 1;
}

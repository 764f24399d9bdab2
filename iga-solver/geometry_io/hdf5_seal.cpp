// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/hdf5_seal.h"

#include <fmt/format.h>

#include <cstdint>

namespace geometry_io {
namespace {

constexpr const char* kTitle = "nurbs-geometry in HDF5\n";

// FNV-1a: against damage, not against malice.
std::uint64_t checksum(const std::string& file) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = kSealSize; i < file.size(); ++i)
    hash = (hash ^ static_cast<unsigned char>(file[i])) * 0x100000001b3u;
  return hash;
}

std::string seal_of(const std::string& file) {
  std::string text = fmt::format("{}bytes {}\nchecksum {:016x}\n", kTitle, file.size(), checksum(file));
  text.resize(kSealSize, '\0');
  return text;
}

}  // namespace

void seal(std::string& file) { file.replace(0, kSealSize, seal_of(file)); }

bool is_sealed(const std::string& file) {
  return file.size() > kSealSize && file.compare(0, kSealSize, seal_of(file)) == 0;
}

bool begins_with_seal(const std::string& file) {
  constexpr std::size_t kEnough = 8;  // as long as HDF5's own signature
  return file.size() >= kEnough && file.compare(0, kEnough, kTitle, kEnough) == 0;
}

}  // namespace geometry_io

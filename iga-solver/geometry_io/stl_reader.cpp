// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/stl_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "geometry_io/file_kind.h"
#include "geometry_io/formats.h"
#include "geometry_io/input_error.h"

namespace geometry_io {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50, kNormal = 12;  // [bytes]

std::uint32_t unsigned_at(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

float float_at(const char* bytes) {
  const std::uint32_t word = unsigned_at(bytes);
  float value;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

std::uint32_t binary_count(const std::string& bytes, const std::string& file) {
  if (bytes.size() < kHeader)
    throw InputError(
        fmt::format("{}: {} bytes, expected {} at least in a binary STL file", file, bytes.size(), kHeader));
  const std::uint32_t count = unsigned_at(bytes.data() + kHeader - 4);
  const std::uint64_t expected = kHeader + kTriangle * std::uint64_t{count};
  if (bytes.size() > expected && count > 0)
    throw InputError(
        fmt::format("{}: {} bytes too many behind the last of the {} triangles that are announced at byte "
                    "{}, expected {} bytes in a "
                    "binary STL file, {} are there; 'head -c {} FILE' gives these",
                    file, bytes.size() - expected, count, kHeader - 4, expected, bytes.size(), expected));
  if (bytes.size() != expected)
    throw InputError(
        fmt::format("{}: {} triangles are announced at byte {}, expected {} bytes in a binary "
                    "STL file, {} are there: is it whole?",
                    file, count, kHeader - 4, expected, bytes.size()));
  return count;
}

TriangleSoup read_stl_binary(const std::string& bytes, const std::string& file) {
  const int count = static_cast<int>(binary_count(bytes, file));
  TriangleSoup soup;
  soup.binary = true;
  soup.blocks.push_back({"", 0});
  soup.corners.reserve(9 * static_cast<std::size_t>(count));
  soup.place.reserve(count);
  for (int t = 0; t < count; ++t) {
    const std::size_t begin = kHeader + kTriangle * t + kNormal;
    for (int k = 0; k < 9; ++k) {
      const double x = float_at(bytes.data() + begin + 4 * k);
      if (!std::isfinite(x))
        throw InputError(fmt::format("{}: byte {}: {} as a corner of triangle {}, expected a finite number",
                                     file, begin + 4 * k, x, t + 1));
      soup.corners.push_back(x);
    }
    soup.place.push_back(t + 1);
  }
  return soup;
}

}  // namespace

TriangleSoup read_stl(const std::string& bytes, const std::string& file) {
  return is_binary_stl(bytes) ? read_stl_binary(bytes, file) : read_stl_text(bytes, file);
}

GeometryFile parse_stl(const std::string& bytes, const std::string& file, Units units) {
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty, expected an STL file", file));
  if (!is_binary_stl(bytes)) expect_kind(FileKind::stl, file, bytes);
  std::vector<TriangleMesh> meshes = meshes_of(read_stl(bytes, file));
  if (meshes.empty())
    throw InputError(
        fmt::format("{}: holds no triangle with three different corners, expected one at least", file));
  GeometryFile geometry{units, {}, {}};
  for (TriangleMesh& mesh : meshes) {
    const SurfacePiece piece{static_cast<int>(geometry.patches.size()), std::nullopt};
    geometry.surfaces[kAllPatches].push_back(piece);
    if (!mesh.name.empty() && mesh.name != kAllPatches) geometry.surfaces[mesh.name].push_back(piece);
    geometry.patches.emplace_back(std::move(mesh));
  }
  return geometry;
}

}  // namespace geometry_io

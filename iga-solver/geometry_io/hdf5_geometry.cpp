// SPDX-License-Identifier: GPL-2.0-or-later
// Our HDF5 schema; README.md of this folder lists it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "geometry_io/cad_hdf5.h"
#include "geometry_io/formats.h"
#include "geometry_io/hdf5_file.h"
#include "geometry_io/hdf5_schema.h"

namespace geometry_io {
namespace {

using nurbs::KnotVector;
using nurbs::Patch;

// Runs `build`; what it finds wrong with its arguments is an error of the file at `path`.
template <class Build>
auto blame(const Hdf5Input& file, const std::string& path, Build build) {
  try {
    return build();
  } catch (const std::invalid_argument& error) {
    file.fail(path, error.what());
  }
}

std::vector<double> read_net(const Hdf5Input& file, const std::string& path,
                             const std::vector<std::uint64_t>& shape) {
  const Hdf5Value& array = file.numbers(path);
  if (!std::equal(array.shape.begin(), array.shape.end(), shape.begin(), shape.end()))
    file.fail(path, fmt::format("shape is {}, expected {} by the knots and degrees", shape_text(array.shape),
                                shape_text(shape)));
  return array.numbers;
}

KnotVector read_knots(const Hdf5Input& file, const std::string& path, int degree) {
  const Hdf5Value& array = file.numbers(path);
  if (array.shape.size() != 1)
    file.fail(path, fmt::format("shape is {}, expected [number of knots]", shape_text(array.shape)));
  return blame(file, path, [&] { return KnotVector(degree, array.numbers); });
}

template <int Dim, size_t... Direction>
Patch<Dim> read_patch(const Hdf5Input& file, const std::string& path, const std::vector<int>& degrees,
                      std::index_sequence<Direction...>) {
  const std::array<KnotVector, Dim> knots{
      read_knots(file, path + "/" + kKnots[Direction], degrees[Direction])...};
  std::vector<std::uint64_t> shape = net_shape<Dim>(knots);
  const std::string weights_path = path + "/weights";
  std::vector<double> weights;
  if (file.has(weights_path)) weights = read_net(file, weights_path, shape);
  nurbs::Space<Dim> space =
      blame(file, weights_path, [&] { return nurbs::Space<Dim>(knots, std::move(weights)); });
  shape.push_back(3);
  const std::vector<double> xyz = read_net(file, path + "/control_points", shape);
  Patch<Dim> patch{std::move(space), Eigen::Map<const nurbs::NodalVectors>(xyz.data(), 3, xyz.size() / 3)};
  blame(file, path + "/control_points", [&] { return nurbs::check_patch(patch); });
  return patch;
}

Shape read_shape(const Hdf5Input& file, const std::string& path) {
  const std::vector<int> degrees = file.integers(path, "degrees");
  const size_t dim = degrees.size();
  if (dim != 2 && dim != 3)
    file.fail(path,
              fmt::format("attribute 'degrees' has {} numbers, expected 2 (a surface) or 3 (a volume)", dim));
  for (const std::string& name : file.members(path)) {
    const bool known = std::find(kKnots, kKnots + dim, name) != kKnots + dim;
    if (!known && name != "control_points" && name != "weights")
      file.fail(path, fmt::format("unknown data set '{}' of a patch, expected {}, control_points and weights",
                                  shown(name), fmt::join(kKnots, kKnots + dim, ", ")));
  }
  if (dim == 2) return read_patch<2>(file, path, degrees, std::make_index_sequence<2>());
  return read_patch<3>(file, path, degrees, std::make_index_sequence<3>());
}

int read_version(const Hdf5Input& file) {
  const std::string format = file.text("/", "format");
  if (format != kFormatName)
    file.fail("/", fmt::format("attribute 'format' is '{}', expected '{}'", shown(format), kFormatName));
  const std::vector<int> version = file.integers("/", "version");
  if (version != std::vector<int>{kVersion} && version != std::vector<int>{kCadVersion})
    file.fail("/", fmt::format("attribute 'version' is {}, expected {} or {}", fmt::join(version, " "),
                               kVersion, kCadVersion));
  return version.front();
}

// Those of a CAD model's faces, of which there may be none.
std::vector<nurbs::Surface> read_surfaces(const Hdf5Input& file) {
  std::vector<nurbs::Surface> patches;
  const size_t count = file.members("/patches").size();
  for (size_t p = 0; p < count; ++p) {
    const std::string path = fmt::format("/patches/{}", p);
    Shape patch = read_shape(file, path);
    if (is_volume(patch)) file.fail(path, "is a volume, expected a surface");
    patches.push_back(std::get<nurbs::Surface>(std::move(patch)));
  }
  return patches;
}

Hdf5Builder contents_of(const GeometryFile& geometry) {
  Hdf5Builder file;
  if (geometry.cad) {
    add_cad_file(*geometry.cad, units_name(geometry.units), file);
    return file;
  }
  add_root(kVersion, units_name(geometry.units), file);
  for (size_t p = 0; p < geometry.patches.size(); ++p)
    visit_nurbs(geometry.patches[p], [&](const auto& patch) { add_patch(patch, p, file); });
  if (!geometry.surfaces.empty()) file.add_group("/surfaces");
  for (const auto& [name, pieces] : geometry.surfaces) {
    if (name.find('/') != std::string::npos || name == ".")
      throw std::invalid_argument(
          fmt::format("surface '{}': a name in HDF5 has no '/' and is not '.'", shown(name)));
    file.add_texts("/surfaces/" + name, surface_words(pieces, geometry.patches));
  }
  return file;
}

}  // namespace

GeometryFile parse_hdf5(const std::string& bytes, const std::string& file_name, Units) {
  const Hdf5Input file(bytes, file_name);
  const int version = read_version(file);
  const std::string units = file.text("/", "units");
  GeometryFile geometry{blame(file, "/", [&] { return units_from_name(units); }), {}, {}};
  if (version == kCadVersion) {
    geometry.cad = std::make_shared<const brep::CadModel>(read_cad(file, read_surfaces(file)));
    return geometry;
  }
  const size_t count = file.members("/patches").size();
  if (count == 0) file.fail("/patches", "is empty, expected the groups 0, 1, ...");
  for (size_t p = 0; p < count; ++p)
    geometry.patches.push_back(read_shape(file, fmt::format("/patches/{}", p)));
  if (!file.has("/surfaces")) return geometry;
  for (const std::string& name : file.members("/surfaces")) {
    const std::string path = "/surfaces/" + name;
    const std::vector<std::string>& words = file.texts(path);
    geometry.surfaces[name] = blame(file, path, [&] { return parse_surface(words, geometry.patches); });
  }
  return geometry;
}

std::string write_hdf5(const GeometryFile& geometry) {
  Hdf5Output file;
  file.add(contents_of(geometry).contents());
  return file.bytes();
}

}  // namespace geometry_io

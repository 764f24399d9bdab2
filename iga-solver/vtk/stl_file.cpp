// SPDX-License-Identifier: GPL-2.0-or-later
#include "vtk/stl_file.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <ostream>
#include <stdexcept>

#include "geometry_io/regular_file.h"

namespace vtk {
namespace {

using nurbs::Vector3;

std::string numbers(const Vector3& v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v[0], v[1], v[2]); }

void write_triangles(std::ostream& file, const std::string& name, const nurbs::TriangleMesh& mesh) {
  file << "solid " << name << '\n';
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 A = mesh.vertices.col(a), B = mesh.vertices.col(b), C = mesh.vertices.col(c);
    file << "facet normal " << numbers((B - A).cross(C - A).stableNormalized()) << "\nouter loop\n";
    for (const Vector3& corner : {A, B, C}) file << "vertex " << numbers(corner) << '\n';
    file << "endloop\nendfacet\n";
  }
  file << "endsolid " << name << '\n';
}

}  // namespace

void write_stl(const std::string& path, const std::string& name, const nurbs::TriangleMesh& mesh) {
  const std::string problem =
      geometry_io::write_file(path, [&](std::ostream& file) { write_triangles(file, name, mesh); });
  if (!problem.empty()) throw std::runtime_error(fmt::format("cannot write '{}': {}", path, problem));
}

}  // namespace vtk

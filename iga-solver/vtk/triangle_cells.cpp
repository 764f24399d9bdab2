// SPDX-License-Identifier: GPL-2.0-or-later
#include "vtk/triangle_cells.h"

#include <fmt/format.h>

#include <stdexcept>

namespace vtk {

BezierCells triangle_cells(const TriangleFields& triangles) {
  constexpr std::uint8_t kTriangle = 5;
  BezierCells cells{kTriangle, {}, {}, {}, {}, {}, {}, triangles.cells};
  const nurbs::NodalVectors& vertices = triangles.mesh.vertices;
  cells.points.assign(vertices.data(), vertices.data() + vertices.size());
  for (const auto& corners : triangles.mesh.triangles) {
    cells.connectivity.insert(cells.connectivity.end(), corners.begin(), corners.end());
    cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
  }
  for (const Field& field : cells.cell_fields) {
    if (field.values.cols() != static_cast<Eigen::Index>(cells.offsets.size()))
      throw std::invalid_argument(fmt::format("field '{}' has {} values, expected {}, one per triangle",
                                              field.name, field.values.cols(), cells.offsets.size()));
    if (!field.values.allFinite())
      throw std::invalid_argument(fmt::format("field '{}' is not finite", field.name));
  }
  return cells;
}

}  // namespace vtk

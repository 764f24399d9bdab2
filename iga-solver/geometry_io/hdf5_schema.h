// SPDX-License-Identifier: GPL-2.0-or-later
// What readers and writers of our HDF5 schema share, without HDF5; README.md of this folder lists it.
#pragma once

#include "geometry_io/hdf5_builder.h"
#include "nurbs/patch.h"

namespace geometry_io {

constexpr const char* kFormatName = "nurbs-geometry";
constexpr int kVersion = 1, kCadVersion = 2;
constexpr const char* kKnots[] = {"knots_xi", "knots_eta", "knots_zeta"};

/// Shape of control-point data, the first direction fastest: [n_eta][n_xi].
template <int Dim>
std::vector<std::uint64_t> net_shape(const std::array<nurbs::KnotVector, Dim>& knots) {
  std::vector<std::uint64_t> shape;
  for (int d = Dim - 1; d >= 0; --d) shape.push_back(knots[d].control_point_count());
  return shape;
}

/// Attributes of "/" and the group of patches.
void add_root(int version, const std::string& units, Hdf5Builder& file);
template <int Dim>
void add_patch(const nurbs::Patch<Dim>& patch, size_t number, Hdf5Builder& file);

}  // namespace geometry_io

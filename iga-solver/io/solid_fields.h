// SPDX-License-Identifier: GPL-2.0-or-later
// Fields of a solid by their words, as coefficients of Bezier cells.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry_io/geometry_file.h"
#include "structure/solid/gauss_stresses.h"
#include "vtk/bezier_cells.h"

namespace io {

/// displacement, velocity, stress, principal_stress, von_mises, energy_density
std::vector<std::string> field_words();

/// A whole solid at one time, in the order of ids: what all ranks together know.
struct SolidState {
  double time;                 ///< [time]
  nurbs::NodalVectors u, v;    ///< 3 x control points [length, length/time]
  std::vector<double> memory;  ///< of all elements; empty for a law without
};

class SolidFields {
 public:
  /// Of the solid on `patch`; `quadrature`: of its forces; `words`: of field_words().
  SolidFields(nurbs::Volume patch, std::shared_ptr<const structure::Material> material,
              structure::Quadrature quadrature, geometry_io::Units units, std::vector<std::string> words);

  const nurbs::Volume& patch() const { return patch_; }
  /// On the undeformed patch; displacements and velocities as they are, stresses by vtk/bezier_projection.h
  /// from Cauchy's stress and the energy per reference volume at Gauss points.  With `faces` alone, those of
  /// elements at these faces are worked out, and others 0.
  vtk::PatchFields<3> at(const SolidState& state,
                         const std::optional<std::vector<nurbs::Face>>& faces = {}) const;
  /// "si: coordinates in m, time in s, stress in Pa, ..."
  std::string units() const;

 private:
  std::vector<vtk::Field> projected(const SolidState& state, const std::vector<int>& elements) const;

  nurbs::Volume patch_;
  std::shared_ptr<const structure::Material> material_;
  structure::Quadrature quadrature_;
  geometry_io::Units units_;
  std::vector<std::string> words_;
};

}  // namespace io

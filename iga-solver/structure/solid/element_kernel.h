// SPDX-License-Identifier: GPL-2.0-or-later
// The element loop's inner part: from nodal displacements to nodal forces of one element.
//   H = sum_A u_A (x) dR_A/dX,   f_A = sum_points w|J| P(H) dR_A/dX
// which is Gao & Feng (2019), eqs. 16-19, without the zeros of the Voigt B matrix.
// Values of one element lie component by component, [x|y|z][function], padded with zeros to a multiple of 4
// functions, so that H is nine dot products over contiguous rows with four independent partial sums: fast
// without reassociation by the compiler, and the same to the last bit on every vector width.
#pragma once

#include "structure/material/material.h"

namespace structure {

/// Functions per element rounded up to whole groups of four, so that rows stay whole vectors.
constexpr int padded(int functions) { return (functions + 3) / 4 * 4; }

/// Geometry of one element at its quadrature points.
struct ElementGeometry {
  const double* dR_dX;  ///< [point][direction][padded functions] [1/length]
  const double* wJ;     ///< [point] quadrature weight times |dX/dxi| [length^3]
  const int* slot;      ///< [point]: its place in the memory
  int points;
  int padded;
};

/// What the points of one element remember, [slot][Material::state_size()].
struct ElementMemory {
  const double* state = nullptr;
  double* next = nullptr;  ///< of a time step: where the memory at its end goes; null: held at `state`
  double dt = 0.0;         ///< of this step [time]
};

/// Nodal forces f of the nodal displacements u, both [3][padded].
using ForceKernel = void (*)(const Material& material, const ElementGeometry& element,
                             const ElementMemory& memory, const double* u, double* f);

/// The kernel for a padded number of functions: unrolled for the usual ones (degrees 2 and 3), general
/// otherwise.
ForceKernel force_kernel(int padded);

/// Their change along the change w of u, [3][padded], too.
void element_force_change(const Material& material, const ElementGeometry& element, const double* state,
                          const double* u, const double* w, double* f);

/// Stored energy [energy] of one element whose points remember `state`.
double element_energy(const Material& material, const ElementGeometry& element, const double* state,
                      const double* u);

/// Smallest det(I + H) [-] at the quadrature points; not a number if it is none at one of them.
double smallest_volume_ratio(const ElementGeometry& element, const double* u);

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Loads that change with time or with the motion.
#pragma once

#include <vector>

#include "structure/conditions/field.h"
#include "structure/conditions/skin_quadrature.h"
#include "structure/conditions/time_function.h"
#include "structure/halo.h"

namespace structure {

using nurbs::NodalVectors;

class ChangingLoad {
 public:
  virtual ~ChangingLoad() = default;
  /// Adds forces at the time t on control points at x, both 3 x n: whole at the nodes that the part owns.
  /// No allocation.  Collective.
  virtual void add(double t, const NodalVectors& x, const Halo& halo, NodalVectors& f) const = 0;
};

/// Forces that rise and fall together.
class FactoredLoad final : public ChangingLoad {
 public:
  /// Of full size, 3 x n.
  FactoredLoad(const NodalVectors& forces, TimeFunction factor);
  void add(double t, const NodalVectors& x, const Halo& halo, NodalVectors& f) const override;

 private:
  std::vector<Eigen::Index> columns_;  // with forces
  NodalVectors forces_;                // on these
  TimeFunction factor_;
};

/// A dead traction of place and time [force/length^2], per reference area.
class FieldTraction final : public ChangingLoad {
 public:
  FieldTraction(SkinQuadrature skin, Field traction, TimeFunction factor);
  void add(double t, const NodalVectors& x, const Halo& halo, NodalVectors& f) const override;

 private:
  SkinQuadrature skin_;
  Field traction_;
  TimeFunction factor_;
};

}  // namespace structure

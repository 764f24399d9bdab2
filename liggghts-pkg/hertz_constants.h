// SPDX-License-Identifier: GPL-2.0-or-later
// What contacts between two atom types have in common whose elastic force is K x^(3/2).
#pragma once

#include <string>
#include <vector>

#include "pointers.h"

namespace liggghts_pkg {

/// Of a particle of mass m and effective radius r*, at the overlap x.
struct PairConstants {
  double normal;   ///< K / sqrt(r*) = 4/3 lambda E* [pressure]
  double damping;  ///< gamma / (sqrt(m) (r* x)^(1/4)) [pressure^(1/2)]
  double shear;    ///< k_t / sqrt(r* x) = 8 G* [pressure]
};

class HertzConstants {
 public:
  /// From the deck's property/global, as the model has them.  Of other models it knows nothing.
  void read(LAMMPS_NS::LAMMPS* lmp, const std::string& normal_model);
  bool are_known() const { return !values_.empty(); }
  /// Types from 1; after read() of such a model.
  const PairConstants& of_types(int i, int j) const { return values_[(i - 1) * types_ + (j - 1)]; }

 private:
  int types_ = 0;
  std::vector<PairConstants> values_;
};

}  // namespace liggghts_pkg

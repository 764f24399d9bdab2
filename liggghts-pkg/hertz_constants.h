// SPDX-License-Identifier: GPL-2.0-or-later
// K / sqrt(r*) of contacts between two atom types whose elastic force is K x^(3/2).
#pragma once

#include <string>
#include <vector>

#include "pointers.h"

namespace liggghts_pkg {

class HertzConstants {
 public:
  /// 4/3 lambda E* from the deck's property/global, as the model has it.  Of other models it knows nothing.
  /// `corrected`: throws std::invalid_argument if contacts with the wall's type are damped by more than
  /// kLeastRestitution: with a correction of the elastic force alone they lose too little (at 0.9 as much as
  /// at 0.906, at 0.6 as at 0.62).
  void read(LAMMPS_NS::LAMMPS* lmp, const std::string& normal_model, int wall_type, bool corrected);
  static constexpr double kLeastRestitution = 0.9;
  /// [pressure]; types from 1; not a number before read().
  double of_types(int i, int j) const;

 private:
  int types_ = 0;
  std::vector<double> values_;
};

}  // namespace liggghts_pkg

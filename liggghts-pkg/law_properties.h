// SPDX-License-Identifier: GPL-2.0-or-later
// What contact laws take from the deck's `fix ID all property/global NAME ...`.
#pragma once

#include <vector>

#include "contact_laws.h"
#include "property_registry.h"

namespace liggghts_pkg {

/// The values of a law's properties for each pair of atom types.
class LawPropertyValues {
 public:
  template <class Iterator>
  LawPropertyValues(Iterator first, Iterator last) : properties_(first, last) {}

  /// Reads them, and prints them on rank 0.  Stops LIGGGHTS, with the line that the deck must have, where one
  /// is missing or not a number > 0.  `law` is its word.
  void read(PropertyRegistry& registry, const char* law);

  /// Values for two types, counted from 1, in the order of the properties.
  const double* of_types(int i, int j) const {
    return values_.data() + (i * (max_type_ + 1) + j) * properties_.size();
  }
  /// Whether a unit has a length in it, beside pressures.
  bool have_lengths() const;

 private:
  void read_one(PropertyRegistry& registry, const char* law, std::size_t k);
  void print_one(LAMMPS_NS::LAMMPS* lmp, const char* law, std::size_t k) const;

  std::vector<LawProperty> properties_;
  int max_type_ = 0;
  std::vector<double> values_;
};

}  // namespace liggghts_pkg

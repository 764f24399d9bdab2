// SPDX-License-Identifier: GPL-2.0-or-later
// Memory of one contact between a particle and the wall, as it lies in a row of `fix property/atom` (which
// carries it through sorting, migration between ranks and restart):
//   [patch, xi, eta, history of LIGGGHTS' contact models ...]
// The foot is the warm start of the next projection.  Patch < 0 marks an empty slot, so a fresh row must hold
// -1 there.
#pragma once

#include <algorithm>

#include "nurbs/patch.h"

namespace liggghts_pkg {

class ContactSlot {
 public:
  static constexpr int kFootValues = 3;
  static constexpr double kEmpty = -1.0;

  ContactSlot(double* values, int history_count) : values_(values), history_count_(history_count) {}

  bool empty() const { return values_[0] < 0.0; }
  nurbs::Parameter<2> xi() const { return {values_[1], values_[2]}; }
  void set_foot(int patch, const nurbs::Parameter<2>& xi) {
    values_[0] = patch;
    values_[1] = xi[0];
    values_[2] = xi[1];
  }

  /// Where the contact models keep their values (world-frame shear displacement, ...); null if they keep
  /// none.
  double* history() { return history_count_ > 0 ? values_ + kFootValues : nullptr; }
  void forget_history() { std::fill_n(values_ + kFootValues, history_count_, 0.0); }
  void clear() {
    values_[0] = kEmpty;
    forget_history();
  }

 private:
  double* values_;
  int history_count_;
};

}  // namespace liggghts_pkg

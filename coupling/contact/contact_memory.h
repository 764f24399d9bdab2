// SPDX-License-Identifier: GPL-2.0-or-later
// Memory of a particle's contacts with the wall: one slot per contact, each a row of numbers that the
// particles' code carries through sorting, migration between ranks and restart:
//   [patch + side, xi, eta, history of the contact model ...]
// A slot belongs to a branch, that is to one local minimum of the distance for as long as it moves without a
// jump; the foot is where the branch was last.  Patch < 0 marks an empty slot, so a fresh row must hold -1
// there.  The side of the surface that the particle's centre is on is the fraction behind the patch's number:
// 1/4 where dS/dxi x dS/deta points, 1/2 on the other side, 0 if nobody has looked yet.
#pragma once

#include <algorithm>
#include <cstddef>

#include "nurbs/assert.h"
#include "nurbs/multi_patch.h"

namespace contact {

class ContactSlot {
 public:
  static constexpr int kFootValues = 3;
  static constexpr double kEmpty = -1.0;

  ContactSlot(double* values, int history_count) : values_(values), history_count_(history_count) {}

  bool empty() const { return values_[0] < 0.0; }
  nurbs::SurfacePoint foot() const { return {static_cast<int>(values_[0]), {values_[1], values_[2]}}; }
  /// +1 or -1: of the normal of that patch; 0: not known.
  int side() const {
    const double fraction = values_[0] - static_cast<int>(values_[0]);
    return fraction == 0.0 ? 0 : fraction < 0.4 ? 1 : -1;
  }
  /// Whether it is on this patch, on a side that is known.
  bool is_beside(int patch) const {
    const double fraction = values_[0] - patch;
    return fraction > 0.0 && fraction < 1.0;
  }
  void set_foot(const nurbs::SurfacePoint& foot, int side) {
    NURBS_ASSERT(foot.patch >= 0 && -1 <= side && side <= 1, foot.patch, side);
    static constexpr double kFraction[] = {0.5, 0.0, 0.25};
    values_[0] = foot.patch + kFraction[1 + side];
    set_parameters(foot);
  }
  /// On the same patch and side.
  void set_parameters(const nurbs::SurfacePoint& foot) {
    values_[1] = foot.xi[0];
    values_[2] = foot.xi[1];
  }

  /// Where the contact models keep their values (world-frame shear displacement, ...); null if they keep
  /// none.
  double* history() { return history_count_ > 0 ? values_ + kFootValues : nullptr; }
  void clear() {
    values_[0] = kEmpty;
    std::fill_n(values_ + kFootValues, history_count_, 0.0);
  }

 private:
  double* values_;
  int history_count_;
};

/// All slots of one particle.  Each is in a cache line of its own, so who looks at them in every step keeps a
/// number `used`: from there on all are empty, as far as these functions are the only ones that fill them.
class ParticleSlots {
 public:
  /// slots[s] + offset is a slot's row.  Keeps a reference to `used`.
  ParticleSlots(double* const* slots, int slot_count, std::ptrdiff_t offset, int history_count, int& used)
      : slots_(slots), slot_count_(slot_count), history_count_(history_count), offset_(offset), used_(used) {}

  int slot_count() const { return slot_count_; }
  int used() const { return used_; }
  ContactSlot slot(int s) const {
    NURBS_ASSERT(0 <= s && s < slot_count_, s, slot_count_);
    return {slots_[s] + offset_, history_count_};
  }
  int filled() const {
    int count = 0;
    for (int s = 0; s < used_; ++s) count += !slot(s).empty();
    return count;
  }
  /// Index of an empty slot, which from now on is used; -1 if there is none.
  int take_empty() const {
    for (int s = 0; s < used_; ++s)
      if (slot(s).empty()) return s;
    return used_ < slot_count_ ? used_++ : -1;
  }
  void clear() const {
    for (int s = 0; s < used_; ++s) slot(s).clear();
    used_ = 0;
  }
  /// `used` as it is, whatever it was; as little as it may be, of what it was.
  void count_used() const {
    used_ = slot_count_;
    trim_used();
  }
  void trim_used() const {
    while (used_ > 0 && slot(used_ - 1).empty()) --used_;
  }

 private:
  double* const* slots_;
  int slot_count_, history_count_;
  std::ptrdiff_t offset_;
  int& used_;
};

/// The slots of all particles of a rank: slots[s] has a row of row_size(history_count) numbers for each.
struct ContactMemory {
  double* const* slots;
  int slot_count;
  int history_count;  ///< values that the contact model keeps for each contact

  static int row_size(int history_count) { return ContactSlot::kFootValues + history_count; }
  std::ptrdiff_t offset(int particle) const {
    return static_cast<std::ptrdiff_t>(particle) * row_size(history_count);
  }
  ParticleSlots of(int particle, int& used) const {
    return {slots, slot_count, offset(particle), history_count, used};
  }
  ContactSlot slot(int particle, int s) const {
    NURBS_ASSERT(0 <= s && s < slot_count, s, slot_count);
    return {slots[s] + offset(particle), history_count};
  }
};

}  // namespace contact

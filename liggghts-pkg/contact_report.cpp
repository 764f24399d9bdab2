// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_report.h"

#include <algorithm>

#include "compute_pair_gran_local.h"

namespace liggghts_pkg {

using contact::Vector3;
using LAMMPS_NS::ComputePairGranLocal;

namespace {

// It makes room by itself for the contacts of meshes alone.
struct Rows : ComputePairGranLocal {
  static void make(ComputePairGranLocal& compute, int count) {
    if (count > compute.*(&Rows::nmax)) (compute.*(&Rows::reallocate))(count);
  }
};

}  // namespace

ContactReport::ContactReport(ComputePairGranLocal& compute, int rows, int history_count)
    : compute_(compute), history_(history_count) {
  Rows::make(compute, rows);
}

// In the arithmetic of LIGGGHTS' walls, so that digits are theirs.
void ContactReport::add(int wall, const contact::Contact& contact, const Vector3& centre, double radius,
                        int history_count) {
  std::fill(history_.begin(), history_.end(), 0.0);
  std::copy_n(contact.history, std::min<std::size_t>(history_count, history_.size()), history_.begin());
  Vector3 point = centre - contact.delta, v_wall = contact.wall_velocity,
          to_wall = contact.distance < 0.0 ? contact.delta.normalized() : -contact.delta.normalized();
  const double distance = radius - contact.overlap;
  const Vector3 &F = contact.force, &T = contact.torque;
  compute_.add_wall_1(wall, contact.foot.patch, contact.particle, point.data(), v_wall.data());
  compute_.add_wall_2(contact.particle, F[0], F[1], F[2], T[0], T[1], T[2], history_.data(),
                      distance * distance, to_wall.data());
}

}  // namespace liggghts_pkg

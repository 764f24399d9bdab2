// SPDX-License-Identifier: GPL-2.0-or-later
#include "output_observer.h"

#include <fmt/format.h>

#include <stdexcept>

#include "atom.h"
#include "coupling/finnie.h"
#include "fix_property_global.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

namespace liggghts_pkg {

using contact::Contact;
using contact::Vector3;

void OutputObserver::begin_run(const char* style) {
  if (!output_.tracks_wear()) return;
  const int types = lmp_->atom->ntypes;
  LAMMPS_NS::Fix* constants = lmp_->modify->find_fix_property("k_finnie", "property/global",
                                                              "peratomtypepair", types, types, style, false);
  if (!constants)
    throw std::invalid_argument(
        fmt::format("field wear needs Finnie's constants [1/pressure], expected 'fix ID all property/global "
                    "k_finnie peratomtypepair {0} ...' with {0} x {0} numbers in the deck",
                    types));
  k_finnie_ = static_cast<LAMMPS_NS::FixPropertyGlobal*>(constants)->get_array();
}

void OutputObserver::see(const Contact& contact) {
  const Vector3 normal = contact.normal();
  const double worn = output_.tracks_wear() ? worn_volume(contact, normal) : 0.0;
  const Eigen::Matrix3d to_body = frame_.rotation.transpose();
  output_.add({contact.foot, -(to_body * contact.force), to_body * normal, worn});
}

double OutputObserver::worn_volume(const Contact& contact, const Vector3& normal) const {
  const int i = contact.particle;
  const double k = k_finnie_[wall_type_ - 1][lmp_->atom->type[i] - 1];
  const Vector3 v = Vector3::Map(lmp_->atom->v[i]) - contact.wall_velocity;
  return lmp_->update->dt * coupling::finnie_wear_rate(v, normal, contact.force.norm(), k);
}

}  // namespace liggghts_pkg

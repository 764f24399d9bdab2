// SPDX-License-Identifier: GPL-2.0-or-later
// LIGGGHTS' compiled contact models, as the contact loop asks for them.
#ifndef LMP_LIGGGHTS_CONTACT_MODEL_H
#define LMP_LIGGGHTS_CONTACT_MODEL_H

#include <vector>

#include "atom.h"
#include "coupling/contact/contact_model.h"
#include "fix_wall_gran.h"
#include "hertz_constants.h"
#include "tangential_spring.h"

namespace liggghts_pkg {

class LiggghtsContactModel final : public contact::ContactModel {
 public:
  /// `models`: those that LIGGGHTS' factory made for `wall`.  `springs`: where they keep tangential ones.
  /// `curvature_radius`: contacts have an effective radius of their own.
  LiggghtsContactModel(LAMMPS_NS::FixWallGran& wall, LIGGGHTS::Walls::IGranularWall& models,
                       LAMMPS_NS::Atom& atom, const TangentialSprings& springs, bool curvature_radius)
      : wall_(wall), models_(models), atom_(atom), springs_(springs), curvature_radius_(curvature_radius) {}

  void begin_step() { springs_.begin_step(); }
  void evaluate(contact::Contact* contacts, int count) override;
  /// Of a normal model whose constants were read, with a wall of this type.
  double hertz_constant(int particle) const override {
    return constants_.are_known() ? of_pair(particle).normal : ContactModel::hertz_constant(particle);
  }
  double hertz_damping(int particle) const override;
  double shear_constant(int particle) const override {
    return springs_.exist() && constants_.are_known() ? of_pair(particle).shear
                                                      : ContactModel::shear_constant(particle);
  }
  nurbs::Vector3 shear_stretch(const contact::Contact& contact) const override {
    return springs_.exist() ? springs_.stretch(contact.history) : ContactModel::shear_stretch(contact);
  }
  nurbs::Vector3 slip(const contact::Contact& contact) const override;
  void hear_of_corrections(const contact::Contact* contacts, int count) override;
  /// Before each run.
  void read_constants(LAMMPS_NS::LAMMPS* lmp, const std::string& normal_model, int wall_type) {
    constants_.read(lmp, normal_model);
    wall_type_ = wall_type;
  }
  void end_step(bool setup) { springs_.end_step(setup); }

  const TangentialSprings& springs() const { return springs_; }

 private:
  const PairConstants& of_pair(int particle) const {
    return constants_.of_types(atom_.type[particle], wall_type_);
  }
  void compute(contact::Contact& contact, LCM::SurfacesIntersectData& data);
  void compute_with_spring(contact::Contact& contact, LCM::SurfacesIntersectData& data,
                           TangentialSprings& springs);
  void compute_with_effective_radius(contact::Contact& contact, LCM::SurfacesIntersectData& data);

  LAMMPS_NS::FixWallGran& wall_;
  LIGGGHTS::Walls::IGranularWall& models_;
  LAMMPS_NS::Atom& atom_;
  TangentialSprings springs_;
  HertzConstants constants_;
  int wall_type_ = 1;
  bool curvature_radius_;
  std::vector<double*> force_rows_,
      torque_rows_;  // in place of LIGGGHTS' own while it is asked; per particle
};

}  // namespace liggghts_pkg

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
// The spring of LIGGGHTS' `tangential history`, and the energy that nobody gives it.  With its stretch xi and
// stiffness k_t, which the normal model sets anew in each step, its energy U = 1/2 k_t |xi|^2 changes by
//   U(n+1) - U(n) = 1/2 (k_t(n+1) - k_t(n)) |xi(n)|^2 + 1/2 k_t(n+1) (|xi(n+1)|^2 - |xi(n)|^2).
// The second term is the work of relative motion less what slip takes.  The first is no work at all: a spring
// gains where overlap grows under it, and loses where overlap shrinks; a contact that opens loses what it
// had. Mindlin & Deresiewicz (1953) have no such term: there what one overlap has stuck slips at a smaller
// one. Source: Elata & Berryman (1996), Mechanics of Materials 24, 229-240.
#ifndef LMP_TANGENTIAL_SPRING_H
#define LMP_TANGENTIAL_SPRING_H

#include <string>
#include <vector>

#include "nurbs/types.h"
#include "pointers.h"

namespace liggghts_pkg {

/// Where contacts of these models (`model ... surface ...`) keep xi, from which number of their history on;
/// -1 if they have no such spring.
int tangential_spring_place(LAMMPS_NS::LAMMPS* lmp, const std::vector<std::string>& model_words);

/// Of this rank's contacts with one wall.
class TangentialSprings {
 public:
  explicit TangentialSprings(int place) : place_(place) {}

  bool exist() const { return place_ >= 0; }
  nurbs::Vector3 stretch(const double* history) const { return nurbs::Vector3::Map(history + place_); }
  void stretch_by(const nurbs::Vector3& slip, double* history) const {
    Eigen::Map<nurbs::Vector3>{history + place_} += slip;
  }
  // Number by number, as the models have just written it: wider loads would have to wait for that.
  double squared_stretch(const double* history) const {
    const double* const xi = history + place_;
    return xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2];
  }

  void begin_step() { before_ = now_ = 0.0; }
  /// Of one contact: stiffness [force/length], |xi|^2 before and after the models had it [length^2].
  void add(double stiffness, double before, double now) {
    before_ += stiffness * before;
    now_ += stiffness * now;
  }
  /// `setup`: a run begins, and with it the sum.
  void end_step(bool setup) {
    gained_ = setup ? 0.0 : gained_ + 0.5 * (before_ - stored_);
    stored_ = now_;
  }
  /// Sum of the first terms since the beginning of the run [energy].  A contact that goes to another rank is
  /// lost here and gained there: only the sum over ranks means something.
  double gained() const { return gained_; }

 private:
  int place_;
  double before_ = 0.0, now_ = 0.0;  // twice springs' energy with this step's stiffness, before and after it
  double stored_ = 0.0, gained_ = 0.0;
};

}  // namespace liggghts_pkg

#endif

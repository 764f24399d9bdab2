// SPDX-License-Identifier: GPL-2.0-or-later
// What contacts do to a surface: sums over samples and ranks of their forces and of what they wear off, at
// places of the surface, and of their number, in its cells.  What places and cells are says who derives from
// this.
#pragma once

#include <mpi.h>

#include <variant>
#include <vector>

#include "coupling/contact_surface.h"
#include "coupling/rigid_frame.h"
#include "vtk/bezier_cells.h"
#include "vtk/triangle_cells.h"

namespace coupling {

/// One contact as the surface feels it, in the body frame.
struct SurfaceContact {
  nurbs::SurfacePoint foot;
  Vector3 force;       ///< on the surface [force]
  Vector3 normal;      ///< unit, from the surface to the particle
  double worn_volume;  ///< in this step [length^3]
};

class ContactFields {
 public:
  struct Selection {
    bool pressure = true, shear = true, contact_count = true, wear = false;
  };
  using State = std::variant<std::vector<vtk::PatchFields<2>>, vtk::TriangleFields>;

  virtual ~ContactFields() = default;

  /// A new step whose contacts count; the same on every rank.
  void begin_sample() { ++samples_; }
  /// A contact of this rank's particles.
  virtual void add(const SurfaceContact& contact) = 0;

  /// Collective; the result is complete on rank 0.  `control_points` (3 x n; none of a wall of faces): the
  /// surface as it now is, in the body frame; the result is in space.  Per place
  ///   pressure  normal force per area, pressing > 0 [pressure];  shear  tangential force per area, a vector
  ///   wear      depth worn off since the beginning [length],
  /// per cell
  ///   contact_count;
  /// all but wear are means over the samples, 0 without samples.
  virtual State state(const NodalVectors& control_points, const RigidFrame& frame,
                      const Selection& selection) = 0;
  /// Forgets all samples, not the wear.
  void begin_interval();

  /// Samples and wear as numbers, for restart files.  save is collective, its result complete on rank 0; load
  /// throws std::invalid_argument if the size does not fit.
  std::vector<double> save() const;
  void load(const std::vector<double>& state);
  std::size_t state_size() const { return 1 + forces_.size() + contacts_.size(); }

 protected:
  enum Row { kNormal, kShear, kWear = kShear + 3, kRows };

  ContactFields(MPI_Comm comm, int places, int cells);
  static Eigen::Matrix<double, kRows, 1> rows_of(const SurfaceContact& contact);
  void add_at(int place, const Eigen::Matrix<double, kRows, 1>& rows);
  void count_in(int cell);

  double mean() const { return samples_ > 0.0 ? 1.0 / samples_ : 0.0; }
  Eigen::MatrixXd all_forces() const { return sum_over_ranks(forces_); }
  Eigen::MatrixXd all_contacts() const { return sum_over_ranks(contacts_); }
  /// The fields asked for of these places, from their sums per area (kRows x places), in space.
  std::vector<vtk::Field> fields_of_places(const Eigen::MatrixXd& per_area, const RigidFrame& frame,
                                           const Selection& selection) const;
  /// Likewise of these cells, from the numbers of their contacts.
  std::vector<vtk::Field> fields_of_cells(const Eigen::MatrixXd& contacts, const Selection& selection) const;

 private:
  void note_load(int place);
  Eigen::MatrixXd sum_over_ranks(const Eigen::MatrixXd& local) const;

  MPI_Comm comm_;
  // of this rank; sums over samples (kNormal, kShear, contacts), over all time (kWear)
  Eigen::MatrixXd forces_;    // kRows x places [force], kWear [length^3]
  Eigen::MatrixXd contacts_;  // 1 x cells
  double samples_ = 0.0;
  // where sums are not zero, so that a step without means need not look at all of the wall
  std::vector<int> loaded_, counted_;  // places, cells
  std::vector<bool> is_loaded_;
};

}  // namespace coupling

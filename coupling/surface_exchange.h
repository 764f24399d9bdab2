// SPDX-License-Identifier: GPL-2.0-or-later
// All transfer between the ranks of the particles and the ranks of the structure.  Place and velocity come
// for the elements that particles are near.  Where every rank holds the whole structure, that is a local copy
// and contacts go to all ranks; of a structure in parts, contacts go to the owners of their element.  Places
// are those that contacts meet (cross_shift.h).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "coupling/contact_force.h"
#include "coupling/cross_shift.h"
#include "coupling/net_spread.h"
#include "coupling/seams.h"
#include "coupling/structure_solver.h"
#include "coupling/surface_owners.h"

namespace coupling {

class SurfaceExchange {
 public:
  /// The solver must outlive the exchange.  Collective, as everything here is.
  SurfaceExchange(MPI_Comm comm, StructureSolver& solver);

  /// Begins a step of the solver; its surface is then to be brought.
  void begin_step() {
    solver_.begin_step();
    if (shift_) shift_->begin_step();
  }
  /// Brings positions and velocities of all of the surface's control points to this rank: when lists of
  /// candidates are built, and for output.
  void import_surface();
  /// From now on contacts are with these elements (of the surface, in any order) alone, and motion counts
  /// from where the surface is, until the next call.  Of a structure that deforms.
  void follow(const std::vector<int>& elements);
  /// The same as import_surface() for these elements and those around them; call after every change of the
  /// solver's state.  What is farther away stays as it was.
  void import_followed();
  const NodalVectors& positions() const { return positions_; }  ///< 3 x n_control_points [length]
  /// The same where the body has them, a little beside where corrected contacts meet them: for output, as of
  /// the last import_surface().
  const NodalVectors& body_positions() const { return shift_ || seams_ ? body_positions_ : positions_; }
  const NodalVectors& velocities() const { return velocities_; }  ///< 3 x n_control_points [length/time]
  /// StructureSolver::inverse_node_mass of all control points (3 x n_control_points), or empty.
  const NodalVectors& inverse_masses() const { return inverse_masses_; }
  /// What a foot is accelerated by along n under a unit force along n [1/mass].
  double inverse_mass_at(const nurbs::SurfacePoint& foot, const Vector3& n) const;
  /// Whether its element is so near a seam that contacts meet it beside where the body has it (seams.h).
  bool is_at_seam(const nurbs::SurfacePoint& foot) const;
  /// Whether it is where the mesh kinks and contacts meet that.
  bool is_at_kink(const nurbs::SurfacePoint& foot) const;
  /// What contacts that are corrected are spread by; null: they are not.
  const NetSpread* net_spread() const { return spread_.get(); }
  /// The control points that import_followed() brings to this rank, rising; all, before the first follow().
  const std::vector<int>& followed() const { return followed_; }
  /// Largest distance of a control point from where it was at the last follow(), of the whole surface; not a
  /// number if one is none [length].  Each rank looks at those that it owns.
  double largest_motion() const;

  /// Whether it is so on any rank, as far as they must agree.
  bool any(bool here) const;
  /// What all ranks have, one after the other, as far as they must agree.
  std::vector<double> all(const std::vector<double>& here) const;

  /// Returns the forces on the nodes that this rank owns, zero for others: each contact is spread to its
  /// control points (eq. 34) in the order of (tag, branch), so the sums do not depend on how many ranks there
  /// are.  Takes as long as there are contacts.  `is_setup`: nothing has moved, the same contacts were there
  /// already.  Throws FailedOnThisRank, with the place, where contacts are so stiff together that forces
  /// between them (cross_shift.h) would grow by themselves; std::runtime_error on every rank if there are
  /// more contacts than MPI counts.
  const NodalForces& export_add(const std::vector<ContactForce>& local, bool is_setup = false);

  /// What is known of forces of former steps as numbers, for restart files: whatever the ranks are, complete
  /// on every rank, none where contacts do not need that.  load throws std::invalid_argument if the size does
  /// not fit.
  std::vector<double> save() const;
  void load(const std::vector<double>& state);
  std::size_t state_size() const { return shift_ ? shift_->state_size() : 0; }

 private:
  void import_own(const std::vector<int>& control_points);
  void straighten(const std::vector<int>& control_points);
  void find_links();
  template <class ForEach>
  void follow_also(ForEach for_each_beside);
  void import_masses();
  void gather(const std::vector<ContactForce>& local);
  void send_to_owners(const std::vector<ContactForce>& local);
  void spread(const ContactForce& contact);
  void touch(int control_point);
  template <class Basis>
  void touch(const Basis& foot);
  void expect_to_stay() const;
  void forget_forces();

  MPI_Comm comm_;
  StructureSolver& solver_;
  SurfaceMap map_;  ///< from the columns of this rank's nodal arrays, of the control points that it owns
  std::vector<int> own_;                   ///< these control points
  std::unique_ptr<SurfaceOwners> owners_;  ///< of a structure in parts
  std::unique_ptr<CrossShift> shift_;      ///< of a body whose mesh gives way beside contacts
  std::unique_ptr<NetSpread> spread_;      ///< likewise
  std::unique_ptr<NetShares> kinks_;       ///< control points there have one, their own
  std::unique_ptr<Seams> seams_;           ///< likewise
  std::vector<int> on_seams_;              ///< all control points there
  std::vector<int> followed_, followed_on_seams_;
  std::vector<int> brought_;  ///< of own_, those that this rank or another follows
  NodalVectors own_places_;   ///< of own_, at the last follow()
  NodalVectors positions_, velocities_, inverse_masses_, body_positions_;
  NodalVectors surface_forces_;  ///< zero but where contacts are
  NodalForces nodal_forces_;
  std::vector<int> touched_;  ///< control points with forces, rising
  std::vector<bool> is_touched_;
  std::vector<double> stiffness_;       ///< of contacts on the element that begins with a control point
  std::vector<ContactForce> contacts_;  ///< of all ranks, with what this one owns
  std::vector<std::vector<ContactForce>> to_rank_;
  std::vector<int> owners_of_contact_;
  std::vector<std::int64_t> all_counts_;  ///< of contacts per rank
  std::vector<int> counts_, offset_;      ///< the same as MPI takes them
};

}  // namespace coupling

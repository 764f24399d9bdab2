// SPDX-License-Identifier: GPL-2.0-or-later
// The surface of a structure in parts: which rank owns which of its control points, and what goes between the
// owners and the ranks whose particles are near.  Everything here is collective.
#pragma once

#include <mpi.h>

#include <vector>

#include "coupling/contact_force.h"
#include "nurbs/types.h"

namespace coupling {

using nurbs::NodalVectors;

class SurfaceOwners {
 public:
  /// `own`: the control points that this rank owns, rising, of all `control_points`.  Throws
  /// std::invalid_argument, on every rank, unless each is owned by one rank.
  SurfaceOwners(MPI_Comm comm, std::vector<int> own, int control_points);
  ~SurfaceOwners();
  SurfaceOwners(const SurfaceOwners&) = delete;
  SurfaceOwners& operator=(const SurfaceOwners&) = delete;

  int owner(int control_point) const { return owner_[control_point]; }
  const std::vector<int>& own() const { return own_; }

  /// From now on this rank wants these control points (rising), and has contacts with their elements alone.
  void want(const std::vector<int>& control_points);
  /// Of what this rank owns, what others want, rising.
  std::vector<int> wanted_by_others() const;
  /// Positions and velocities (3 x control_points), whose own columns that anybody wants are there,
  /// of what is wanted: one message from each owner of some.
  void bring_wanted(NodalVectors& positions, NodalVectors& velocities);
  /// The same of the whole surface, of which all own columns are there.
  void bring_all(NodalVectors& positions, NodalVectors& velocities) const;
  /// The contacts that others have with what this rank owns are added to `here`; `there[r]` go to rank r: one
  /// message to each owner of what is wanted, with contacts or without.  Throws std::logic_error for contacts
  /// with an owner of whom nothing is wanted.
  void exchange(const std::vector<std::vector<ContactForce>>& there, std::vector<ContactForce>& here) const;
  /// Of all ranks, number by number.
  std::vector<double> sum(std::vector<double> numbers) const;
  /// Of all ranks; not a number if one is none.
  double largest(double value) const;

 private:
  /// What another rank and this one tell each other.
  struct Link {
    int rank;
    std::vector<int> control_points;
    std::vector<double> numbers;  ///< position and velocity of each
  };

  MPI_Comm comm_;
  int me_ = 0, ranks_ = 1;
  std::vector<int> own_, owner_;
  std::vector<Link> owners_;   ///< of what is wanted, others than this rank
  std::vector<Link> clients_;  ///< who want what this rank owns
};

}  // namespace coupling

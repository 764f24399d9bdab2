// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/surface_exchange.h"

#include <algorithm>
#include <tuple>

#include "coupling/force_distribution.h"
#include "nurbs/assert.h"

namespace coupling {

SurfaceExchange::SurfaceExchange(MPI_Comm comm, StructureSolver& solver) : comm_(comm), solver_(solver) {
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  bytes_.resize(ranks);
  offset_.resize(ranks);
  surface_forces_.setZero(3, solver.surface().topology.control_point_count());
  nodal_forces_.setZero(3, solver.surface().map.node_count());
  import_surface();
}

void SurfaceExchange::import_surface() {
  solver_.surface().map.to_surface(solver_.positions(), positions_);
  solver_.surface().map.to_surface(solver_.velocities(), velocities_);
}

const NodalVectors& SurfaceExchange::export_add(const std::vector<ContactForce>& local) {
  gather(local);
  std::sort(contacts_.begin(), contacts_.end(), [](const ContactForce& a, const ContactForce& b) {
    return std::tie(a.tag, a.branch) < std::tie(b.tag, b.branch);
  });

  surface_forces_.setZero();
  for (const ContactForce& contact : contacts_) {
    NURBS_ASSERT(Vector3::Map(contact.F).allFinite(), contact.tag, contact.F[0], contact.F[1], contact.F[2]);
    const FootBasis foot(solver_.surface().topology, {contact.patch, {contact.xi[0], contact.xi[1]}});
    foot.distribute(Vector3::Map(contact.F), surface_forces_);
  }
  nodal_forces_.setZero();
  solver_.surface().map.add_to_nodes(surface_forces_, nodal_forces_);
  return nodal_forces_;
}

void SurfaceExchange::gather(const std::vector<ContactForce>& local) {
  const int ranks = static_cast<int>(bytes_.size());
  if (ranks == 1) {
    contacts_ = local;
    return;
  }
  const int mine = static_cast<int>(local.size() * sizeof(ContactForce));
  MPI_Allgather(&mine, 1, MPI_INT, bytes_.data(), 1, MPI_INT, comm_);
  int total = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    offset_[rank] = total;
    total += bytes_[rank];
  }
  NURBS_ASSERT(total % sizeof(ContactForce) == 0, total, sizeof(ContactForce));
  contacts_.resize(total / sizeof(ContactForce));
  if (total == 0) return;
  MPI_Allgatherv(local.data(), mine, MPI_BYTE, contacts_.data(), bytes_.data(), offset_.data(), MPI_BYTE,
                 comm_);
}

}  // namespace coupling

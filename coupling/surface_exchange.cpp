// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/surface_exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

#include "brep/face_shape.h"
#include "coupling/force_distribution.h"
#include "nurbs/assert.h"

namespace coupling {

namespace {

/// Numbers of contacts, and where in their list a rank's begin, are an int for MPI.
void expect_int(std::int64_t contacts) {
  constexpr int kMost = std::numeric_limits<int>::max();
  if (contacts > kMost)
    throw std::runtime_error("SurfaceExchange: " + std::to_string(contacts) +
                             " contacts with a deforming wall in one step, expected at most " +
                             std::to_string(kMost));
}

nurbs::SurfacePoint foot_of(const ContactForce& contact) {
  return {contact.patch, {contact.xi[0], contact.xi[1]}};
}

/// Control points of these elements and of those around each in its patch: a foot may wander a little beyond.
std::vector<int> control_points_around(const std::vector<int>& elements, const nurbs::MultiPatch& surface) {
  std::vector<bool> taken(surface.control_point_count(), false);
  std::vector<bool> seen(surface.element_count(), false);
  std::vector<int> points;
  for (const int element : elements) {
    if (seen[element]) continue;
    seen[element] = true;
    const int p = surface.patch_of_element(element);
    const nurbs::Space<2>& patch = surface.patch(p);
    const auto at = patch.element_indices(element - surface.first_element(p));
    int first[2], end[2];
    for (int d = 0; d < 2; ++d) {
      const nurbs::KnotVector& knots = patch.knots(d);
      first[d] = knots.span_of_element(std::max(at[d] - 1, 0)) - knots.degree();
      end[d] = knots.span_of_element(std::min(at[d] + 1, knots.element_count() - 1)) + 1;
    }
    for (int j = first[1]; j < end[1]; ++j)
      for (int i = first[0]; i < end[0]; ++i) {
        const int point = surface.first_control_point(p) + i + patch.control_point_count(0) * j;
        if (!taken[point]) points.push_back(point);
        taken[point] = true;
      }
  }
  std::sort(points.begin(), points.end());
  return points;
}

}  // namespace

SurfaceExchange::SurfaceExchange(MPI_Comm comm, StructureSolver& solver)
    : comm_(comm),
      solver_(solver),
      map_(solver.is_in_parts() ? solver.surface().map.on(solver.nodes(), solver.owned_node_count())
                                : solver.surface().map.on(solver.nodes())) {
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  all_counts_.resize(ranks);
  counts_.resize(ranks);
  offset_.resize(ranks);
  const int control_points = static_cast<int>(solver.surface().map.control_point_count());
  for (int c = 0; c < control_points; ++c)
    if (map_.hangs(c)) own_.push_back(c);
  if (solver.is_in_parts()) {
    owners_ = std::make_unique<SurfaceOwners>(comm_, own_, control_points);
    to_rank_.resize(ranks);
  }
  followed_.resize(control_points);
  std::iota(followed_.begin(), followed_.end(), 0);
  if (owners_) owners_->want(followed_);
  brought_ = own_;
  surface_forces_.setZero(3, control_points);
  nodal_forces_.values.setZero(3, map_.node_count());
  is_touched_.resize(control_points, false);
  stiffness_.resize(control_points, 0.0);
  positions_.setZero(3, control_points);
  velocities_.setZero(3, control_points);
  find_links();
  import_masses();
  import_surface();
}

void SurfaceExchange::find_links() {
  const LocalCompliance* const compliance = solver_.local_compliance();
  const std::vector<LocalCompliance::Link> links =
      compliance ? compliance->links() : std::vector<LocalCompliance::Link>();
  if (!links.empty()) shift_ = std::make_unique<CrossShift>(solver_.surface().map, links);
  const std::vector<LocalCompliance::Share> shares =
      compliance ? compliance->shares() : std::vector<LocalCompliance::Share>();
  if (!shares.empty()) spread_ = std::make_unique<NetSpread>(NetShares(solver_.surface().map, shares));
  const std::vector<LocalCompliance::Share> seams =
      compliance ? compliance->seams() : std::vector<LocalCompliance::Share>();
  if (!seams.empty()) seams_ = std::make_unique<Seams>(NetShares(solver_.surface().map, seams));
  if (seams_) followed_on_seams_ = on_seams_ = seams_->among(followed_);
  std::vector<LocalCompliance::Share> kinks;
  for (const NodeId node : compliance ? compliance->kinks() : std::vector<NodeId>())
    kinks.push_back({node, node, 1.0});
  if (!kinks.empty()) kinks_ = std::make_unique<NetShares>(solver_.surface().map, kinks);
}

void SurfaceExchange::import_masses() {
  const NodalVectors of_nodes = solver_.inverse_node_mass();
  const bool known =
      of_nodes.cols() == map_.node_count() && of_nodes.cols() > 0 && solver_.surface().map.is_selection();
  if (owners_ ? owners_->largest(known ? 1.0 : 0.0) == 0.0 : !known) return;
  inverse_masses_.setZero(3, positions_.cols());
  map_.to_surface(own_, of_nodes, inverse_masses_);
  if (owners_) owners_->bring_all(inverse_masses_, velocities_);  // which come anew
}

double SurfaceExchange::inverse_mass_at(const nurbs::SurfacePoint& at, const Vector3& n) const {
  const FootBasis foot(solver_.surface().topology, at);
  return seams_ ? seams_->sum_of_squares(foot, n, inverse_masses_) : foot.sum_of_squares(n, inverse_masses_);
}

bool SurfaceExchange::is_at_seam(const nurbs::SurfacePoint& foot) const {
  return seams_ && seams_->shares().has_any(FootBasis(solver_.surface().topology, foot));
}

bool SurfaceExchange::is_at_kink(const nurbs::SurfacePoint& foot) const {
  return kinks_ && kinks_->has_any(FootBasis(solver_.surface().topology, foot));
}

void SurfaceExchange::import_own(const std::vector<int>& control_points) {
  map_.to_surface(control_points, solver_.positions(), positions_);
  map_.to_surface(control_points, solver_.velocities(), velocities_);
  if (!shift_) return;
  for (const int c : control_points) positions_.col(c) += shift_->at(c);
}

void SurfaceExchange::straighten(const std::vector<int>& control_points) {
  for (NodalVectors* const of_surface : {&positions_, &velocities_})
    seams_->straighten(control_points, *of_surface);
}

void SurfaceExchange::import_surface() {
  import_own(own_);
  if (owners_) owners_->bring_all(positions_, velocities_);
  if (seams_) straighten(on_seams_);
  if (!shift_ && !seams_) return;
  body_positions_.resizeLike(positions_);
  map_.to_surface(own_, solver_.positions(), body_positions_);
  if (!owners_) return;
  NodalVectors of_body = velocities_;  // to come along, in vain
  owners_->bring_all(body_positions_, of_body);
}

void SurfaceExchange::import_followed() {
  import_own(brought_);
  if (owners_) owners_->bring_wanted(positions_, velocities_);
  if (seams_) straighten(followed_on_seams_);
}

void SurfaceExchange::follow(const std::vector<int>& elements) {
  followed_ = control_points_around(elements, solver_.surface().topology);
  const auto follow_shares = [this](const NetShares& shares) {
    follow_also([&](int c, auto take) { shares.for_each(c, [&](int to, double) { take(to); }); });
  };
  if (spread_) follow_shares(spread_->shares());
  if (seams_) {
    followed_on_seams_ = seams_->among(followed_);
    follow_shares(seams_->shares());
  }
  // Forces on an element are wanted by the owners of what it is linked to, who may be beyond a weld.
  if (owners_ && shift_) follow_also([this](int c, auto take) { shift_->for_each_linked(c, take); });
  brought_.clear();
  std::copy_if(followed_.begin(), followed_.end(), std::back_inserter(brought_),
               [this](int c) { return map_.hangs(c); });
  if (owners_) {
    owners_->want(followed_);
    const std::vector<int> own = std::move(brought_), lent = owners_->wanted_by_others();
    brought_.clear();
    std::set_union(own.begin(), own.end(), lent.begin(), lent.end(), std::back_inserter(brought_));
  }
  own_places_.resize(3, static_cast<Eigen::Index>(own_.size()));
  for (std::size_t k = 0; k < own_.size(); ++k) own_places_.col(k) = map_.at(own_[k], solver_.positions());
}

/// for_each_beside(control point, take): takes those beside one that is followed.
template <class ForEach>
void SurfaceExchange::follow_also(ForEach for_each_beside) {
  std::vector<int> all = followed_;
  for (const int c : followed_) for_each_beside(c, [&](int other) { all.push_back(other); });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  followed_ = std::move(all);
}

double SurfaceExchange::largest_motion() const {
  NURBS_ASSERT(own_places_.cols() == static_cast<Eigen::Index>(own_.size()), own_places_.cols());
  const NodalVectors& positions = solver_.positions();
  double largest = 0.0;
  for (std::size_t k = 0; k < own_.size(); ++k) {
    const double motion = (map_.at(own_[k], positions) - own_places_.col(k)).squaredNorm();
    if (motion <= largest) continue;
    largest = motion;
    if (std::isnan(motion)) break;
  }
  return std::sqrt(owners_ ? owners_->largest(largest) : largest);
}

bool SurfaceExchange::any(bool here) const {
  return owners_ ? owners_->largest(here ? 1.0 : 0.0) > 0.0 : here;
}

std::vector<double> SurfaceExchange::all(const std::vector<double>& here) const {
  if (!owners_) return here;
  int ranks;
  MPI_Comm_size(comm_, &ranks);
  std::vector<int> counts(ranks), begin(ranks);
  const int count = static_cast<int>(here.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  std::exclusive_scan(counts.begin(), counts.end(), begin.begin(), 0);
  std::vector<double> all(begin.back() + counts.back());
  MPI_Allgatherv(here.data(), count, MPI_DOUBLE, all.data(), counts.data(), begin.data(), MPI_DOUBLE, comm_);
  return all;
}

void SurfaceExchange::touch(int control_point) {
  if (!is_touched_[control_point]) touched_.push_back(control_point);
  is_touched_[control_point] = true;
}

template <class Basis>
void SurfaceExchange::touch(const Basis& foot) {
  foot.for_each_control_point([&](int c) { touch(c); });
}

void SurfaceExchange::expect_to_stay() const {
  constexpr double kMost = 0.8;
  for (const int c : touched_) {
    const double feedback = shift_->feedback(c, stiffness_[c]);
    if (!(feedback > kMost)) continue;
    const Vector3 x = positions_.col(c);
    throw FailedOnThisRank(fmt::format(
        "contacts at ({:.6g}, {:.6g}, {:.6g}) are too many on an element for 'compliance corrected', or too "
        "stiff: what they feel of each other would grow by itself ({:.2g}, expected at most {:.2g}); use "
        "smaller "
        "elements there, or 'compliance none'",
        x[0], x[1], x[2], feedback, kMost));
  }
}

void SurfaceExchange::spread(const ContactForce& contact) {
  const ContactSurface& surface = solver_.surface();
  const Vector3 F = Vector3::Map(contact.F);
  if (surface.faces) {
    const Vector3 foot = brep::point_on(*surface.faces, contact.patch, {contact.xi[0], contact.xi[1]});
    const BoxBasis box(*surface.faces, foot);
    box.distribute(F, surface_forces_);
    return touch(box);
  }
  if (contact.has_couple) {
    const FootSlopes foot = {surface.topology, foot_of(contact)};
    foot.distribute(F, nurbs::Tangents::Map(contact.couple[0]), surface_forces_);
    if (contact.is_spread)
      spread_->distribute(foot.slopes().values, Vector3::Map(contact.spread), surface_forces_,
                          [this](int c) { touch(c); });
    stiffness_[foot.first_control_point()] += contact.stiffness;
    return touch(foot);
  }
  const FootBasis foot = {surface.topology, foot_of(contact)};
  foot.distribute(F, surface_forces_);
  stiffness_[foot.first_control_point()] += contact.stiffness;
  touch(foot);
}

const NodalForces& SurfaceExchange::export_add(const std::vector<ContactForce>& local, bool is_setup) {
  forget_forces();
  contacts_.clear();
  if (owners_)
    send_to_owners(local);
  else
    gather(local);
  std::sort(contacts_.begin(), contacts_.end(), [](const ContactForce& a, const ContactForce& b) {
    return std::tie(a.tag, a.branch) < std::tie(b.tag, b.branch);
  });
  for (const ContactForce& contact : contacts_) {
    NURBS_ASSERT(Vector3::Map(contact.F).allFinite(), contact.tag, contact.F[0], contact.F[1], contact.F[2]);
    spread(contact);
  }
  std::sort(touched_.begin(), touched_.end());
  if (seams_) {
    seams_->carry(touched_, surface_forces_, [this](int c) { touch(c); });
    std::sort(touched_.begin(), touched_.end());
  }
  map_.nodes_of(touched_, nodal_forces_.touched);
  map_.add_to_nodes(touched_, surface_forces_, nodal_forces_.values);
  if (shift_) expect_to_stay();
  if (shift_ && !is_setup) shift_->remember(touched_, surface_forces_);
  return nodal_forces_;
}

std::vector<double> SurfaceExchange::save() const {
  if (!shift_) return {};
  std::vector<double> state = shift_->save(own_);
  return owners_ ? owners_->sum(state) : state;
}

void SurfaceExchange::load(const std::vector<double>& state) {
  if (shift_)
    shift_->load(state);
  else if (!state.empty())
    fail_as_damaged();
}

void SurfaceExchange::forget_forces() {
  for (const Eigen::Index A : nodal_forces_.touched) nodal_forces_.values.col(A).setZero();
  for (const int c : touched_) {
    surface_forces_.col(c).setZero();
    is_touched_[c] = false;
    stiffness_[c] = 0.0;
  }
  touched_.clear();
}

void SurfaceExchange::send_to_owners(const std::vector<ContactForce>& local) {
  for (std::vector<ContactForce>& contacts : to_rank_) contacts.clear();
  int me = 0;
  MPI_Comm_rank(comm_, &me);
  for (const ContactForce& contact : local) {
    std::vector<int>& owners = owners_of_contact_;
    owners.clear();
    const auto take = [&](int c) {
      const int owner = owners_->owner(c);
      if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
    };
    const auto take_with_linked = [&](int c) {
      take(c);
      if (shift_) shift_->for_each_linked(c, take);
    };
    const auto take_all = [&](int c) {
      take_with_linked(c);
      if (seams_) seams_->shares().for_each(c, [&](int to, double) { take_with_linked(to); });
    };
    FootBasis(solver_.surface().topology, foot_of(contact)).for_each_control_point([&](int c) {
      take_all(c);
      if (contact.is_spread) spread_->shares().for_each(c, [&](int to, double) { take_all(to); });
    });
    for (const int owner : owners) (owner == me ? contacts_ : to_rank_[owner]).push_back(contact);
  }
  owners_->exchange(to_rank_, contacts_);
}

void SurfaceExchange::gather(const std::vector<ContactForce>& local) {
  const std::size_t ranks = counts_.size();
  if (ranks == 1) {
    contacts_ = local;
    return;
  }
  const std::int64_t mine = static_cast<std::int64_t>(local.size());
  MPI_Allgather(&mine, 1, MPI_INT64_T, all_counts_.data(), 1, MPI_INT64_T, comm_);
  const std::int64_t total = std::accumulate(all_counts_.begin(), all_counts_.end(), std::int64_t(0));
  expect_int(total);
  contacts_.resize(total);
  if (total == 0) return;
  std::copy(all_counts_.begin(), all_counts_.end(), counts_.begin());
  std::partial_sum(counts_.begin(), counts_.end() - 1, offset_.begin() + 1);
  MPI_Datatype contact;  // counted as one, so that int reaches far; made here, as MPI may end before we do
  MPI_Type_contiguous(sizeof(ContactForce), MPI_BYTE, &contact);
  MPI_Type_commit(&contact);
  MPI_Allgatherv(local.data(), static_cast<int>(mine), contact, contacts_.data(), counts_.data(),
                 offset_.data(), contact, comm_);
  MPI_Type_free(&contact);
}

}  // namespace coupling

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/plugin/plugin_structure.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "coupling/plugin/opaque_bytes.h"
#include "parallel/all_or_none.h"

namespace coupling {

namespace {

std::vector<SurfaceMaterial> materials_of(const StructurePluginDescription& is) {
  if (is.youngs_modulus == 0.0) return {};
  return {{is.youngs_modulus, is.poissons_ratio}};
}

}  // namespace

PluginStructure::PluginStructure(MPI_Comm comm, std::unique_ptr<PluginBody> body,
                                 const StructurePluginDescription& description, PluginSkin skin,
                                 std::string surface)
    : comm_(comm),
      body_(std::move(body)),
      skin_(std::move(skin)),
      in_parts_(description.in_parts != 0),
      surface_name_(std::move(surface)),
      identity_(description.identity ? description.identity : ""),
      materials_(materials_of(description)),
      x_(NodalVectors::Zero(3, static_cast<Eigen::Index>(skin_.own.size()))),
      v_(x_),
      F_(x_),
      no_forces_(x_) {
  parallel::on_every_rank(comm_, body_->name(), [this] { return take_motion("open"), true; });
  const NodalVectors all = of_all_nodes(x_);
  surface_ = surface_at(skin_, all);
  NodalVectors control_points;
  skin_.map.to_surface(all, control_points);
  geometry_ = geometry_part(skin_.patches, digest(control_points));
}

NodalVectors PluginStructure::of_all_nodes(const NodalVectors& own) const {
  NodalVectors all = NodalVectors::Zero(3, skin_.map.node_count());
  Eigen::VectorXi owners = Eigen::VectorXi::Zero(all.cols());
  for (std::size_t i = 0; i < skin_.own.size(); ++i) {
    all.col(skin_.own[i]) = own.col(static_cast<Eigen::Index>(i));
    owners[skin_.own[i]] = 1;
  }
  if (!in_parts_) return all;
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, comm_);
  MPI_Allreduce(MPI_IN_PLACE, owners.data(), static_cast<int>(owners.size()), MPI_INT, MPI_SUM, comm_);
  for (Eigen::Index node = 0; node < owners.size(); ++node)
    if (owners[node] != 1)
      throw std::invalid_argument(
          fmt::format("{}: node {} is owned by {} ranks, expected one", body_->name(), node, owners[node]));
  return all;
}

void PluginStructure::take_motion(const char* after) {
  body_->call("motion", body_->functions().motion, x_.data(), v_.data());
  if (x_.allFinite() && v_.allFinite()) return;
  for (Eigen::Index i = 0; i < x_.cols(); ++i)
    if (!x_.col(i).allFinite() || !v_.col(i).allFinite())
      body_->fail("motion", fmt::format("gives a place or velocity of node {} that is not finite, after {}",
                                        skin_.own[i], after));
}

double PluginStructure::work_of_half_kick(const NodalVectors& before) const {
  double power = 0.0;
  for (const Eigen::Index A : touched_) power += F_.col(A).dot(before.col(A) + v_.col(A));
  return 0.25 * dt_ / count_ * power;
}

void PluginStructure::initialise_forces(const NodalForces& forces) {
  count_of_forces_ = count_;
  F_ = count_ * forces.values;
  touched_ = forces.touched;
  body_->call("initialise", body_->functions().initialise, F_.data());
  take_motion("initialise");
  const StructurePluginTotals now = totals();
  kinetic_start_ = now.kinetic_energy;
  strain_start_ = now.strain_energy;
  contact_work_ = 0.0;
}

void PluginStructure::begin_step() {
  const StructurePlugin& functions = body_->functions();
  if (count_ != count_of_forces_)
    throw std::invalid_argument(
        fmt::format("the timestep is {:.6g} now, in which the structure takes {} steps in place of {}, with "
                    "forces that are meant for {}: expected such a change between two runs alone, or "
                    "'substeps structure {}'",
                    dt_, count_, count_of_forces_, count_of_forces_, std::max(count_, count_of_forces_)));
  if (count_ == 1 && skin_.inverse_mass.cols() > 0) stable_ = stable_time_step();
  is_within_step_ = true;
  x_before_ = x_;
  v_before_ = v_;
  body_->call("begin_step", functions.begin_step);
  take_motion("begin_step");
  contact_work_ += work_of_half_kick(v_before_);
  if (count_ == 1) return;
  for (int i = 1; i < count_; ++i) {
    body_->call("end_step", functions.end_step, no_forces_.data());
    body_->call("begin_step", functions.begin_step);
  }
  take_motion("begin_step");
  v_mean_ = (x_ - x_before_) / dt_;
}

void PluginStructure::end_step(const NodalForces& forces) {
  is_within_step_ = false;
  F_ = count_ * forces.values;
  touched_ = forces.touched;
  v_before_ = v_;
  body_->call("end_step", body_->functions().end_step, F_.data());
  take_motion("end_step");
  contact_work_ += work_of_half_kick(v_before_);
}

double PluginStructure::stable_time_step() const {
  double stable = 0.0;
  body_->call("stable_step", body_->functions().stable_step, &stable);
  if (!(stable > 0.0)) body_->fail("stable_step", fmt::format("gives {}, expected a time > 0", stable));
  if (in_parts_) MPI_Allreduce(MPI_IN_PLACE, &stable, 1, MPI_DOUBLE, MPI_MIN, comm_);
  return stable;
}

double PluginStructure::stable_time_step_with_contacts() const {
  return count_ == 1 ? stable_ : StructureSolver::stable_time_step_with_contacts();
}

bool PluginStructure::take_substeps(const SubstepOptions& options) {
  if (options.fast == SubstepOptions::Fast::particles)
    throw std::invalid_argument(
        "'substeps particles' are not for a plug-in, expected 'substeps structure N|auto'");
  has_substeps_ = true;
  wanted_count_ = options.count;
  return true;
}

void PluginStructure::set_time_step(double dt) {
  stable_ = stable_time_step();
  const double needed = std::ceil(dt / stable_ * (1.0 - 1e-12));
  if (!(needed <= kMostSubsteps) || needed > (has_substeps_ ? wanted_count_.value_or(kMostSubsteps) : 1))
    throw std::invalid_argument(fmt::format(
        "timestep {:.6g} is above the structure's stable step {:.6g}{}; use a timestep of at most {:.3g}, or "
        "'substeps structure auto'",
        dt, stable_, has_substeps_ ? fmt::format(", which asks for {:.0f} steps in it", needed) : "",
        0.9 * stable_));
  count_ = has_substeps_ ? wanted_count_.value_or(std::max(1, static_cast<int>(needed))) : 1;
  dt_ = dt;
  body_->call("set_time_step", body_->functions().set_time_step, dt / count_);
}

std::string PluginStructure::describe_step() const {
  if (!has_substeps_) return "";
  return fmt::format("substeps structure {}: the structure takes {} steps of {:.6g} in a particle step",
                     count_, count_, dt_ / count_);
}

StructurePluginTotals PluginStructure::totals() const {
  StructurePluginTotals totals{};
  totals.size = sizeof(totals);
  body_->call("totals", body_->functions().totals, &totals);
  constexpr int kNumbers =
      (sizeof(totals) - offsetof(StructurePluginTotals, kinetic_energy)) / sizeof(double);
  if (in_parts_) MPI_Allreduce(MPI_IN_PLACE, &totals.kinetic_energy, kNumbers, MPI_DOUBLE, MPI_SUM, comm_);
  return totals;
}

Work PluginStructure::work() const {
  const StructurePluginTotals now = totals();
  Work work;
  work.contacts = contact_work_;
  if (in_parts_) MPI_Allreduce(MPI_IN_PLACE, &work.contacts, 1, MPI_DOUBLE, MPI_SUM, comm_);
  work.loads = now.load_work;
  work.supports = now.support_work;
  work.damped = now.damped;
  work.internal =
      work.contacts + work.loads + work.supports - work.damped - (now.kinetic_energy - kinetic_start_);
  return work;
}

double PluginStructure::truncation() const { return work().internal - (strain_energy() - strain_start_); }

Vector3 PluginStructure::angular_momentum(const Vector3& about) const {
  const StructurePluginTotals now = totals();
  return Vector3::Map(now.angular_momentum) - about.cross(Vector3::Map(now.linear_momentum));
}

void PluginStructure::set_gravity(const Vector3& g) {
  const double* const gravity = g.data();
  body_->call("set_gravity", body_->functions().set_gravity, gravity);
}

std::vector<double> PluginStructure::save() const {
  const auto save = body_->functions().save;
  std::int64_t size = 0;
  body_->call("save", save, static_cast<void*>(nullptr), &size);
  if (size < 0) body_->fail("save", fmt::format("gives a size of {}", size));
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size) + 1);  // never a null pointer
  body_->call("save", save, static_cast<void*>(bytes.data()), &size);
  bytes.resize(size);
  std::int64_t all = size;
  MPI_Bcast(&all, 1, MPI_INT64_T, 0, comm_);
  std::vector<double> numbers = numbers_from(bytes);
  numbers.resize(1 + (all + kBytesPerNumber - 1) / kBytesPerNumber);
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, comm_);
  return numbers;
}

void PluginStructure::load(const std::vector<double>& state) {
  const std::vector<unsigned char> bytes = bytes_from(state);
  body_->call("load", body_->functions().load, static_cast<const void*>(bytes.data()),
              static_cast<std::int64_t>(bytes.size()));
  take_motion("load");
}

Fingerprint PluginStructure::fingerprint() const {
  const char* const name = body_->functions().name;
  Fingerprint fingerprint{geometry_, word_part("surface", surface_name_),
                          word_part("plug-in", name ? name : "")};
  if (!identity_.empty()) fingerprint.push_back(word_part("body of the plug-in", identity_));
  return fingerprint;
}

}  // namespace coupling

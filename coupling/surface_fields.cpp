// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/surface_fields.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "nurbs/assert.h"
#include "nurbs/coincident.h"
#include "nurbs/control_area.h"

namespace coupling {

namespace {

// Which control points on rims stand at the same place; all others keep to themselves.
std::vector<int> shared_control_points(const nurbs::MultiPatch& surface, const NodalVectors& points) {
  std::vector<int> rim, shared(points.cols());
  std::iota(shared.begin(), shared.end(), 0);
  for (int p = 0; p < surface.patch_count(); ++p) {
    const int n = surface.patch(p).control_point_count(0), m = surface.patch(p).control_point_count(1);
    for (int a = 0; a < n * m; ++a)
      if (nurbs::on_rim(a, n, m)) rim.push_back(surface.first_control_point(p) + a);
  }
  const std::vector<int> lowest = nurbs::first_coincident(points(Eigen::all, rim));
  for (std::size_t r = 0; r < rim.size(); ++r) shared[rim[r]] = rim[lowest[r]];
  return shared;
}

}  // namespace

SurfaceFields::SurfaceFields(MPI_Comm comm, const nurbs::MultiPatch& surface,
                             const NodalVectors& control_points)
    : comm_(comm),
      surface_(surface),
      shared_(shared_control_points(surface, control_points)),
      forces_(Eigen::MatrixXd::Zero(kRows, surface.control_point_count())),
      contacts_(Eigen::MatrixXd::Zero(1, surface.element_count())),
      is_loaded_(surface.control_point_count(), false) {}

void SurfaceFields::note_load(int control_point) {
  if (!is_loaded_[control_point]) loaded_.push_back(control_point);
  is_loaded_[control_point] = true;
}

void SurfaceFields::add(const SurfaceContact& contact) {
  const nurbs::SurfacePoint& foot = contact.foot;
  NURBS_ASSERT(std::abs(contact.normal.squaredNorm() - 1.0) < 1e-6, contact.normal.norm());
  const double normal_force = contact.force.dot(contact.normal);
  Eigen::Matrix<double, kRows, 1> q;
  q << -normal_force, contact.force - normal_force * contact.normal, contact.worn_volume;

  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(surface_, foot, 0, basis);
  for (int a = 0; a < basis.count; ++a) {
    forces_.col(basis.control_point[a]) += basis.R[a] * q;
    note_load(basis.control_point[a]);
  }
  const int element = surface_.first_element(foot.patch) + surface_.patch(foot.patch).element_at(foot.xi);
  if (contacts_(element) == 0.0) counted_.push_back(element);
  contacts_(element) += 1.0;
}

Eigen::MatrixXd SurfaceFields::sum_over_ranks(const Eigen::MatrixXd& local) const {
  Eigen::MatrixXd sum = local;
  constexpr Eigen::Index kPiece = 1 << 30;  // MPI counts in int
  for (Eigen::Index first = 0; first < local.size(); first += kPiece)
    MPI_Reduce(local.data() + first, sum.data() + first,
               static_cast<int>(std::min(kPiece, local.size() - first)), MPI_DOUBLE, MPI_SUM, 0, comm_);
  return sum;
}

void SurfaceFields::measure(const NodalVectors& control_points) {
  if (measured_.cols() == control_points.cols() && measured_ == control_points) return;
  NURBS_ASSERT(control_points.cols() == surface_.control_point_count(), control_points.cols());
  measured_ = control_points;
  area_.setZero(control_points.cols());
  for (int p = 0; p < surface_.patch_count(); ++p) {
    const Eigen::VectorXd own =
        nurbs::control_point_areas(surface_.patch(p), surface_.control_points_of(p, control_points));
    for (int a = 0; a < own.size(); ++a) area_[shared_[surface_.first_control_point(p) + a]] += own[a];
  }
}

Eigen::MatrixXd SurfaceFields::per_area(const Eigen::MatrixXd& sums) const {
  Eigen::MatrixXd here = Eigen::MatrixXd::Zero(kRows, sums.cols());  // of each place
  for (int A = 0; A < sums.cols(); ++A) here.col(shared_[A]) += sums.col(A);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(kRows, sums.cols());
  for (int A = 0; A < sums.cols(); ++A)
    if (area_[shared_[A]] > 0.0) result.col(A) = here.col(shared_[A]) / area_[shared_[A]];
  return result;
}

std::vector<vtk::PatchFields<2>> SurfaceFields::fields(const NodalVectors& control_points,
                                                       const RigidFrame& frame, const Selection& selection) {
  measure(control_points);
  const double mean = samples_ > 0.0 ? 1.0 / samples_ : 0.0;
  const Eigen::MatrixXd values = per_area(sum_over_ranks(forces_));
  const Eigen::MatrixXd count = mean * sum_over_ranks(contacts_);
  const NodalVectors in_space = (frame.rotation * control_points).colwise() + frame.origin;

  std::vector<vtk::PatchFields<2>> result;
  for (nurbs::Surface& patch : nurbs::split(surface_, in_space)) {
    const int p = static_cast<int>(result.size());
    const auto here = values.middleCols(surface_.first_control_point(p), patch.space.control_point_count());
    const auto elements = count.middleCols(surface_.first_element(p), patch.space.element_count());
    vtk::PatchFields<2> fields{std::move(patch), {}, {}};
    if (selection.pressure) fields.control_points.push_back({"pressure", mean * here.row(kNormal)});
    if (selection.shear)
      fields.control_points.push_back({"shear", mean * frame.rotation * here.middleRows(kShear, 3)});
    if (selection.wear) fields.control_points.push_back({"wear", here.row(kWear)});
    if (selection.contact_count) fields.elements.push_back({"contact_count", elements});
    result.push_back(std::move(fields));
  }
  return result;
}

void SurfaceFields::begin_interval() {
  samples_ = 0.0;
  for (const int c : loaded_) {
    forces_.col(c).head<kWear>().setZero();
    is_loaded_[c] = false;
  }
  loaded_.clear();
  for (const int element : counted_) contacts_(element) = 0.0;
  counted_.clear();
}

std::vector<double> SurfaceFields::save() const {
  const Eigen::MatrixXd forces = sum_over_ranks(forces_), contacts = sum_over_ranks(contacts_);
  std::vector<double> state{samples_};
  state.insert(state.end(), forces.data(), forces.data() + forces.size());
  state.insert(state.end(), contacts.data(), contacts.data() + contacts.size());
  return state;
}

void SurfaceFields::load(const std::vector<double>& state) {
  if (state.size() != state_size())
    throw std::invalid_argument("the restart file holds " + std::to_string(state.size()) +
                                " numbers of surface fields, expected " + std::to_string(state_size()) +
                                " for this geometry");
  samples_ = state[0];
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  const double share = rank == 0 ? 1.0 : 0.0;  // the sums of all ranks stand on one
  const double* next = state.data() + 1;
  forces_ = share * Eigen::Map<const Eigen::MatrixXd>(next, kRows, forces_.cols());
  contacts_ = share * Eigen::Map<const Eigen::MatrixXd>(next + forces_.size(), 1, contacts_.cols());
  for (int c = 0; c < forces_.cols(); ++c) note_load(c);
  counted_.resize(contacts_.cols());
  std::iota(counted_.begin(), counted_.end(), 0);
}

}  // namespace coupling

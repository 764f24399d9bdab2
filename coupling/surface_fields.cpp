// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/surface_fields.h"

#include <numeric>

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
    : ContactFields(comm, surface.control_point_count(), surface.element_count()),
      surface_(surface),
      shared_(shared_control_points(surface, control_points)) {}

void SurfaceFields::add(const SurfaceContact& contact) {
  const nurbs::SurfacePoint& foot = contact.foot;
  const Eigen::Matrix<double, kRows, 1> rows = rows_of(contact);
  nurbs::RationalBasis<2> basis;
  nurbs::evaluate(surface_, foot, 0, basis);
  for (int a = 0; a < basis.count; ++a) add_at(basis.control_point[a], basis.R[a] * rows);
  count_in(surface_.first_element(foot.patch) + surface_.patch(foot.patch).element_at(foot.xi));
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
  const Eigen::MatrixXd values = per_area(all_forces()), count = all_contacts();
  const NodalVectors in_space = frame.all_to_space(control_points);

  std::vector<vtk::PatchFields<2>> result;
  for (nurbs::Surface& patch : nurbs::split(surface_, in_space)) {
    const int p = static_cast<int>(result.size());
    const auto here = values.middleCols(surface_.first_control_point(p), patch.space.control_point_count());
    const auto elements = count.middleCols(surface_.first_element(p), patch.space.element_count());
    result.push_back(
        {std::move(patch), fields_of_places(here, frame, selection), fields_of_cells(elements, selection)});
  }
  return result;
}

}  // namespace coupling

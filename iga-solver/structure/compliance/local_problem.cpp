// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/local_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace structure {

namespace {

/// Integrals of dR_A/dX_d dR_B/dX_e over an element, d <= e: in the order 00, 01, 02, 11, 12, 22.
std::array<Eigen::MatrixXd, 6> gradient_products(const ElementTables& tables, int functions) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Table = Eigen::Map<const Rows, 0, Eigen::OuterStride<>>;
  Eigen::MatrixXd G[3], weighted[3];
  for (int d = 0; d < 3; ++d) {
    G[d] = Table(tables.dR_dX.data() + d * tables.padded, tables.points, functions,
                 Eigen::OuterStride<>(3 * tables.padded));
    weighted[d] = Eigen::VectorXd::Map(tables.wJ.data(), tables.points).asDiagonal() * G[d];
  }
  std::array<Eigen::MatrixXd, 6> products;
  for (int d = 0, k = 0; d < 3; ++d)
    for (int e = d; e < 3; ++e) products[k++].noalias() = weighted[d].transpose() * G[e];
  return products;
}

}  // namespace

LocalProblem::LocalProblem(const LocalPatch& patch) : patch_(patch), held_(patch.body()) {
  const Material& law = *patch.body().materials[patch.hit().patch];
  E_ = law.youngs_modulus();
  nu_ = law.poissons_ratio();
  if (3 * patch.free_count() > kMostUnknowns)
    throw std::invalid_argument(fmt::format(
        "the {} elements that take part have {} unknowns, expected at most {}: elements are too flat",
        patch.elements().size(), 3 * patch.free_count(), kMostUnknowns));
  assemble();
  if (patch.free_count() == static_cast<int>(patch.nodes().size())) hold_by_springs();
  for (std::size_t place = patch.free_count(); place < patch.nodes().size(); ++place)
    held_.add(patch.nodes()[place]);
  factor_.compute(K_.leftCols(3 * patch.free_count()));
  if (factor_.info() != Eigen::Success)
    throw std::invalid_argument("the stiffness of the elements that take part is not positive definite");
}

void LocalProblem::assemble() {
  const ReferenceBody& body = patch_.body();
  K_ = Eigen::MatrixXd::Zero(3 * patch_.free_count(), 3 * static_cast<Eigen::Index>(patch_.nodes().size()));
  ElementTables tables;
  std::vector<int> control_points;
  for (std::size_t next = 0; next < patch_.elements().size();) {
    const int p = patch_.elements()[next].patch;
    const nurbs::Volume& volume = body.patches[p];
    const ElementTabulator tabulate(volume.space, body.quadrature);
    control_points.resize(volume.space.functions_per_element());
    for (; next < patch_.elements().size() && patch_.elements()[next].patch == p; ++next) {
      const int element = patch_.elements()[next].element;
      volume.space.element_control_points(element, control_points.data());
      tabulate(element, {volume.control_points, control_points}, tables);
      add(tables, patch_.places_of(patch_.elements()[next]));
    }
  }
}

// K_AB = integral of lambda dR_A (x) dR_B + mu (dR_B (x) dR_A + dR_A . dR_B I)
void LocalProblem::add(const ElementTables& tables, const std::vector<int>& places) {
  const double mu = 0.5 * E_ / (1.0 + nu_), lambda = 2.0 * mu * nu_ / (1.0 - 2.0 * nu_);
  const int n = static_cast<int>(places.size());
  const std::array<Eigen::MatrixXd, 6> M = gradient_products(tables, n);
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      if (places[a] >= patch_.free_count()) continue;
      const double D[3][3] = {{M[0](a, b), M[1](a, b), M[2](a, b)},
                              {M[1](b, a), M[3](a, b), M[4](a, b)},
                              {M[2](b, a), M[4](b, a), M[5](a, b)}};
      const double shear = mu * (D[0][0] + D[1][1] + D[2][2]);
      auto K = K_.block<3, 3>(3 * places[a], 3 * places[b]);
      for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) K(i, j) += lambda * D[i][j] + mu * D[j][i];
        K(j, j) += shear;
      }
    }
}

// A whole body is smaller than that.  Springs on its farther half take up its rigid motions; they rest at the
// half-space's displacements, so they bear nothing else.
void LocalProblem::hold_by_springs() {
  constexpr double kFar = 0.5, kStiffness = 0.1;
  const ReferenceBody& body = patch_.body();
  const BodyElement& hit = patch_.hit();
  const nurbs::Volume& volume = body.patches[hit.patch];
  const Vector3 centre =
      nurbs::interpolate(volume.space, volume.control_points, volume.space.element_centre(hit.element));
  std::vector<double> distance;
  for (const Id node : patch_.nodes()) {
    const auto [p, control_point] = body.nodes.place(node);
    distance.push_back((body.patches[p].control_points.col(control_point) - centre).norm());
  }
  const double farthest = *std::max_element(distance.begin(), distance.end());
  for (std::size_t place = 0; place < distance.size(); ++place)
    if (distance[place] >= kFar * farthest) {
      held_.add(patch_.nodes()[place]);
      sprung_.push_back(static_cast<int>(place));
    }
  spring_ = kStiffness * E_ * farthest / static_cast<double>(sprung_.size());
  for (const int place : sprung_)
    K_.diagonal().segment<3>(3 * static_cast<Eigen::Index>(place)).array() += spring_;
}

/// Control values of the half-spaces' displacements, of what is held.
Eigen::MatrixXd LocalProblem::prescribed(const std::vector<SkinPoint>& feet,
                                         const std::vector<HalfSpace>& half_spaces) const {
  const std::vector<Vector3>& points = held_.points();
  std::vector<Matrix3> at_points(points.size());
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3 * held_.count(), 3 * static_cast<Eigen::Index>(feet.size()));
  for (std::size_t f = 0; f < feet.size(); ++f) {
    for (std::size_t k = 0; k < points.size(); ++k)
      at_points[k] = half_spaces[f].displacement(points[k] - feet[f].point);
    for (int node = 0; node < held_.count(); ++node)
      held_.for_each_term(node, [&](int point, double weight) {
        u.block<3, 3>(3 * node, 3 * static_cast<Eigen::Index>(f)) += weight * at_points[point];
      });
  }
  return u;
}

void LocalProblem::add_tractions(const std::vector<SkinPoint>& feet,
                                 const std::vector<HalfSpace>& half_spaces, Eigen::MatrixXd& forces) const {
  const auto row = [&](Id node) {
    const int place = patch_.place(node);
    return place < patch_.free_count() ? place : -1;
  };
  for (const LocalPatch::FreeFace& face : patch_.free_faces()) {
    const FaceSurface surface(patch_.body(), face.piece);
    for (const int element : face.elements) surface.add_tractions(element, feet, half_spaces, row, forces);
  }
}

std::vector<Matrix3> LocalProblem::compliances(const std::vector<SkinPoint>& feet) const {
  std::vector<HalfSpace> half_spaces;
  for (const SkinPoint& foot : feet) half_spaces.emplace_back(E_, nu_, foot.outward_normal);
  const auto count = static_cast<Eigen::Index>(feet.size());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(3 * patch_.free_count(), 3 * count);
  for (Eigen::Index f = 0; f < count; ++f)
    for (std::size_t a = 0; a < feet[f].R.size(); ++a)
      loads.block<3, 3>(3 * static_cast<Eigen::Index>(patch_.place(feet[f].nodes[a])), 3 * f)
          .diagonal()
          .setConstant(feet[f].R[a]);

  Eigen::MatrixXd forces = loads;
  const Eigen::MatrixXd u_held = prescribed(feet, half_spaces);
  for (std::size_t k = 0; k < sprung_.size(); ++k)
    forces.middleRows<3>(3 * static_cast<Eigen::Index>(sprung_[k])) +=
        spring_ * u_held.middleRows<3>(3 * static_cast<Eigen::Index>(k));
  if (sprung_.empty()) forces.noalias() -= K_.rightCols(u_held.rows()) * u_held;
  add_tractions(feet, half_spaces, forces);

  const Eigen::MatrixXd u = factor_.solve(forces);
  std::vector<Matrix3> c;
  for (Eigen::Index f = 0; f < count; ++f)
    c.push_back(loads.middleCols<3>(3 * f).transpose() * u.middleCols<3>(3 * f));
  return c;
}

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/local_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "structure/material/plate_material.h"
#include "structure/material/plate_shear.h"
#include "structure/solid/plate_patch.h"

namespace structure {

LocalProblem::LocalProblem(const LocalPatch& patch, GradientProducts& gradients)
    : patch_(patch), held_(patch.body()) {
  const Material& law = *patch.body().materials[patch.hit().patch];
  E_ = law.youngs_modulus();
  nu_ = law.poissons_ratio();
  if (3 * patch.free_count() > kMostUnknowns)
    throw std::invalid_argument(fmt::format(
        "the {} elements that take part have {} unknowns, expected at most {}: elements are too flat",
        patch.elements().size(), 3 * patch.free_count(), kMostUnknowns));
  assemble(gradients);
  if (patch.free_count() == static_cast<int>(patch.nodes().size())) hold_by_springs();
  for (std::size_t place = patch.free_count(); place < patch.nodes().size(); ++place)
    held_.add(patch.nodes()[place]);
  if (!K_.factorise())
    throw std::invalid_argument("the stiffness of the elements that take part is not positive definite");
}

void LocalProblem::assemble(GradientProducts& gradients) {
  const int free = patch_.free_count(), held = static_cast<int>(patch_.nodes().size()) - free;
  std::vector<std::vector<int>> places;
  int farthest = 0;  // of two free nodes with an element in common
  for (const BodyElement& element : patch_.elements()) {
    places.push_back(patch_.places_of(element));
    int first = free, last = 0;
    for (const int place : places.back())
      if (place < free) {
        first = std::min(first, place);
        last = std::max(last, place);
      }
    farthest = std::max(farthest, last - first);
  }
  K_.reset(3 * free, 3 * farthest + 2);
  block_.assign(static_cast<std::size_t>(held) * free, -1);
  gradients.begin_patch();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const BodyElement& element = patch_.elements()[i];
    add(element, gradients.of(element), places[i]);
  }
}

namespace {

/// Normal of the plate, if the element is one of those that material/plate_shear.h is for: of the body as it
/// is now.
std::optional<Vector3> plate_normal_at(const ReferenceBody& body, const BodyElement& element) {
  if (!has_plate_shear(*body.materials[element.patch])) return std::nullopt;
  const nurbs::Volume& patch = body.patches[element.patch];
  return layer_normal(patch, thickness_direction(patch.space), patch.space.element_centre(element.element));
}

/// Integral of gamma_Ai . gamma_Bj, shear strain across a plate by displacements of A along e_i and of B
/// along e_j: gamma = T ((dR.n) I + dR n^T), T = I - n n^T.
Matrix3 shear_products(const Matrix3& D, const Vector3& n) {
  const Matrix3 T = Matrix3::Identity() - n * n.transpose();
  const double across = n.dot(D * n);
  return across * T + T * D.transpose() * n * n.transpose() + n * (T * D * n).transpose() +
         (D.trace() - across) * n * n.transpose();
}

}  // namespace

// K_AB = integral of lambda dR_A (x) dR_B + mu (dR_B (x) dR_A + dR_A . dR_B I), in plates less a part of the
// shear across them
void LocalProblem::add(const BodyElement& element, const Eigen::MatrixXd& products,
                       const std::vector<int>& places) {
  const double mu = 0.5 * E_ / (1.0 + nu_), lambda = 2.0 * mu * nu_ / (1.0 - 2.0 * nu_);
  const std::optional<Vector3> normal = plate_normal_at(patch_.body(), element);
  const int n = static_cast<int>(places.size()), free = patch_.free_count();
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      if (places[a] >= free || (places[b] < free && places[b] > places[a])) continue;
      Matrix3 D, K;  // D(i, j): integral of dR_A/dX_i dR_B/dX_j
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) D(i, j) = products(i * n + a, j * n + b);
      K = lambda * D + mu * D.transpose();
      K.diagonal().array() += mu * D.trace();
      if (normal) K -= (1.0 - plate_shear_factor(nu_)) * mu * shear_products(D, *normal);
      if (places[b] >= free)
        block(places[a], places[b]) += K;
      else
        for (int j = 0; j < 3; ++j)
          for (int i = places[a] == places[b] ? j : 0; i < 3; ++i)
            K_.at(3 * places[a] + i, 3 * places[b] + j) += K(i, j);
    }
}

/// Of a free node and one that is held.
Matrix3& LocalProblem::block(int free_place, int held_place) {
  const int free = patch_.free_count();
  int& block = block_[static_cast<std::size_t>(held_place - free) * free + free_place];
  if (block < 0) {
    block = static_cast<int>(blocks_.size());
    blocks_.push_back(Matrix3::Zero());
  }
  return blocks_[block];
}

namespace {

/// From an element's centre to its farthest corner [length].
double half_diagonal(const nurbs::Volume& volume, int element) {
  const nurbs::Space<3>& space = volume.space;
  const nurbs::Indices<3> at = space.element_indices(element);
  const Vector3 centre = nurbs::interpolate(space, volume.control_points, space.element_centre(element));
  double farthest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    nurbs::Parameter<3> xi;
    for (int d = 0; d < 3; ++d) xi[d] = space.knots(d).breaks()[at[d] + (corner >> d & 1)];
    farthest = std::max(farthest, (nurbs::interpolate(space, volume.control_points, xi) - centre).norm());
  }
  return farthest;
}

}  // namespace

// A whole body is smaller than that.  Springs on its farther half take up its rigid motions; they rest at the
// half-space's displacements, so they bear nothing else.  Near the foot
// these are beyond what a mesh can follow, so nodes there have none.
void LocalProblem::hold_by_springs() {
  constexpr double kFar = 0.5, kNear = 1.01, kStiffness = 0.1;
  constexpr std::size_t kFewest = 4;
  const ReferenceBody& body = patch_.body();
  const BodyElement& hit = patch_.hit();
  const nurbs::Volume& volume = body.patches[hit.patch];
  const Vector3 centre =
      nurbs::interpolate(volume.space, volume.control_points, volume.space.element_centre(hit.element));
  const double near = kNear * half_diagonal(volume, hit.element);
  std::vector<double> distance;
  for (const Id node : patch_.nodes()) distance.push_back((body.place(node) - centre).norm());
  const double farthest = *std::max_element(distance.begin(), distance.end());
  for (std::size_t place = 0; place < distance.size(); ++place)
    if (distance[place] >= kFar * farthest && held_.nearest(patch_.nodes()[place], centre) > near) {
      held_.add(patch_.nodes()[place]);
      sprung_.push_back(static_cast<int>(place));
    }
  if (sprung_.size() < kFewest)
    throw std::invalid_argument(
        fmt::format("a body of {} elements has too few of them beside the one that is hit, expected more",
                    patch_.elements().size()));
  spring_ = kStiffness * E_ * farthest / static_cast<double>(sprung_.size());
  for (const int place : sprung_)
    for (int i = 3 * place; i < 3 * place + 3; ++i) K_.at(i, i) += spring_;
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

namespace {

/// Whether an element is of the face that a foot is on, or goes on from it smoothly.
bool faces_as(const FaceSurface& surface, int element, const SkinPoint& foot) {
  constexpr double kSmooth = 0.7;
  const nurbs::Parameter<2> middle = surface.space().element_centre(element);
  return surface.frame(element, middle).col(2).dot(foot.outward_normal) > kSmooth;
}

}  // namespace

void LocalProblem::add_tractions(const std::vector<SkinPoint>& feet,
                                 const std::vector<HalfSpace>& half_spaces, bool of_touched_face,
                                 Eigen::MatrixXd& forces) const {
  const auto row = [&](Id node) {
    const int place = patch_.place(node);
    return place < patch_.free_count() ? place : -1;
  };
  for (const LocalPatch::FreeFace& face : patch_.free_faces()) {
    const FaceSurface surface(patch_.body(), face.piece);
    for (const int element : face.elements)
      if (of_touched_face || !faces_as(surface, element, feet.front()))
        surface.add_tractions(element, feet, half_spaces, row, forces);
  }
}

/// Forces on the held nodes by displacements of the free ones.
Eigen::MatrixXd LocalProblem::forces_of_held(const Eigen::MatrixXd& u) const {
  const int free = patch_.free_count(), held = static_cast<int>(patch_.nodes().size()) - free;
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3 * held, u.cols());
  for (int h = 0; h < held; ++h)
    for (int a = 0; a < free; ++a)
      if (const int block = block_[static_cast<std::size_t>(h) * free + a]; block >= 0)
        forces.middleRows<3>(3 * h).noalias() += blocks_[block].transpose() * u.middleRows<3>(3 * a);
  return forces;
}

std::vector<int> LocalProblem::places_of(const std::vector<Id>& nodes) const {
  std::vector<int> places;
  for (const Id node : nodes) {
    places.push_back(patch_.place(node));
    if (places.back() >= patch_.free_count())
      throw std::invalid_argument("too few elements take part: others have nodes that the force is on");
  }
  return places;
}

/// Displacements by unit forces on free nodes.
Eigen::MatrixXd LocalProblem::under_unit_forces(const std::vector<int>& places) const {
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(3 * patch_.free_count(), 3 * count);
  for (Eigen::Index a = 0; a < count; ++a) u.block<3, 3>(3 * places[a], 3 * a).setIdentity();
  K_.solve(u);
  return u;
}

/// Displacements of the nodes that u is by unit forces on, by the half-spaces of forces at feet.
Eigen::MatrixXd LocalProblem::by_half_spaces(const Eigen::MatrixXd& u, const std::vector<SkinPoint>& feet,
                                             bool of_touched_face) const {
  std::vector<HalfSpace> half_spaces;
  for (const SkinPoint& foot : feet) half_spaces.emplace_back(E_, nu_, foot.outward_normal);
  const Eigen::MatrixXd u_held = prescribed(feet, half_spaces);
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(u.rows(), 3 * static_cast<Eigen::Index>(feet.size()));
  for (std::size_t k = 0; k < sprung_.size(); ++k)
    forces.middleRows<3>(3 * static_cast<Eigen::Index>(sprung_[k])) +=
        spring_ * u_held.middleRows<3>(3 * static_cast<Eigen::Index>(k));
  add_tractions(feet, half_spaces, of_touched_face, forces);
  Eigen::MatrixXd answer = u.transpose() * forces;
  if (sprung_.empty()) answer.noalias() -= forces_of_held(u).transpose() * u_held;
  return answer;
}

// Feet are on one face, so only its functions' displacements are asked for.  By reciprocity these are work of
// the loads on what unit forces on its nodes do: far fewer systems than loads.
std::vector<Matrix3> LocalProblem::compliances(const std::vector<SkinPoint>& feet) const {
  const std::vector<int> hit = places_of(feet.front().nodes);
  const auto count = static_cast<Eigen::Index>(feet.size()), of_face = static_cast<Eigen::Index>(hit.size());
  const Eigen::MatrixXd u = under_unit_forces(hit), answer = by_half_spaces(u, feet, true);

  std::vector<Matrix3> c(feet.size(), Matrix3::Zero());
  for (Eigen::Index f = 0; f < count; ++f)
    for (Eigen::Index a = 0; a < of_face; ++a) {
      Matrix3 at_node = answer.block<3, 3>(3 * a, 3 * f);
      for (Eigen::Index b = 0; b < of_face; ++b) at_node += feet[f].R[b] * u.block<3, 3>(3 * hit[a], 3 * b);
      c[f] += feet[f].R[a] * at_node;
    }
  return c;
}

namespace {

/// Two ways along the tangent plane, v_k, by which Z's second moments about the foot are the sum of v v^T;
/// the first is along t_1, but for a net that is skew.
std::array<Vector3, 2> ways_of(const SpreadFoot& foot, const std::vector<Vector3>& places) {
  Eigen::Matrix2d M = Eigen::Matrix2d::Zero();
  for (std::size_t a = 0; a < places.size(); ++a) {
    const Eigen::Vector2d way = foot.frame.leftCols<2>().transpose() * (places[a] - foot.at.point);
    M += foot.beside.Z[a] * way * way.transpose();
  }
  const double across = std::sqrt(std::max(M(0, 0), 0.0)), both = across > 0.0 ? M(1, 0) / across : 0.0;
  const double rest = std::sqrt(std::max(M(1, 1) - both * both, 0.0));
  return {across * foot.frame.col(0) + both * foot.frame.col(1), rest * foot.frame.col(1)};
}

}  // namespace

// The half-space of Z is that of forces to both sides of the foot, less that at the foot, with its moments.
// On the face that is touched they do nothing: it is the half-space's own, but for its curvature.
std::vector<LocalProblem::OfSpread> LocalProblem::spread_compliances(
    const std::vector<SpreadFoot>& feet) const {
  constexpr double kWithin = 0.5;  // of the room
  const std::vector<Id>& nodes = feet.front().beside.nodes;
  const std::vector<int> places = places_of(nodes);
  const ReferenceBody& body = patch_.body();
  std::vector<Vector3> points;
  for (const Id node : nodes) points.push_back(body.place(node));
  const auto count = static_cast<Eigen::Index>(nodes.size());
  std::vector<SkinPoint> at, around;
  std::vector<double> weights;  // of those around
  for (const SpreadFoot& foot : feet) {
    at.push_back(foot.at);
    around.push_back(foot.at);
    const std::size_t centre = weights.size();
    weights.push_back(0.0);
    for (const Vector3& way : ways_of(foot, points)) {
      const double length = std::sqrt(2.0) * way.norm(),
                   share = length > 0.0 ? std::min(1.0, kWithin * foot.room / length) : 0.0;
      const double weight = share > 0.0 ? 0.25 / (share * share) : 0.0;
      for (const double side : {-1.0, 1.0}) {
        around.push_back(foot.at);
        around.back().point += side * share * std::sqrt(2.0) * way;
        weights.push_back(weight);
      }
      weights[centre] -= 2.0 * weight;
    }
  }
  const Eigen::MatrixXd u = under_unit_forces(places), of_point = by_half_spaces(u, at, true);
  const Eigen::MatrixXd of_around = by_half_spaces(u, around, false);
  const std::size_t each = around.size() / feet.size();
  std::vector<OfSpread> found;
  for (std::size_t f = 0; f < feet.size(); ++f) {
    const std::vector<double> R = feet[f].at.forces_on(nodes);
    const std::vector<double>& Z = feet[f].beside.Z;
    Matrix3 R_by_Z = Matrix3::Zero(), Z_by_R = Matrix3::Zero(), Z_by_Z = Matrix3::Zero();
    for (Eigen::Index a = 0; a < count; ++a) {
      Matrix3 by_R = of_point.block<3, 3>(3 * a, 3 * static_cast<Eigen::Index>(f)), by_Z = Matrix3::Zero();
      for (std::size_t k = f * each; k < (f + 1) * each; ++k)
        by_Z += weights[k] * of_around.block<3, 3>(3 * a, 3 * static_cast<Eigen::Index>(k));
      for (Eigen::Index b = 0; b < count; ++b) {
        const auto response = u.block<3, 3>(3 * places[a], 3 * b);
        by_R += R[b] * response;
        by_Z += Z[b] * response;
      }
      R_by_Z += R[a] * by_Z;
      Z_by_R += Z[a] * by_R;
      Z_by_Z += Z[a] * by_Z;
    }
    found.push_back({0.5 * (R_by_Z + Z_by_R), Z_by_Z});
  }
  return found;
}

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/compliance_tables.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "structure/compliance/alike_elements.h"
#include "structure/material/isotropic_elastic.h"

namespace structure {

namespace {

constexpr int kLowestDegree = 2, kHighestDegree = 3;

void expect_law(const Material& law) {
  if (dynamic_cast<const IsotropicElastic*>(&law) == nullptr || law.state_size() > 0)
    throw std::invalid_argument(fmt::format(
        "local compliances are known of isotropic elastic materials without memory, given '{}'", law.law()));
}

void expect_degrees(const nurbs::Space<3>& space) {
  for (int d = 0; d < 3; ++d)
    if (const int p = space.degree(d); p < kLowestDegree || p > kHighestDegree)
      throw std::invalid_argument(
          fmt::format("local compliances are known for degrees {} and {}, given {}, {}, {}", kLowestDegree,
                      kHighestDegree, space.degree(0), space.degree(1), space.degree(2)));
}

// Under so few points the mesh's answer is not local: on cubes it still changes by 1 % from 5 to 6 layers.
void expect_quadrature(Quadrature quadrature) {
  if (quadrature == Quadrature::zou)
    throw std::invalid_argument(
        "local compliances are known for quadratures 'full' and 'reduced', given 'zou'");
}

/// p + 1 layers of elements around the one that is hit.
LocalExtent extent_for(const nurbs::Space<3>& space) {
  return {std::max({space.degree(0), space.degree(1), space.degree(2)}) + 1};
}

/// Changes the values inside as smoothly as `change` asks for on the sides: bilinear between them (Coons,
/// 1967).
void blend(const std::array<int, 2>& counts, const std::vector<Matrix3>& change,
           std::vector<Matrix3>& values) {
  const std::vector<double> s = lobatto_points(counts[0]), t = lobatto_points(counts[1]);
  const int right = counts[0] - 1, top = counts[1] - 1;
  const auto at = [&](int i, int j) -> const Matrix3& { return change[i + counts[0] * j]; };
  for (int j = 1; j < top; ++j)
    for (int i = 1; i < right; ++i) {
      const double x1 = 0.5 * (1.0 + s[i]), x0 = 1.0 - x1, y1 = 0.5 * (1.0 + t[j]), y0 = 1.0 - y1;
      values[i + counts[0] * j] += x0 * at(0, j) + x1 * at(right, j) + y0 * at(i, 0) + y1 * at(i, top) -
                                   x0 * y0 * at(0, 0) - x1 * y0 * at(right, 0) - x0 * y1 * at(0, top) -
                                   x1 * y1 * at(right, top);
    }
}

/// With the normal, as contacts over an edge are.
Matrix3 turned(const Matrix3& tensor, const Vector3& from, const Vector3& to) {
  if (from == to) return tensor;
  const Vector3 axis = from.cross(to);
  const Matrix3 turn =
      Eigen::AngleAxisd(std::atan2(axis.norm(), from.dot(to)), axis.normalized()).toRotationMatrix();
  return turn * tensor * turn.transpose();
}

}  // namespace

ComplianceTables::ComplianceTables(ReferenceBody body, std::vector<SkinPiece> skin)
    : body_(std::move(body)),
      near_(body_),
      gradients_(body_),
      skin_(std::move(skin)),
      shared_(body_, near_, skin_, surfaces_) {
  expect_quadrature(body_.quadrature);
  for (const SkinPiece& piece : skin_) {
    const nurbs::Volume& patch = body_.patches[piece.patch];
    expect_law(*body_.materials[piece.patch]);
    expect_degrees(patch.space);
    surfaces_.emplace_back(body_, piece);
    solved_of_.emplace_back(surfaces_.back().space().element_count());
    known_.emplace_back(solved_of_.back().size(), nullptr);
    const int d = static_cast<int>(piece.face) / 2;
    const LocalExtent extent = extent_for(patch.space);
    alike_.push_back(
        {alike_elements(patch, d == 0 ? 1 : 0, extent), alike_elements(patch, d == 2 ? 1 : 2, extent)});
  }
}

LocalPatch ComplianceTables::patch_of(const HitElement& hit) const {
  return {body_, near_, hit.volume(), extent_for(body_.patches[hit.volume().patch].space)};
}

ComplianceTables::Tensors ComplianceTables::solve(int piece, int element) const {
  const HitElement hit(body_, near_, skin_[piece], surfaces_[piece], element);
  std::vector<SkinPoint> feet;
  for (const nurbs::Parameter<2>& xi : table_points(surfaces_[piece].space(), element))
    feet.push_back(hit.foot(xi));
  const LocalPatch patch = patch_of(hit);
  return LocalProblem(patch, gradients_).compliances(feet);
}

int ComplianceTables::first_alike(int piece, int element) const {
  const nurbs::Space<2>& space = surfaces_[piece].space();
  nurbs::Indices<2> span = space.element_indices(element);
  for (int d = 0; d < 2; ++d) span[d] = alike_[piece][d][span[d]];
  return space.element_index(span);
}

const ComplianceTables::Solved& ComplianceTables::solved(int piece, int element) {
  const int first = first_alike(piece, element);
  Solved& solved = solved_of_[piece][first];
  if (!solved.tensors.empty() || !solved.problem.empty()) return solved;
  try {
    solved.tensors = solve(piece, first);
    ++solved_;
  } catch (const std::invalid_argument& problem) {
    solved.problem = problem.what();
  }
  return solved;
}

std::unique_ptr<ComplianceTable> ComplianceTables::table(int piece, int element,
                                                         const Tensors& tensors) const {
  const HitElement hit(body_, near_, skin_[piece], surfaces_[piece], element);
  const nurbs::Space<2>& space = surfaces_[piece].space();
  const std::vector<nurbs::Parameter<2>> points = table_points(space, element);
  std::vector<std::vector<double>> values(ComplianceTable::kComponents);
  for (std::size_t point = 0; point < points.size(); ++point) {
    const Matrix3 frame = hit.frame(points[point]), c = frame.transpose() * tensors[point] * frame;
    const double components[] = {c(2, 2),
                                 c(0, 0),
                                 c(1, 1),
                                 0.5 * (c(0, 1) + c(1, 0)),
                                 0.5 * (c(0, 2) + c(2, 0)),
                                 0.5 * (c(1, 2) + c(2, 1))};
    for (int k = 0; k < ComplianceTable::kComponents; ++k) values[k].push_back(components[k]);
  }
  return std::make_unique<ComplianceTable>(table_counts(space), values);
}

const ComplianceTable& ComplianceTables::find(int piece, int element) {
  const Solved& own = solved(piece, element);
  if (!own.problem.empty()) {
    const Vector3 X = surfaces_[piece].at_centre(element);
    throw std::invalid_argument(
        fmt::format("no local compliance of the element about ({:.6g}, {:.6g}, {:.6g}): {}", X[0], X[1], X[2],
                    own.problem));
  }
  Tensors means;
  Origin origin;
  for (const std::vector<TablePoint>& points : shared_.of(piece, element)) {
    const TablePoint here{piece, element, static_cast<int>(means.size()), {}};
    const Vector3& normal = std::lower_bound(points.begin(), points.end(), here)->normal;
    Matrix3 sum = Matrix3::Zero();
    int count = 0;
    for (const TablePoint& point : points) {
      const Tensors& tensors = solved(point.piece, point.element).tensors;
      if (tensors.empty()) continue;
      sum += turned(tensors[point.index], point.normal, normal);
      ++count;
      origin.emplace_back(&tensors, point.index);
    }
    origin.emplace_back(nullptr, 0);
    means.push_back(sum / count);
  }
  std::unique_ptr<ComplianceTable>& made = tables_[origin];
  if (!made) {
    Tensors change = means;
    for (std::size_t k = 0; k < change.size(); ++k) change[k] -= own.tensors[k];
    blend(table_counts(surfaces_[piece].space()), change, means);
    made = table(piece, first_alike(piece, element), means);  // to the last bit, whoever asks first
  }
  return *(known_[piece][element] = made.get());
}

Matrix3 ComplianceTables::direct(int piece, int element, const nurbs::Parameter<2>& xi) const {
  const HitElement hit(body_, near_, skin_[piece], surfaces_[piece], element);
  const LocalPatch patch = patch_of(hit);
  return LocalProblem(patch, gradients_).compliances({hit.foot(xi)}).front();
}

}  // namespace structure

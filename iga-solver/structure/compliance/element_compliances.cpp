// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/compliance/element_compliances.h"

#include <fmt/format.h>

#include <algorithm>
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

void expect_neighbours(const std::vector<nurbs::Volume>& patches) {
  int elements = 0;
  for (const nurbs::Volume& patch : patches) elements += patch.space.element_count();
  if (elements < 2)
    throw std::invalid_argument(
        "local compliances are known of bodies with elements beside the one that is hit, given a single one");
}

}  // namespace

ElementCompliances::ElementCompliances(ReferenceBody body, const std::vector<SkinPiece>& skin,
                                       std::shared_ptr<const SkinNet> net)
    : body_(std::move(body)),
      near_(body_),
      gradients_(body_),
      skin_(skin),
      shared_(body_, near_, skin_, surfaces_),
      net_(net ? std::move(net) : std::make_shared<const SkinNet>(body_, skin_)) {
  expect_quadrature(body_.quadrature);
  expect_neighbours(body_.patches);
  for (const SkinPiece& piece : skin_) {
    const nurbs::Volume& patch = body_.patches[piece.patch];
    expect_law(*body_.materials[piece.patch]);
    expect_degrees(patch.space);
    surfaces_.emplace_back(body_, piece);
    solved_of_.emplace_back(surfaces_.back().space().element_count());
    spread_of_.emplace_back(surfaces_.back().space().element_count());
    const int d = static_cast<int>(piece.face) / 2;
    const LocalExtent extent = extent_for(patch.space);
    alike_.push_back(
        {alike_elements(patch, d == 0 ? 1 : 0, extent), alike_elements(patch, d == 2 ? 1 : 2, extent)});
  }
}

/// With more layers where forces on an element are also on nodes beyond a seam.
LocalPatch ElementCompliances::patch_around(const HitElement& hit, const std::vector<Id>& pressed) const {
  constexpr int kMostLayersMore = 4;
  LocalExtent extent = extent_for(body_.patches[hit.volume().patch].space);
  for (int more = 0;; ++more, ++extent.layers) {
    LocalPatch patch(body_, near_, hit.volume(), extent);
    if (more == kMostLayersMore || patch.are_free(pressed)) return patch;
  }
}

ElementCompliances::Tensors ElementCompliances::at(const HitElement& hit,
                                                   const std::vector<nurbs::Parameter<2>>& points) const {
  std::vector<SkinPoint> feet;
  for (const nurbs::Parameter<2>& xi : points) feet.push_back(net_->seams.carried(hit.foot(xi)));
  const LocalPatch patch = patch_around(hit, feet.front().nodes);
  return LocalProblem(patch, gradients_).compliances(feet);
}

SpreadFoot ElementCompliances::spread_foot(const HitElement& hit, const nurbs::Parameter<2>& xi,
                                           const SkinPoint& at) const {
  return {net_->seams.carried(at), net_->beside(at), hit.frame(xi), hit.room(xi)};
}

std::vector<LocalProblem::OfSpread> ElementCompliances::spread_at(
    const HitElement& hit, const std::vector<nurbs::Parameter<2>>& points) const {
  std::vector<SpreadFoot> feet;
  for (const nurbs::Parameter<2>& xi : points) feet.push_back(spread_foot(hit, xi, hit.foot(xi)));
  const LocalPatch patch = patch_around(hit, feet.front().beside.nodes);
  return LocalProblem(patch, gradients_).spread_compliances(feet);
}

LocalProblem::OfSpread ElementCompliances::spread_direct(int piece, int element,
                                                         const nurbs::Parameter<2>& xi) const {
  return spread_at(hit(piece, element), {xi}).front();
}

int ElementCompliances::first_alike(int piece, int element) const {
  const nurbs::Space<2>& space = surfaces_[piece].space();
  nurbs::Indices<2> span = space.element_indices(element);
  for (int d = 0; d < 2; ++d) span[d] = alike_[piece][d][span[d]];
  return space.element_index(span);
}

std::array<double, 2> ElementCompliances::lengths(int piece, int element) const {
  const nurbs::Space<2>& space = surfaces_[piece].space();
  const nurbs::Indices<2> span = space.element_indices(first_alike(piece, element));
  std::array<double, 2> lengths;
  for (int d = 0; d < 2; ++d) {
    const std::vector<double>& breaks = space.knots(d).breaks();
    lengths[d] = breaks[span[d] + 1] - breaks[span[d]];
  }
  return lengths;
}

const ElementCompliances::Solved& ElementCompliances::solved(int piece, int element) {
  const int first = first_alike(piece, element);
  Solved& solved = solved_of_[piece][first];
  if (!solved.tensors.empty() || !solved.problem.empty()) return solved;
  try {
    solved.tensors = at(hit(piece, first), table_points(surfaces_[piece].space(), first));
    ++solved_;
  } catch (const std::invalid_argument& problem) {
    solved.problem = problem.what();
  }
  return solved;
}

const ElementCompliances::Solved& ElementCompliances::solved_spread(int piece, int element) {
  const int first = first_alike(piece, element);
  Solved& solved = spread_of_[piece][first];
  if (!solved.tensors.empty() || !solved.problem.empty()) return solved;
  try {
    const auto found = spread_at(hit(piece, first), table_points(surfaces_[piece].space(), first));
    for (const LocalProblem::OfSpread& at : found) solved.tensors.push_back(at.one);
    for (const LocalProblem::OfSpread& at : found) solved.tensors.push_back(at.both);
  } catch (const std::invalid_argument& problem) {
    solved.problem = problem.what();
  }
  return solved;
}

Matrix3 ElementCompliances::direct(int piece, int element, const nurbs::Parameter<2>& xi) const {
  return at(hit(piece, element), {xi}).front();
}

namespace {

using Components = std::array<double, ComplianceTable::kComponents>;

Components in_frame(const Matrix3& tensor, const Matrix3& frame) {
  const Matrix3 c = frame.transpose() * tensor * frame;
  return {c(2, 2),
          c(0, 0),
          c(1, 1),
          0.5 * (c(0, 1) + c(1, 0)),
          0.5 * (c(0, 2) + c(2, 0)),
          0.5 * (c(1, 2) + c(2, 1))};
}

}  // namespace

std::unique_ptr<ComplianceTable> ElementCompliances::table(int piece, int element, const Tensors& tensors,
                                                           const std::vector<double>& taken) const {
  const int same = first_alike(piece, element);
  const HitElement hit = this->hit(piece, same);
  const nurbs::Space<2>& space = surfaces_[piece].space();
  const std::vector<nurbs::Parameter<2>> points = table_points(space, same);
  std::vector<std::vector<double>> values(ComplianceTable::kComponents);
  for (std::size_t point = 0; point < points.size(); ++point) {
    const Components components = in_frame(tensors[point], hit.frame(points[point]));
    for (int k = 0; k < ComplianceTable::kComponents; ++k) values[k].push_back(components[k]);
  }
  for (std::size_t point = 0; point < taken.size(); ++point)
    values[ComplianceTable::normal][point] -= taken[point];
  return std::make_unique<ComplianceTable>(table_counts(space), values, taken);
}

std::unique_ptr<SpreadTable> ElementCompliances::spread_table(int piece, int element, const Tensors& tensors,
                                                              const CrossCompliance* links) const {
  const HitElement hit = this->hit(piece, element);
  const nurbs::Space<2>& space = surfaces_[piece].space();
  const std::vector<nurbs::Parameter<2>> points = table_points(space, element);
  std::vector<SpreadFoot> feet;
  for (const nurbs::Parameter<2>& xi : points)
    feet.push_back(spread_foot(hit, xi, surfaces_[piece].at(element, xi)));
  std::vector<CrossCompliance::OfSpread> taken(points.size(), {0.0, 0.0, 0.0});
  if (links) taken = links->taken_at(feet);
  SpreadTable::Values values;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const SpreadFoot& foot = feet[k];
    const Components one = in_frame(tensors[k], foot.frame),
                     both = in_frame(tensors[points.size() + k], foot.frame);
    for (int c = 0; c < ComplianceTable::kTogether; ++c) {
      const bool is_normal = c == ComplianceTable::normal;
      values[SpreadTable::one + c].push_back(one[c] - (is_normal ? taken[k].one : 0.0));
      values[SpreadTable::both + c].push_back(both[c] - (is_normal ? taken[k].both : 0.0));
    }
    double height = 0.0, moment = 0.0;
    for (std::size_t a = 0; a < foot.beside.nodes.size(); ++a) {
      const Vector3 way = body_.place(foot.beside.nodes[a]) - foot.at.point;
      const double above = way.dot(foot.at.outward_normal);
      height += foot.beside.Z[a] * above;
      moment += 0.5 * foot.beside.Z[a] * (way.squaredNorm() - above * above);
    }
    values[SpreadTable::moment].push_back(moment);
    values[SpreadTable::height].push_back(height);
    values[SpreadTable::taken].push_back(taken[k].taken);
    values[SpreadTable::taken_one].push_back(taken[k].one);
    values[SpreadTable::taken_both].push_back(taken[k].both);
  }
  return std::make_unique<SpreadTable>(table_counts(space), values);
}

}  // namespace structure

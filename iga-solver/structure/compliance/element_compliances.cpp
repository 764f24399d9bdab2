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

ElementCompliances::ElementCompliances(ReferenceBody body, const std::vector<SkinPiece>& skin)
    : body_(std::move(body)),
      near_(body_),
      gradients_(body_),
      skin_(skin),
      shared_(body_, near_, skin_, surfaces_) {
  expect_quadrature(body_.quadrature);
  expect_neighbours(body_.patches);
  for (const SkinPiece& piece : skin_) {
    const nurbs::Volume& patch = body_.patches[piece.patch];
    expect_law(*body_.materials[piece.patch]);
    expect_degrees(patch.space);
    surfaces_.emplace_back(body_, piece);
    solved_of_.emplace_back(surfaces_.back().space().element_count());
    const int d = static_cast<int>(piece.face) / 2;
    const LocalExtent extent = extent_for(patch.space);
    alike_.push_back(
        {alike_elements(patch, d == 0 ? 1 : 0, extent), alike_elements(patch, d == 2 ? 1 : 2, extent)});
  }
}

ElementCompliances::Tensors ElementCompliances::at(const HitElement& hit,
                                                   const std::vector<nurbs::Parameter<2>>& points) const {
  std::vector<SkinPoint> feet;
  for (const nurbs::Parameter<2>& xi : points) feet.push_back(hit.foot(xi));
  const LocalPatch patch(body_, near_, hit.volume(), extent_for(body_.patches[hit.volume().patch].space));
  return LocalProblem(patch, gradients_).compliances(feet);
}

int ElementCompliances::first_alike(int piece, int element) const {
  const nurbs::Space<2>& space = surfaces_[piece].space();
  nurbs::Indices<2> span = space.element_indices(element);
  for (int d = 0; d < 2; ++d) span[d] = alike_[piece][d][span[d]];
  return space.element_index(span);
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

Matrix3 ElementCompliances::direct(int piece, int element, const nurbs::Parameter<2>& xi) const {
  return at(hit(piece, element), {xi}).front();
}

std::unique_ptr<ComplianceTable> ElementCompliances::table(int piece, int element, const Tensors& tensors,
                                                           const std::vector<double>& taken) const {
  const int same = first_alike(piece, element);
  const HitElement hit = this->hit(piece, same);
  const nurbs::Space<2>& space = surfaces_[piece].space();
  const std::vector<nurbs::Parameter<2>> points = table_points(space, same);
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
  for (std::size_t point = 0; point < taken.size(); ++point)
    values[ComplianceTable::normal][point] -= taken[point];
  return std::make_unique<ComplianceTable>(table_counts(space), values, taken);
}

}  // namespace structure

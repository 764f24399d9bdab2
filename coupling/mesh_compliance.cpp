// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/mesh_compliance.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "nurbs/boundary.h"

namespace coupling {

namespace {

std::vector<nurbs::Space<2>> spaces_of(const structure::ReferenceBody& body,
                                       const std::vector<structure::SkinPiece>& skin) {
  std::vector<nurbs::Space<2>> spaces;
  for (const structure::SkinPiece& piece : skin)
    spaces.push_back(nurbs::boundary_surface(body.patches[piece.patch].space, piece.face).space);
  return spaces;
}

template <class Net>
std::vector<LocalCompliance::Share> shares_of(const Net& net) {
  std::vector<LocalCompliance::Share> shares;
  for (const auto& [from, to, share] : net.shares()) shares.push_back({from, to, share});
  return shares;
}

}  // namespace

MeshCompliance::MeshCompliance(structure::ReferenceBody body, const std::vector<structure::SkinPiece>& skin)
    : spaces_(spaces_of(body, skin)), tables_(std::move(body), skin, true) {}

std::vector<LocalCompliance::Link> MeshCompliance::links() const {
  std::vector<Link> links;
  for (const auto& [first, second, give] : tables_.links()->links()) links.push_back({first, second, give});
  return links;
}

std::vector<LocalCompliance::Share> MeshCompliance::shares() const { return shares_of(tables_.net().mean); }

std::vector<LocalCompliance::Share> MeshCompliance::seams() const { return shares_of(tables_.net().seams); }

template <class Ask>
auto MeshCompliance::known(Ask ask) -> decltype(ask()) {
  try {
    return ask();
  } catch (const std::invalid_argument& problem) {
    throw std::invalid_argument(
        fmt::format("{}; use other elements there, or 'compliance none'", problem.what()));
  }
}

namespace {

/// An element of a surface: its number, and where it is.
struct Place {
  Place(const nurbs::Space<2>& space, const nurbs::Indices<2>& at) : element(space.element_index(at)) {
    for (int d = 0; d < 2; ++d) {
      low[d] = space.knots(d).breaks()[at[d]];
      high[d] = space.knots(d).breaks()[at[d] + 1];
    }
  }
  int element;
  nurbs::Parameter<2> low, high;
};

}  // namespace

void MeshCompliance::foresee(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element) const {
  const Place at(spaces_[foot.patch], element);
  tables_.prefetch(foot.patch, at.element, at.low, at.high, foot.xi);
}

void MeshCompliance::find(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element, bool with_shear,
                          Value& value) {
  using Table = structure::ComplianceTable;
  const Place at(spaces_[foot.patch], element);
  const Table& table = known([&]() -> const Table& { return tables_.of(foot.patch, at.element); });
  const double taken = table.taken(at.low, at.high, foot.xi);
  if (!with_shear) {
    const Table::Value normal = table.at(Table::normal, at.low, at.high, foot.xi);
    value = {{normal.c, normal.change}, {}, taken};
    return;
  }
  value.taken = taken;
  Component* const components[] = {&value.normal, &value.along[0], &value.along[1], &value.along[2]};
  static_assert(Table::normal == 0 && Table::first == 1 && Table::second == 2 && Table::first_second == 3);
  table.together(at.low, at.high, foot.xi, [&](int component, const Table::Value& found) {
    *components[component] = {found.c, found.change};
  });
}

void MeshCompliance::find_spread(const nurbs::SurfacePoint& foot, const nurbs::Indices<2>& element,
                                 Spread& spread) {
  using Table = structure::SpreadTable;
  const Place at(spaces_[foot.patch], element);
  const Table& table = known([&]() -> const Table& { return tables_.spread_of(foot.patch, at.element); });
  Component taken_one, taken_both;
  std::array<Component*, Table::kScalars> scalars;
  scalars[Table::one] = &spread.one;
  scalars[Table::both] = &spread.both;
  for (int k = 0; k < 3; ++k) {
    scalars[Table::one + 1 + k] = &spread.along_one[k];
    scalars[Table::both + 1 + k] = &spread.along_both[k];
  }
  scalars[Table::moment] = &spread.moment;
  scalars[Table::height] = &spread.height;
  scalars[Table::taken] = &spread.taken;
  scalars[Table::taken_one] = &taken_one;
  scalars[Table::taken_both] = &taken_both;
  table.for_each(at.low, at.high, foot.xi, [&](int scalar, const structure::ComplianceTable::Value& found) {
    *scalars[scalar] = {found.c, found.change};
  });
  spread.taken_one = taken_one.c;
  spread.taken_both = taken_both.c;
}

void MeshCompliance::follow_strain(const std::vector<nurbs::SurfacePoint>& feet) {
  std::vector<structure::SkinElement> touched;
  for (const nurbs::SurfacePoint& foot : feet)
    touched.push_back({foot.patch, spaces_[foot.patch].element_at(foot.xi)});
  tables_.follow(places_(), touched);
}

}  // namespace coupling

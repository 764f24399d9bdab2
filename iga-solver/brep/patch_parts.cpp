// SPDX-License-Identifier: GPL-2.0-or-later
#include "brep/patch_parts.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "nurbs/refinement.h"

namespace brep {
namespace {

constexpr double kTurn = 1e-6;     // less is round-off in a file [rad]
constexpr double kSameCut = 1e-9;  // of a patch's range

// Whether a line of parameters is one point, as two cones have where they meet.
bool is_point(const nurbs::Surface& patch, int direction, double knot) {
  const nurbs::KnotVector& knots = patch.space.knots(direction);
  const auto at = std::lower_bound(knots.knots().begin(), knots.knots().end(), knot);
  const int row = static_cast<int>(at - knots.knots().begin()) - 1;  // control points on that line
  const int n = patch.space.control_point_count(0), along = patch.space.control_point_count(1 - direction);
  const auto point = [&](int k) {
    return patch.control_points.col(direction == 0 ? row + n * k : k + n * row);
  };
  const double size =
      (patch.control_points.rowwise().maxCoeff() - patch.control_points.rowwise().minCoeff()).norm();
  for (int k = 1; k < along; ++k)
    if ((point(k) - point(0)).norm() > kSameCut * size) return false;
  return true;
}

// Where a patch turns inside; nothing if it turns by no more than edge_angle.
std::array<std::vector<double>, 2> turns_of(const nurbs::Surface& patch, double edge_angle) {
  std::array<std::vector<double>, 2> turns;
  double largest = 0.0;
  for (int i = 0; i < 2; ++i) {
    const std::vector<double>& creases = patch.space.knots(i).creases();
    for (std::size_t c = 1; c + 1 < creases.size(); ++c) {
      const double kink = is_point(patch, i, creases[c]) ? nurbs::kPi : kink_at(patch, i, creases[c]);
      largest = std::max(largest, kink);
      if (kink > kTurn) turns[i].push_back(creases[c]);
    }
  }
  if (!(largest > edge_angle)) return {};
  return turns;
}

}  // namespace

PatchParts::PatchParts(const std::vector<nurbs::Surface>& patches, double edge_angle) {
  bool any = false;
  for (const nurbs::Surface& patch : patches) {
    nurbs::check_patch(patch);
    cuts_.push_back({turns_of(patch, edge_angle)});
    any = any || cuts_.back().count(0) * cuts_.back().count(1) > 1;
  }
  if (!any) return;
  continue_through(patches);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    cuts_[p].first_part = static_cast<int>(patch_of_.size());
    patch_of_.insert(patch_of_.end(), cuts_[p].count(0) * cuts_[p].count(1), static_cast<int>(p));
  }
}

// Whether it was not there.  A knot of the patch is taken for what it is.
bool PatchParts::add(const nurbs::Surface& patch, int direction, double relative, Cuts& cuts) const {
  const nurbs::KnotVector& knots = patch.space.knots(direction);
  const double range = knots.back() - knots.front();
  double cut = knots.front() + relative * range;
  for (const double knot : knots.breaks())
    if (std::abs(knot - cut) <= kSameCut * range) cut = knot;
  std::vector<double>& all = cuts.at[direction];
  const auto place = std::lower_bound(all.begin(), all.end(), cut - kSameCut * range);
  if (cut <= knots.front() || cut >= knots.back()) return false;
  if (place != all.end() && *place <= cut + kSameCut * range) return false;
  all.insert(place, cut);
  return true;
}

// Parts meet with whole sides.
void PatchParts::continue_through(const std::vector<nurbs::Surface>& patches) {
  struct Seen {
    int patch, along;
    bool reversed;
  };
  std::map<int, std::vector<Seen>> curves;
  const auto sides = nurbs::curves_of_sides(patches);
  for (int p = 0; p < static_cast<int>(patches.size()); ++p)
    for (int side = 0; side < nurbs::kSideCount; ++side)
      curves[sides[p][side].first].push_back({p, 1 - side / 2, sides[p][side].reversed});
  for (bool found = true; found;) {
    found = false;
    for (const auto& [first, seen] : curves)
      for (const Seen& from : seen) {
        const nurbs::KnotVector& knots = patches[from.patch].space.knots(from.along);
        const std::vector<double> cuts = cuts_[from.patch].at[from.along];
        for (const double cut : cuts) {
          const double t = (cut - knots.front()) / (knots.back() - knots.front());
          for (const Seen& to : seen)
            found |=
                add(patches[to.patch], to.along, from.reversed == to.reversed ? t : 1.0 - t, cuts_[to.patch]);
        }
      }
  }
}

std::vector<nurbs::Surface> PatchParts::parts_of(const std::vector<nurbs::Surface>& patches) const {
  if (none()) return patches;
  std::vector<nurbs::Surface> parts;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const nurbs::Space<2>& space = patches[p].space;
    const auto end_of = [&](int direction, int k) {
      const std::vector<double>& cuts = cuts_[p].at[direction];
      if (k == 0) return space.knots(direction).front();
      return k <= static_cast<int>(cuts.size()) ? cuts[k - 1] : space.knots(direction).back();
    };
    for (int j = 0; j < cuts_[p].count(1); ++j) {
      const nurbs::Surface strip = nurbs::part_between(patches[p], 1, end_of(1, j), end_of(1, j + 1));
      for (int i = 0; i < cuts_[p].count(0); ++i)
        parts.push_back(nurbs::part_between(strip, 0, end_of(0, i), end_of(0, i + 1)));
    }
  }
  return parts;
}

int PatchParts::part_of_cut(const nurbs::SurfacePoint& at) const {
  const Cuts& cuts = cuts_[at.patch];
  const auto place = [&](int i) {
    return static_cast<int>(std::upper_bound(cuts.at[i].begin(), cuts.at[i].end(), at.xi[i]) -
                            cuts.at[i].begin());
  };
  return cuts.first_part + place(0) + cuts.count(0) * place(1);
}

void PatchParts::keep_in_cut(int part, nurbs::Parameter<2>& xi) const {
  const Cuts& cuts = cuts_[patch_of_[part]];
  const int number = part - cuts.first_part;
  const int place[2] = {number % cuts.count(0), number / cuts.count(0)};
  for (int i = 0; i < 2; ++i) {
    const std::vector<double>& at = cuts.at[i];
    if (place[i] > 0) xi[i] = std::max(xi[i], at[place[i] - 1]);
    if (place[i] < static_cast<int>(at.size()) && xi[i] >= at[place[i]])
      xi[i] = std::nextafter(at[place[i]], at[place[i]] - 1.0);
  }
}

}  // namespace brep

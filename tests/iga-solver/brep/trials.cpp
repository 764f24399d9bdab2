// SPDX-License-Identifier: GPL-2.0-or-later
#include "trials.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "cad_of_wall.h"

namespace brep::trials {
namespace {

constexpr double kTwice = 1e-8;    // feet that are one
constexpr double kReach = 1.2;     // of points that are tried, at most
constexpr double kRounded = 3e-6;  // how far points may be from where they were meant, over the size
constexpr double kThin = 3e-6;     // heights of triangles that have no plane of their own, over the size
constexpr double kUnevenRounded = 3e-6;  // likewise, and of feet
constexpr double kNextTo = 3e-6;         // beyond what rounding opens or closes at borders
constexpr double kBesideRounded = 1e-4;  // how far feet on short edges move by it, at most

std::string text(const Vector3& x) { return fmt::format("({:.17g}, {:.17g}, {:.17g})", x[0], x[1], x[2]); }

}  // namespace

std::mt19937 seeded(unsigned seed, int index) {
  std::seed_seq seeds{seed, static_cast<unsigned>(index)};
  return std::mt19937(seeds);
}

Trial::Trial(std::mt19937 random, Surface surface)
    : random_(random), surface_(std::move(surface)), search_(surface_) {}

Surface given_as(Given given, Surface wall) {
  if (given == Given::plainly) return wall;
  std::vector<int> all(wall.faces.size());
  std::iota(all.begin(), all.end(), 0);
  return from_cad(cad_of(wall, given == Given::as_patches), all);
}

TriangleTrial::TriangleTrial(unsigned seed, int index, Given given)
    : TriangleTrial(seeded(seed, index), index, given) {}

TriangleTrial::TriangleTrial(std::mt19937 random, int index, Given given)
    : TriangleTrial(random_wall(random, index % kFamilies), random, given) {}

TriangleTrial::TriangleTrial(const Wall& wall, const std::mt19937& random, Given given)
    : TriangleTrial(wall, built(wall), given_as(given, built(wall)), false, random) {}

TriangleTrial::TriangleTrial(const Wall& meant, Surface plain, Surface surface, bool rounded,
                             const std::mt19937& random)
    : Trial(random, std::move(surface)),
      wall_(meant),
      plain_(std::move(plain)),
      judge_(wall_, surface_.edge_angle) {
  rounded_ = rounded;
  if (rounded_) {
    beside_ = kBesideRounded;
    uneven_ = kUnevenRounded;
  }
  for (const Piece& piece : plain_.pieces)
    for (const int v : piece.vertex) {
      const Frame& plane = plain_.faces[piece.face].frame;
      uneven_ = std::max(uneven_, std::abs(plane.z.dot(plain_.vertices[v].point - plane.origin)));
    }
}

// The face whose piece has its middle there, or -1.
int TriangleTrial::face_of(const Vector3& middle) const {
  double least = rounded_ ? kRounded * surface_.size : 1e-12;
  int face = -1;
  for (const Piece& piece : plain_.pieces) {
    Vector3 sum = Vector3::Zero();
    for (const int v : piece.vertex) sum += plain_.vertices[v].point / 3.0;
    if ((sum - middle).norm() >= least) continue;
    face = piece.face;
    least = (sum - middle).norm();
  }
  return face;
}

std::string TriangleTrial::try_sheets() {
  std::map<int, int> of_judge, back;
  for (size_t t = 0; t < wall_.triangles.size(); ++t) {
    const Vector3 &a = wall_.points[wall_.triangles[t][0]], &b = wall_.points[wall_.triangles[t][1]],
                  &c = wall_.points[wall_.triangles[t][2]], n = (b - a).cross(c - a);
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (rounded_ && n.norm() < kThin * surface_.size * longest)
      continue;  // it may be part of either neighbour
    const int face = face_of((a + b + c) / 3.0);
    if (face < 0) return fmt::format("triangle {} is no piece", t);
    const Frame& plane = plain_.faces[face].frame;
    const int turned = plane.z.dot(n) > 0.0 ? 1 : -1;
    if (rounded_)  // a foot is as far off as the face is tilted
      uneven_ = std::max(
          {uneven_, kReach * plane.z.cross(n.normalized()).norm(), std::abs(plane.z.dot(a - plane.origin))});
    for (int side = 0; side < 2; ++side) {
      const int theirs = judge_.sheet(static_cast<int>(t), side),
                ours = surface_.sheet(face, side == 0 ? turned : -turned);
      if (of_judge.emplace(theirs, ours).first->second != ours ||
          back.emplace(ours, theirs).first->second != theirs)
        return fmt::format("sheets differ at triangle {}", t);
    }
  }
  if (surface_.sheet_count != static_cast<int>(back.size())) return "number of sheets";
  sheet_of_judge_.assign(2 * wall_.triangles.size(), -1);
  for (const auto& [theirs, ours] : of_judge) sheet_of_judge_[theirs] = ours;
  return {};
}

std::string Trial::try_point(int number, long& count) {
  const Vector3 d = draw(number % kPlaces);
  const double reach = std::uniform_real_distribution<double>(0.1, kReach)(random_);
  near_.clear(), feet_.clear(), from_active_.clear();
  search_.near(d, reach, near_);
  search_.feet(d, reach, near_.data(), static_cast<int>(near_.size()), feet_);
  count += static_cast<long>(feet_.size());
  if (std::string wrong = compare(d, reach, feet_); !wrong.empty()) return wrong + " of " + text(d);

  // The same from a list that was made elsewhere.
  near_.clear();
  search_.near(d + 0.2 * random_direction(random_), reach + 0.21, near_);
  active_.resize(near_.size());
  const int active = search_.activate(d + 0.05 * random_direction(random_), reach + 0.051, near_.data(),
                                      static_cast<int>(near_.size()), active_.data());
  search_.feet(d, reach, active_.data(), active, from_active_);
  if (lies_on_an_axis()) return {};
  if (from_active_.size() != feet_.size()) return "other feet from an active subset of " + text(d);
  for (size_t k = 0; k < feet_.size(); ++k)
    if (feet_[k].point != from_active_[k].point) return "other feet from an active subset of " + text(d);
  return {};
}

// On the axis of a round patch minima are not isolated: the search gives some of them.
bool Trial::lies_on_an_axis() const {
  for (const Foot& a : feet_)
    for (const Foot& b : feet_)
      if (surface_.patches && &a != &b && a.patch == b.patch && std::abs(a.distance - b.distance) < 1e-12)
        return true;
  return false;
}

// Of points next to d, most.
template <class Condition>
bool mostly(const Vector3& d, Condition condition) {
  std::mt19937 random(1);
  int count = 0;
  for (int k = 0; k < 20; ++k) count += condition(d + kNextTo * random_direction(random)) ? 1 : 0;
  return count >= 10;
}

// Whether a minimum that has no foot at d has one next to it.
bool Trial::found_beside(const Vector3& d, double reach, const Minimum& minimum) const {
  return mostly(d, [&](const Vector3& x) {
    const auto found = trials::feet(surface_, x, reach + kNextTo);
    return std::any_of(found.begin(), found.end(), [&](const Foot& foot) {
      return foot.sheet == sheet_of(minimum) && (foot.point - minimum.point).norm() < 3.0 * beside_;
    });
  });
}

// Whether one that counts twice at d does so next to it.
bool Trial::twice_beside(const Vector3& d, double reach, const Foot& foot) const {
  return mostly(d, [&](const Vector3& x) {
    const auto found = trials::feet(surface_, x, reach + kNextTo);
    return std::count_if(found.begin(), found.end(), [&](const Foot& other) {
             return foot.sheet == other.sheet && (foot.point - other.point).norm() < kTwice;
           }) > 1;
  });
}

// Whether a minimum that has no foot at d gives way to another one's, over a slightly concave edge, next to
// d: which of the two is nearer is a matter of rounding.  Their distances change as d moves from the one to
// the other.
bool Trial::gives_way_beside(const Vector3& d, double reach, const Minimum& minimum,
                             const std::vector<Foot>& feet) const {
  constexpr double kFarthest = 4.0, kSame = 0.3;  // over their distance from each other
  const double off = 2.0 * uneven_;
  const auto gives_way_to = [&](const Foot& foot) {
    const Vector3 way = foot.point - minimum.point;
    const double angle = way.norm() / minimum.distance;
    if (foot.sheet != sheet_of(minimum) || std::abs(foot.distance - minimum.distance) > off) return false;
    for (double by = 0.25; by <= kFarthest && by * way.norm() * angle <= off; by *= 2.0) {
      const auto beside = judge().minima(d + by * way, reach + by * way.norm(), -1e-9);
      const auto follows = [&](const Vector3& point) {
        return std::any_of(beside.begin(), beside.end(), [&](const Minimum& m) {
          return sheet_of(m) == foot.sheet && (m.point - point - by * way).norm() < kSame * way.norm();
        });
      };
      if (follows(foot.point) && !follows(minimum.point)) return true;
    }
    return false;
  };
  return std::any_of(feet.begin(), feet.end(), gives_way_to);
}

// On borders of what is a minimum: whether it is one for points beside d.
bool Trial::minimum_beside(const Vector3& d, double reach, const Foot& foot) const {
  std::mt19937 random(1);
  for (int k = 0; k < 30; ++k)
    for (const auto& m :
         judge().minima(d + beside_ * random_direction(random), reach + 10.0 * beside_, 1e-9, {foot.point}))
      if (foot.sheet == sheet_of(m) && (foot.point - m.point).norm() < 100.0 * beside_) return true;
  return false;
}

std::string Trial::compare(const Vector3& d, double reach, const std::vector<Foot>& feet) const {
  const auto same = [&](const Foot& foot, const Minimum& m) {
    return foot.sheet == sheet_of(m) && (foot.point - m.point).norm() < 1e-7 + 30.0 * uneven_;
  };
  std::vector<Vector3> found;
  for (const Foot& foot : feet) found.push_back(foot.point);
  const auto lenient = judge().minima(d, reach + 1e-9, 1e-9, found);
  for (size_t k = 0; k < feet.size(); ++k) {
    const Foot& foot = feet[k];
    if (foot.distance < 1e-9 + 2.0 * uneven_)
      return {};  // on the wall: on which side of it, and in which region, round-off or unevenness says
    if (std::none_of(lenient.begin(), lenient.end(), [&](const auto& m) { return same(foot, m); }) &&
        !minimum_beside(d, reach, foot))
      return fmt::format("foot {} on sheet {} (status {}) is no minimum", text(foot.point), foot.sheet,
                         static_cast<int>(foot.status));
    for (size_t j = 0; j < k; ++j)
      if (feet[j].sheet == foot.sheet && (feet[j].point - foot.point).norm() < kTwice &&
          !(rounded_ && !twice_beside(d, reach, foot)))
        return "a foot counts twice";
    const Face& face = surface_.faces[foot.patch];
    const Vector3 at =
        face.kind == Kind::nurbs ? surface_.patches->point(face.patch, foot.xi) : face.point(foot.xi);
    if ((at - foot.point).norm() > 3e-6 * surface_.size ||
        std::abs((d - foot.point).norm() - foot.distance) > 1e-12)
      return "a foot does not agree with its parameters";
    if (surface_.sheet(foot.patch, foot.side) != foot.sheet) return "a foot is on another sheet";
  }
  for (const auto& m : lenient)
    if (std::none_of(feet.begin(), feet.end(), [&](const Foot& foot) { return same(foot, m); }) &&
        m.distance > 1e-9 && judge().lasts(d, reach, m, beside_) &&
        !(rounded_ && (found_beside(d, reach, m) || gives_way_beside(d, reach, m, feet))))
      return fmt::format("minimum {} on sheet {} is missed", text(m.point), sheet_of(m));
  return {};
}

}  // namespace brep::trials

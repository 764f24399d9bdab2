// SPDX-License-Identifier: GPL-2.0-or-later
// A ball that is rolled over every edge of CAD parts, both ways, pressed in by a thousandth of its radius: it
// never falls through, forces do not jump, and what is one contact stays one.  Where it is placed says brute
// force (occt_samples.h).  Exit code 1 if something is wrong.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "balls.h"
#include "brep/face_shape.h"
#include "cad_wall.h"
#include "coupling/rigid/rigid_surface.h"
#include "crossings.h"
#include "occt_judge.h"
#include "occt_samples.h"
#include "tried_files.h"

namespace {

using nurbs::Vector3;
using test::Crossing;

constexpr double kOverlap = 1e-3;   // of the radius
constexpr double kJump = 1e-6;      // of the force
constexpr double kClosest = 2e-10;  // of the radius: places between which a jump is one

class Rolling {
 public:
  explicit Rolling(const std::string& file, bool stacks)
      : stacks_(stacks),
        wall_(std::make_shared<brep::Surface>(step_parts::wall_of(step_parts::model_of(file)))),
        rigid_(wall_),
        samples_(file),
        judge_(file),
        scene_(rigid_, one_ball(), 1.0, 1.0, space()) {}

  void run() {
    for (const double share : {0.004, 0.03, 0.12})
      for (int e = 0; e < static_cast<int>(wall_->edges.size()); ++e)
        for (const Crossing& crossing : test::crossings(*wall_, e, 0.37)) {
          edge_ = e, radius_ = share * wall_->size;
          roll(crossing);
        }
    fmt::print(
        "{} edges, {} ways, {} without room, {} hollows, {} pressed through; {} places, largest jump {:.3g} "
        "of what may be; wrong: {}\n",
        wall_->edges.size(), ways_, no_room_, hollows_, pressed_, places_, worst_, wrong_);
  }
  int wrong() const { return wrong_; }

 private:
  static test::Balls one_ball() {
    test::Balls balls(30, 1);
    balls.add(Vector3::Constant(1e5), 1.0);
    return balls;
  }
  static contact::PeriodicBox space() { return {{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}, {false, false, false}}; }
  double nearest() const { return radius_ * (1.0 - kOverlap); }

  double distance(const Vector3& p) const { return samples_.nearest({p[0], p[1], p[2]}).distance; }

  // Where the ball's centre is nearest() from the wall, on the line from a point; none: there is no room for
  // it.
  std::optional<Vector3> centre(const Vector3& base, const Vector3& up) const {
    double low = 0.0, high = 0.0, t = nearest();
    for (int k = 0; k < 60 && std::abs(t) < 5.0 * radius_; ++k) {
      const double off = distance(base + t * up) - nearest();
      if (std::abs(off) <= 1e-10 * radius_) return base + t * up;
      (off < 0.0 ? low : high) = t;
      t = k < 30 || high <= low ? t - off : 0.5 * (low + high);
    }
    return std::nullopt;
  }

  // Whether the wall is between a place and the centre of a ball on it, as beyond a bore that is too narrow.
  bool is_behind(const Vector3& base, const Vector3& c) const {
    constexpr int kSteps = 20;
    constexpr double kClose = 0.04;
    for (int k = kSteps / 3; k <= kSteps; ++k)
      if (distance(base + (c - base) * k / kSteps) < kClose * (c - base).norm()) return true;
    return false;
  }

  std::vector<Vector3> way_over(const Crossing& crossing) const {
    constexpr int kBeside = 10, kRound = 16;
    const double angle[2] = {crossing.from + 0.5 * M_PI, crossing.to - 0.5 * M_PI};
    std::vector<Vector3> way;
    const auto add = [&](const Vector3& base, double direction) {
      if (const auto c = centre(base, crossing.direction(direction))) way.push_back(*c);
    };
    for (int k = 0; k < kBeside; ++k)
      add(crossing.place + 0.3 * radius_ * std::pow(0.4, k) * crossing.direction(crossing.from), angle[0]);
    for (int k = 0; k <= kRound; ++k) add(crossing.place, angle[0] + (angle[1] - angle[0]) * k / kRound);
    for (int k = kBeside - 1; k >= 0; --k)
      add(crossing.place + 0.3 * radius_ * std::pow(0.4, k) * crossing.direction(crossing.to), angle[1]);
    if (way.size() != 2 * kBeside + kRound + 1) way.clear();
    return way;
  }

  // In a hollow edge the ball presses on both faces that BRepExtrema says are in reach.
  void expect_both(const Vector3& c) {
    move_to(c);
    std::size_t in_reach = 0;
    for (const int face : crossing_->face)
      in_reach += judge_.nearest_on(face, {c[0], c[1], c[2]}).distance < radius_ - crossing_->gap ? 1 : 0;
    ++hollows_;
    if (in_reach == 2 && crossing_->face[0] != crossing_->face[1] && state_.faces.size() < 2)
      complain(fmt::format("{} contacts in a hollow of two faces", state_.faces.size()));
  }

  // Through the skin of a body, across the edge behind it, and out again: on the side that it came from.
  void press_through(const Crossing& crossing) {
    constexpr double kBehind = 0.1, kAcross = 0.2;  // of the radius
    constexpr int kSteps = 20;
    const Vector3 up = crossing.direction(0.5 * (crossing.from + crossing.to)),
                  on = crossing.direction(crossing.from);
    const auto press = [&](double across, double height) {
      move_to(crossing.place + radius_ * (across * on + height * up));
      const double overlap = state_.force.norm(), expected = radius_ * (1.0 - height);
      if (!(std::abs(overlap - expected) < 0.1 * radius_) || !(state_.force.dot(up) > 0.9 * overlap))
        complain(fmt::format(
            "pressed to {:.3g} of its radius it is pushed by {:.4g} in place of {:.4g}, {:.3g} of this "
            "outwards, by {} contacts",
            height, overlap, expected, state_.force.dot(up) / overlap, state_.faces.size()));
    };
    ++pressed_;
    move_to(Vector3::Constant(1e5));
    for (int k = 0; k <= kSteps; ++k) press(kAcross, 0.9 - (0.9 + kBehind) * k / kSteps);
    for (int k = 0; k <= kSteps; ++k) press(kAcross - 2.0 * kAcross * k / kSteps, -kBehind);
    for (int k = 0; k <= kSteps; ++k) press(-kAcross, -kBehind + (0.9 + kBehind) * k / kSteps);
  }

  // Straight on over a free edge, be there another one beside it or nothing, on the side that `up` [rad]
  // leads to.
  std::vector<Vector3> way_on(const Crossing& crossing, double up) const {
    constexpr int kSteps = 61;
    std::vector<Vector3> way;
    for (int k = 0; k < kSteps; ++k) {
      const double along = 0.3 * std::pow(2.0 * k / (kSteps - 1) - 1.0, 3);  // the closest round the edge
      const auto c = centre(crossing.place - along * radius_ * crossing.direction(crossing.from),
                            crossing.direction(up));
      if (!c) return {};
      way.push_back(*c);
    }
    return way;
  }

  void roll(const Crossing& crossing) {
    crossing_ = &crossing;
    const std::vector<Vector3> way = way_over(crossing);
    roll_along(way);
    if (crossing.wedge == brep::Wedge::concave && has_room(way)) expect_both(way[way.size() / 2]);
    if (crossing.wedge == brep::Wedge::smooth && wall_->faces[crossing.face[0]].outward != 0 &&
        has_room(way) && radius_ < 0.01 * wall_->size)
      press_through(crossing);
    if (crossing.face[0] != crossing.face[1] || crossing.turn() < 0.5 * M_PI) return;
    for (const double side : {0.5, -0.5}) roll_along(way_on(crossing, crossing.from + side * M_PI));
  }

  bool is_in_a_body(const Vector3& c) const {
    for (int solid = 0; solid < judge_.solid_count(); ++solid)
      if (judge_.in_solid(solid, {c[0], c[1], c[2]}, 1e-7) == step_parts::Place::kIn) return true;
    return false;
  }

  // Where the edge bends round the ball's way more tightly than the ball: beyond the centre of the bend its
  // foot there is the farthest one, and feet elsewhere are the nearest.
  bool passes_centre(const std::vector<Vector3>& way) const {
    const auto beyond = [&](const Vector3& c) {
      return crossing_->bent.dot(c - crossing_->place) > 1.0 - 1e-3;
    };
    return std::any_of(way.begin(), way.end(), beyond);
  }

  bool has_room(const std::vector<Vector3>& way) const {
    if (way.empty()) return false;
    for (std::size_t k = 1; k < way.size(); ++k)
      if ((way[k] - way[k - 1]).norm() > 0.5 * radius_) return false;
    if (passes_centre(way)) return false;
    const Vector3& middle = way[way.size() / 2];
    return !is_in_a_body(way.front()) && !is_in_a_body(middle) && !is_in_a_body(way.back()) &&
           !is_behind(crossing_->place, middle);
  }

  void roll_along(std::vector<Vector3> way) {
    if (!has_room(way)) return void(++no_room_);
    ++ways_;
    scene_.balls.radius[0] = radius_;
    move_to(Vector3::Constant(1e5));  // it forgets
    for (int there = 0; there < 2; ++there) {
      move_to(way.front());
      State before = state_;
      for (const Vector3& place : way) {
        move_to(place);
        ++places_;
        expect_contact();
        compare(before, State(state_), 60);
        before = state_;
      }
      std::reverse(way.begin(), way.end());
    }
  }

  struct State {
    Vector3 centre, force = Vector3::Zero();
    std::vector<int> faces;  // of contacts, sorted
  };

  void move_to(const Vector3& place) {
    scene_.balls.centre(0) = place;
    scene_.build_list();
    scene_.evaluate();
    state_.centre = place;
    state_.force = scene_.balls.force(0);
    state_.faces.clear();
    for (const contact::Contact& c : scene_.spring.seen)
      if (c.overlap >= 0.0) state_.faces.push_back(c.foot.patch);
    std::sort(state_.faces.begin(), state_.faces.end());
  }

  // Pressed in by what it is placed for, and what is near the edge is one contact.  Without any it is at most
  // 0.
  void expect_contact() {
    double most = 0.0;
    const auto& seen = scene_.spring.seen;
    for (const contact::Contact& c : seen) most = std::max(most, c.overlap);
    const double off = std::abs(most - kOverlap * radius_);
    if (off > crossing_->gap)
      complain(
          fmt::format("{} contacts, overlap {:.6g}, expected {:.6g}", seen.size(), most, kOverlap * radius_));
    for (std::size_t i = 0; i < seen.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (seen[i].overlap >= 0.0 && seen[j].overlap >= 0.0 && are_one(seen[i], seen[j]))
          complain(fmt::format("two contacts in place of one: faces {} and {}, overlaps {:.8g} and {:.8g}",
                               seen[i].foot.patch + 1, seen[j].foot.patch + 1, seen[i].overlap,
                               seen[j].overlap));
  }
  // Faces without a common edge have a rim each, where some may lie one on the other.
  bool are_one(const contact::Contact& a, const contact::Contact& b) const {
    constexpr double kNear = 0.015;  // of the radius; less than what edges that are not smooth make of it
    const auto meets = [&](const brep::Edge& edge) {
      bool with[2] = {false, false};
      for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) {
        with[0] |= wall_->uses[u].face == a.foot.patch;
        with[1] |= wall_->uses[u].face == b.foot.patch;
      }
      return with[0] && with[1];
    };
    return (a.delta - b.delta).norm() < kNear * radius_ &&
           (!stacks_ || std::any_of(wall_->edges.begin(), wall_->edges.end(), meets));
  }

  // By the change of place, and by what a smooth edge that is not quite smooth turns; of two feet at such an
  // edge in a hollow, by the angle up to which it counts as smooth.
  double may_jump(const State& a, const State& b) const {
    const double own = std::abs(crossing_->turn());
    const bool hollow = crossing_->wedge == brep::Wedge::smooth_concave && own > kJump;
    const double turn = hollow ? wall_->edge_angle : crossing_->wedge == brep::Wedge::smooth ? own : 0.0;
    return 3.0 * (a.centre - b.centre).norm() + (kJump + turn) * std::max(a.force.norm(), b.force.norm()) +
           std::max(crossing_->gap, gap_between(a.faces, b.faces));
  }

  // The largest tolerance of edges at which these faces meet.
  double gap_between(const std::vector<int>& a, const std::vector<int>& b) const {
    const auto has = [&](int face) {
      return std::count(a.begin(), a.end(), face) + std::count(b.begin(), b.end(), face) > 0;
    };
    double most = 0.0;
    for (int e = 0; e < static_cast<int>(wall_->edges.size()); ++e) {
      const brep::Edge& edge = wall_->edges[e];
      bool all = true;
      for (int u = edge.first_use; u < edge.first_use + edge.use_count; ++u) all &= has(wall_->uses[u].face);
      if (all) most = std::max(most, wall_->slack_of_edge(e));
    }
    return most;
  }

  void compare(const State& a, const State& b, int halvings) {
    const double jump = (a.force - b.force).norm(), may = may_jump(a, b);
    if (a.faces == b.faces && jump <= may) return;
    if (halvings == 0 || (a.centre - b.centre).norm() <= kClosest * radius_) {
      worst_ = std::max(worst_, jump / may);
      if (jump > may)
        complain(fmt::format("force jumps by {:.3g} of it, {} contacts and {}",
                             jump / std::max(a.force.norm(), b.force.norm()), a.faces.size(),
                             b.faces.size()));
      return;
    }
    move_to(0.5 * (a.centre + b.centre));
    const State middle = state_;
    compare(a, middle, halvings - 1);
    move_to(middle.centre);
    compare(middle, b, halvings - 1);
    move_to(b.centre);
  }

  void complain(const std::string& what) {
    if (++wrong_ > 20) return;
    fmt::print(
        "  edge {}, radius {:.4g}, faces {} and {}, turn {:.4g}, wedge {}, gap {:.3g}, at ({:.9g}, {:.9g}, "
        "{:.9g}): {}\n",
        edge_, radius_, crossing_->face[0] + 1, crossing_->face[1] + 1, crossing_->turn(),
        static_cast<int>(crossing_->wedge), crossing_->gap, state_.centre[0], state_.centre[1],
        state_.centre[2], what);
  }

  const bool stacks_;
  std::shared_ptr<const brep::Surface> wall_;
  coupling::RigidSurface rigid_;
  step_parts::OcctSamples samples_;
  step_parts::OcctJudge judge_;
  test::BallsOnWall scene_;
  State state_;
  const Crossing* crossing_ = nullptr;
  int edge_ = 0, ways_ = 0, no_room_ = 0, hollows_ = 0, pressed_ = 0, wrong_ = 0;
  long places_ = 0;
  double radius_ = 0.0, worst_ = 0.0;
};

}  // namespace

int main(int argc, char** argv) {
  step_parts::TriedFiles tried("A ball rolled over every edge of CAD parts");
  bool no_stacks = false;
  tried.add_flag("--no-stacks", no_stacks,
                 "nowhere does one wall lie on another: what comes from one direction is one contact");
  MPI_Init(nullptr, nullptr);
  const int code = tried.run(argc, argv, [&](const std::string& file) {
    Rolling rolling(file, !no_stacks);
    rolling.run();
    return rolling.wrong();
  });
  MPI_Finalize();
  return code;
}

// SPDX-License-Identifier: GPL-2.0-or-later
// The nearest foot on the faces of CAD files against OpenCASCADE's distance, or against brute force, which
// the former settles where they differ.  Exit code 1 if one differs.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>

#include "brep/builder.h"
#include "brep/edge_uses.h"
#include "brep/face_shape.h"
#include "brep/foot_search.h"
#include "cad_wall.h"
#include "occt_judge.h"
#include "occt_samples.h"
#include "tried_files.h"

namespace {

using brep::Vector3;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Whose faces have two sides.
brep::Surface wall_of(const std::string& file) {
  brep::CadModel model = step_parts::model_of(file);
  for (brep::CadFace& face : model.faces) face.outward = 0;
  return step_parts::wall_of(model);
}

struct Judged {
  double distance;
  bool inside;  // for certain in a face
};

// Whose distance is compared.
enum class Judges { extrema, samples };

class Trial {
 public:
  Trial(const std::string& file, unsigned seed, Judges judges)
      : wall_(wall_of(file)), search_(wall_), judge_(file), random_(seed) {
    if (judges == Judges::samples) samples_ = std::make_unique<step_parts::OcctSamples>(file);
  }

  void run(int points) {
    double ours = 0.0, theirs = 0.0;
    for (int k = 0; k < points; ++k) {
      const Vector3 d = point(k);
      Clock::time_point start = Clock::now();
      const Judged judged = judge(d);
      theirs += seconds_since(start);
      start = Clock::now();
      const brep::Foot* least = nearest(d, 1.01 * judged.distance + 1e-3 * wall_.size);
      ours += seconds_since(start);
      compare(d, judged, least);
    }
    fmt::print(
        "{} faces, {} edges, size {:.4g}: {} points, {} missed, {} by the judge, {} within tolerances of "
        "edges, most {:.3g} (tolerance "
        "{:.2g}), in faces in closed form {:.3g}; {:.2f} us ours, {:.1f} the judge's\n",
        wall_.faces.size(), wall_.edges.size(), wall_.size, points, misses_, theirs_missed_, beside_edges_,
        worst_, tolerance_, worst_closed_, 1e6 * ours / points, 1e6 * theirs / points);
  }
  int misses() const { return misses_; }

 private:
  Judged judge(const Vector3& d) const {
    const step_parts::Point point{d[0], d[1], d[2]};
    if (!samples_) return {judge_.nearest(point).distance, false};
    const step_parts::OcctSamples::Found found = samples_->nearest(point);
    return {found.distance, found.inside};
  }

  // Null: none.
  const brep::Foot* nearest(const Vector3& d, double reach) {
    near_.clear(), feet_.clear();
    search_.near(d, reach, near_);
    search_.feet(d, reach, near_.data(), static_cast<int>(near_.size()), feet_);
    const auto less = [](const brep::Foot& a, const brep::Foot& b) { return a.distance < b.distance; };
    const auto least = std::min_element(feet_.begin(), feet_.end(), less);
    return least != feet_.end() ? &*least : nullptr;
  }

  // Beside an edge at which two faces miss each other, as far as its tolerance can make the other one nearer.
  double tolerance_beside_edges(const brep::Foot& least) {
    const auto reach = [&](double slack) { return std::sqrt(2.0 * least.distance * slack) + 2.0 * slack; };
    double most = 0.0;
    near_.clear();
    search_.near(least.point, reach(tolerance_), near_);
    for (const int number : near_) {
      const brep::Piece& piece = wall_.pieces[number];
      if (piece.kind != brep::Piece::Kind::edge) continue;
      const double slack = wall_.slack_of_edge(piece.edge[0]);
      if (search_.nearest(least.point, reach(tolerance_), &number, 1) <= reach(slack))
        most = std::max(most, slack);
    }
    return most;
  }

  // BRepExtrema sees the faces' own borders where they were sewn: as far from the common edge as its
  // tolerance, so that our point is no more than that farther.
  bool is_sewn_there(const Vector3& d, double off) {
    const step_parts::Point at = judge_.nearest({d[0], d[1], d[2]}).point;
    const Vector3 point(at[0], at[1], at[2]);
    near_.clear();
    search_.near(point, tolerance_, near_);
    return std::any_of(near_.begin(), near_.end(), [&](int number) {
      const brep::Piece& piece = wall_.pieces[number];
      if (piece.kind != brep::Piece::Kind::edge) return false;
      const double slack = wall_.slack_of_edge(piece.edge[0]);
      return off <= slack && search_.nearest(point, tolerance_, &number, 1) <= slack;
    });
  }

  // Of points inside of faces, and of planes, cylinders, cones, spheres and tori above all, borders'
  // tolerance is of no account.
  double tolerance_of(const Judged& judged, const brep::Foot* least) const {
    constexpr double kClosedForm = 1e-12, kAny = 1e-9;  // of the size
    if (least == nullptr) return tolerance_;
    if (least->status == brep::FootStatus::edge)
      return std::max(kAny * wall_.size, wall_.slack_of_edge(least->entity));
    if (least->status == brep::FootStatus::corner)
      return std::max(kAny * wall_.size, wall_.slack_of_vertex(least->entity));
    if (!judged.inside) return tolerance_;
    return (wall_.faces[least->patch].kind == brep::Kind::nurbs ? kAny : kClosedForm) * wall_.size;
  }

  // Where the two differ by more than the tolerance of borders BRepExtrema says who is right: the judge may
  // not see a nearer point, or have made one up.
  void compare(const Vector3& d, const Judged& judged, const brep::Foot* least) {
    const double ours = least != nullptr ? least->distance : 1e300, off = std::abs(ours - judged.distance);
    const double tolerance = tolerance_of(judged, least);
    if (off <= tolerance) {
      const bool closed = judged.inside && least->status == brep::FootStatus::interior &&
                          wall_.faces[least->patch].kind != brep::Kind::nurbs;
      double& worst = closed ? worst_closed_ : worst_;
      worst = std::max(worst, off);
      return;
    }
    const bool is_right =
        least != nullptr && (samples_ ? std::abs(ours - exact(d)) <= tolerance
                                      : ours < judged.distance && exact(least->point) <= tolerance_);
    if (is_right) return void(++theirs_missed_);
    const bool is_beside =
        least != nullptr && (samples_ ? off <= tolerance_beside_edges(*least)
                                      : exact(least->point) <= tolerance && is_sewn_there(d, off));
    if (is_beside) return void(++beside_edges_);
    if (++misses_ <= 5)
      fmt::print("  ({:.17g}, {:.17g}, {:.17g}): {} feet, nearest at {:.14g}, the judge's at {:.14g}\n", d[0],
                 d[1], d[2], feet_.size(), ours, judged.distance);
  }
  double exact(const Vector3& d) const { return judge_.nearest({d[0], d[1], d[2]}).distance; }

  // Near a face, near an edge, near a vertex, anywhere.
  Vector3 point(int k) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Vector3 off = 0.02 * wall_.size * Vector3(uniform(random_), uniform(random_), uniform(random_));
    const auto any = [&](size_t count) { return random_() % count; };
    if (k % 4 == 3 || wall_.vertices.empty()) {
      const Vector3 half = 0.6 * (wall_.high - wall_.low);
      return 0.5 * (wall_.low + wall_.high) +
             Vector3(half[0] * uniform(random_), half[1] * uniform(random_), half[2] * uniform(random_));
    }
    if (k % 4 == 2) return wall_.vertices[any(wall_.vertices.size())].point + off;
    if (k % 4 == 1) {
      const brep::Edge& edge = wall_.edges[any(wall_.edges.size())];
      return brep::at_part(wall_, edge, 0.5 + 0.5 * uniform(random_)).point + off;
    }
    const auto face = static_cast<int>(any(wall_.faces.size()));
    const brep::TrimDomain& domain = wall_.domains[face];
    for (int tries = 0; tries < 1000; ++tries) {
      brep::Parameter<2> xi;
      for (int i = 0; i < 2; ++i)
        xi[i] = domain.low()[i] + (0.5 + 0.5 * uniform(random_)) * (domain.high()[i] - domain.low()[i]);
      if (domain.inside(xi)) return brep::point_on(wall_, face, xi) + off;
    }
    return wall_.vertices[0].point + off;
  }

  brep::Surface wall_;
  brep::FootSearch search_;
  step_parts::OcctJudge judge_;
  std::unique_ptr<step_parts::OcctSamples> samples_;
  std::mt19937 random_;
  std::vector<int> near_;
  std::vector<brep::Foot> feet_;
  double worst_ = 0.0, worst_closed_ = 0.0;
  // That of edges, which may be farther off their faces than the file says; OpenCASCADE measures to edges,
  // too.
  double tolerance_ = std::max({1e-9 * wall_.size, judge_.tolerance(),
                                *std::max_element(wall_.edge_slack.begin(), wall_.edge_slack.end())});
  int misses_ = 0, theirs_missed_ = 0, beside_edges_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  step_parts::TriedFiles tried("Feet on CAD files against OpenCASCADE's distances", "for each file", 200);
  std::string judges = "extrema";
  tried.add_choice("--judge", judges, {"extrema", "samples"},
                   "extrema: BRepExtrema_DistShapeShape; samples: brute force (occt_samples.h)");
  return tried.run(argc, argv, [&](const std::string& file) {
    Trial trial(file, tried.seed, judges == "samples" ? Judges::samples : Judges::extrema);
    trial.run(tried.points);
    return trial.misses();
  });
}

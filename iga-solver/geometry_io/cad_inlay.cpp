// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_inlay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "geometry_io/any_spline.h"
#include "geometry_io/cad_curves.h"
#include "geometry_io/cad_measures.h"

namespace geometry_io {
namespace {

using brep::CadEdge;
using brep::CadFace;
using brep::CadModel;
using brep::Loop;
using brep::Trim;
using brep::Vector3;

// The curve of an edge in homogeneous coordinates.
AnySpline spline_of(const CadEdge& edge) {
  if (edge.kind == CadEdge::Kind::spline) return homogeneous(edge.curve);
  if (edge.kind == CadEdge::Kind::line) {
    const Vector3 end = edge.origin + edge.length * edge.axis;
    return segment(edge.origin, end, 0.0, edge.length);
  }
  Eigen::MatrixXd placed = Eigen::MatrixXd::Zero(4, 3);
  placed.col(0).head<3>() = edge.R * edge.radial;
  placed.col(1).head<3>() = edge.R * edge.axis.cross(edge.radial);
  placed.col(2) = edge.origin.homogeneous();
  return transformed(unit_arc(0.0, edge.length), placed);
}

brep::Spline<2> on_plane(const brep::Frame& frame, const CadEdge& edge) {
  Eigen::MatrixXd into = Eigen::MatrixXd::Zero(3, 4);
  into.row(0) << frame.x.transpose(), -frame.x.dot(frame.origin);
  into.row(1) << frame.y.transpose(), -frame.y.dot(frame.origin);
  into(2, 3) = 1.0;
  return finished<2>(transformed(spline_of(edge), into));
}

brep::Spline<2> turned_round(const brep::Spline<2>& curve) {
  return finished<2>(reversed(homogeneous(curve)));
}

// Twice the area to the left of it, closed by a straight line.
double area_beside(const brep::Spline<2>& curve) {
  constexpr int kParts = 64;
  const AnySpline spline = homogeneous(curve);
  double twice = 0.0;
  Eigen::VectorXd last = spline.point(spline.begin());
  for (int k = 1; k <= kParts; ++k) {
    const Eigen::VectorXd next = spline.point(spline.begin() + (spline.end() - spline.begin()) * k / kParts);
    twice += last(0) * next(1) - last(1) * next(0);
    last = next;
  }
  return twice;
}

// Where the loops of one face pass a vertex.
class Passes {
 public:
  Passes(const CadModel& model, const CadFace& face) : model_(model), face_(face) {}

  struct Pass {
    int loop, trim;  // the trim that begins there
  };
  // The one at which a way leads into the face; none: the vertex is inside of it.
  std::optional<Pass> at(int vertex, const Vector3& way) const {
    std::optional<Pass> found;
    for (size_t l = 0; l < face_.loops.size(); ++l)
      for (size_t t = 0; t < face_.loops[l].size(); ++t) {
        const Trim &leaving = face_.loops[l][t], &arriving = before(face_.loops[l], t);
        if (leaving.edge < 0 || start_of(leaving) != vertex) continue;
        const Pass pass{static_cast<int>(l), static_cast<int>(t)};
        if (!found || leads_between(arriving, leaving, way)) found = pass;
      }
    return found;
  }

 private:
  static const Trim& before(const Loop& loop, size_t t) { return loop[(t + loop.size() - 1) % loop.size()]; }
  int start_of(const Trim& trim) const { return model_.edges[trim.edge].vertex[trim.forward ? 0 : 1]; }

  // Counterclockwise from the border that leaves to the one that arrives.
  bool leads_between(const Trim& arriving, const Trim& leaving, const Vector3& way) const {
    constexpr double kBeside = 1e-3;
    const BorderCurve on(model_, face_, leaving), back(model_, face_, arriving);
    const Vector3 at = on.point(on.at_part(0.0)),
                  normal = normal_of(model_, face_, on.parameters(on.at_part(0.0)));
    const Vector3 first = on.point(on.at_part(kBeside)) - at,
                  last = back.point(back.at_part(1.0 - kBeside)) - at;
    const auto angle = [&](const Vector3& direction) {
      const double a = std::atan2(normal.dot(first.cross(direction)), first.dot(direction));
      return a < 0.0 ? a + nurbs::kTwoPi : a;
    };
    const bool slit = arriving.edge == leaving.edge && &arriving != &leaving;
    return slit || angle(way) < angle(last);
  }

  const CadModel& model_;
  const CadFace& face_;
};

using Pass = std::optional<Passes::Pass>;

// From this trim on, all round.
Loop beginning_at(const Loop& loop, int trim) {
  Loop turned = loop;
  std::rotate(turned.begin(), turned.begin() + trim, turned.end());
  return turned;
}
void append(Loop& loop, const Loop& more) { loop.insert(loop.end(), more.begin(), more.end()); }

// A closed edge divides what is round it from what it encloses.
void lay_in_closed(std::vector<Loop>& loops, const Trim& there, const Trim& back, const Pass& at) {
  const bool inner_is_there = area_beside(there.curve) > 0.0;
  const Trim &inner = inner_is_there ? there : back, &outer = inner_is_there ? back : there;
  if (at)
    loops[at->loop].insert(loops[at->loop].begin() + at->trim, outer);
  else
    loops.push_back({outer});
  loops.push_back({inner});
}

void lay_in_open(std::vector<Loop>& loops, const Trim& there, const Trim& back, const Pass& start,
                 const Pass& end) {
  if (!start && !end) return loops.push_back({there, back});
  if (!start || !end) {
    const Passes::Pass& at = start ? *start : *end;
    const Loop slit = start ? Loop{there, back} : Loop{back, there};
    loops[at.loop].insert(loops[at.loop].begin() + at.trim, slit.begin(), slit.end());
    return;
  }
  if (start->loop != end->loop) {  // a bridge
    Loop all = beginning_at(loops[start->loop], start->trim);
    all.push_back(there);
    append(all, beginning_at(loops[end->loop], end->trim));
    all.push_back(back);
    loops[start->loop] = std::move(all);
    loops.erase(loops.begin() + end->loop);
    return;
  }
  const Loop whole = beginning_at(loops[start->loop], start->trim);
  const auto count = static_cast<int>(whole.size());
  const int middle = (end->trim - start->trim + count) % count;
  Loop first(whole.begin(), whole.begin() + middle), second(whole.begin() + middle, whole.end());
  first.push_back(back);
  second.push_back(there);
  loops[start->loop] = std::move(first);
  loops.push_back(std::move(second));
}

}  // namespace

std::optional<brep::Spline<2>> curve_on(const brep::Face& face, const CadEdge& edge, double tolerance) {
  if (face.kind == brep::Kind::plane) return on_plane(face.frame, edge);
  constexpr int kSteps = 128;
  const EdgeCurve curve(edge);
  const auto at = [&](double t, const Eigen::Vector2d& near) {
    const brep::Projection foot = face.project(curve.point(t));
    Eigen::Vector2d xi{foot.xi[0], foot.xi[1]};
    for (int d = 0; d < (face.kind == brep::Kind::torus ? 2 : 1); ++d)
      xi[d] -= nurbs::kTwoPi * std::round((xi[d] - near[d]) / nurbs::kTwoPi);
    return xi;
  };
  const auto t_of = [&](double part) { return curve.begin() + part * (curve.end() - curve.begin()); };
  const brep::Projection middle = face.project(curve.point(t_of(0.5)));
  std::vector<Eigen::Vector2d> steps(kSteps + 1);
  steps[kSteps / 2] = {middle.xi[0], middle.xi[1]};
  for (int k = kSteps / 2; k < kSteps; ++k) steps[k + 1] = at(t_of((k + 1.0) / kSteps), steps[k]);
  for (int k = kSteps / 2; k > 0; --k) steps[k - 1] = at(t_of((k - 1.0) / kSteps), steps[k]);
  for (int k = 0; k < kSteps; ++k)
    if ((steps[k + 1] - steps[k]).head<1>().norm() > 0.25) return {};
  const auto point = [&](double part) -> Eigen::VectorXd {
    return at(t_of(part), steps[std::lround(part * kSteps)]);
  };
  const double fine = 1e-5 * tolerance;
  try {
    AnySpline fit = fitted(point, 0.0, 1.0, [&](double part, const Eigen::VectorXd& p) {
      const Eigen::VectorXd q = point(part);
      return (face.point({p(0), p(1)}) - face.point({q(0), q(1)})).norm() / fine;
    });
    fit.points.conservativeResize(3, Eigen::NoChange);
    fit.points.row(2).setOnes();
    return finished<2>(fit);
  } catch (const std::runtime_error&) {  // it takes too many pieces: the file is as good without
    return {};
  }
}

void lay_in(CadModel& model, int number, int edge, brep::Spline<2> curve) {
  constexpr double kBeside = 1e-3;
  CadFace& face = model.faces[number];
  const int* vertex = model.edges[edge].vertex;
  const EdgeCurve in_space(model.edges[edge]);
  const double length = in_space.end() - in_space.begin();
  const Vector3 on = in_space.point(in_space.begin() + kBeside * length) - in_space.point(in_space.begin()),
                back_from =
                    in_space.point(in_space.end() - kBeside * length) - in_space.point(in_space.end());
  const Passes passes(model, face);
  const Pass start = passes.at(vertex[0], on), end = passes.at(vertex[1], back_from);
  const auto corner = [&](const Passes::Pass& at) {
    return face.loops[at.loop][at.trim].curve.points.col(0);
  };
  if (start) curve.points.col(0) = corner(*start);
  if (end) curve.points.rightCols<1>() = corner(*end);
  if (vertex[0] == vertex[1] && !start) curve.points.rightCols<1>() = curve.points.col(0);
  const Trim there{curve, edge, true}, back{turned_round(curve), edge, false};
  if (vertex[0] == vertex[1])
    lay_in_closed(face.loops, there, back, start);
  else
    lay_in_open(face.loops, there, back, start, end);
}

}  // namespace geometry_io

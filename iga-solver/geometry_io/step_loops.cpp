// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/step_loops.h"

#include <fmt/format.h>

#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry_io/spline_range.h"
#include "geometry_io/step_curves.h"

namespace geometry_io {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kFitted = 1e-10;  // of the parameters
constexpr double kPole = 1e-3;     // size of what is meant to be a point [mm]

Vector2d first_point(const AnySpline& curve) { return curve.points.col(0).head<2>() / curve.points(2, 0); }
Vector2d last_point(const AnySpline& curve) {
  const auto last = curve.points.col(curve.points.cols() - 1);
  return last.head<2>() / last(2);
}
Vector2d begin_of(const RawTrim& trim) { return first_point(trim.curve); }
Vector2d end_of(const RawTrim& trim) { return last_point(trim.curve); }

void shift(RawLoop& loop, size_t from, const Vector2d& by) {
  if (by.isZero(0.0)) return;
  for (size_t i = from; i < loop.size(); ++i)
    loop[i].curve.points.topRows<2>() += by * loop[i].curve.points.row(2);
}

// What closes loops of one face.
class LoopMaker {
 public:
  LoopMaker(const TopoDS_Face& face, const GeomAdaptor_Surface& surface) : face_(face), surface_(surface) {
    period_ = {surface.IsUPeriodic() ? surface.UPeriod() : 0.0,
               surface.IsVPeriodic() ? surface.VPeriod() : 0.0};
  }

  RawLoops all() {
    for (TopoDS_Iterator wire(face_); wire.More(); wire.Next())
      if (wire.Value().ShapeType() == TopAbs_WIRE) {
        RawLoop loop = trims_of(TopoDS::Wire(wire.Value()));
        if (loop.empty()) continue;
        measure(loop);
        raw_.loops.push_back(std::move(loop));
      }
    if (raw_.loops.empty()) throw std::runtime_error("no border, expected one loop of edges at least");
    for (RawLoop& loop : raw_.loops) {
      chain(loop);
      close(loop);
    }
    put_outer_first();
    return std::move(raw_);
  }

 private:
  RawLoop trims_of(const TopoDS_Wire& wire) {
    RawLoop loop;
    for (TopoDS_Iterator it(wire); it.More(); it.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(it.Value());
      if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;  // inside
      double from, to;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face_, from, to);
      if (curve.IsNull()) throw std::runtime_error("an edge without a curve in the face's parameters");
      bool fitted = false;
      RawTrim trim;
      trim.curve = spline_of(Geom2dAdaptor_Curve(curve), from, to, 1e-9, fitted);
      trim.forward = edge.Orientation() == TopAbs_FORWARD;
      if (!trim.forward) trim.curve = reversed(trim.curve);
      trim.edge = edge;
      trim.pole = BRep_Tool::Degenerated(edge);
      if (!trim.pole)
        trim.gap = gap_from(edge, *curve, from, to);
      else if (const double away = extent_in_space(*curve, from, to); away > kPole)
        throw std::runtime_error(
            fmt::format("an edge that is nowhere in space, but {:.3g} mm long on the surface", away));
      raw_.fitted += fitted ? 1 : 0;
      loop.push_back(std::move(trim));
    }
    return loop;
  }

  // How far a border leads away from where it begins.
  double extent_in_space(const Geom2d_Curve& border, double from, double to) const {
    constexpr int kPlaces = 8;
    const gp_Pnt2d first = border.Value(from);
    double away = 0.0;
    for (int i = 1; i <= kPlaces; ++i) {
      const gp_Pnt2d p = border.Value(from + (to - from) * i / kPlaces);
      away = std::max(away, gap_in_space({first.X(), first.Y()}, {p.X(), p.Y()}));
    }
    return away;
  }

  // OpenCASCADE's tolerance of an edge should say it, and does not always.
  double gap_from(const TopoDS_Edge& edge, const Geom2d_Curve& border, double from, double to) const {
    constexpr int kPlaces = 40, kPlacesAlike = 400;  // the latter take no search
    double first, last, gap = 0.0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    if (curve.IsNull()) return 0.0;
    const bool alike = BRep_Tool::SameParameter(edge) && first == from && last == to;
    const int places = alike ? kPlacesAlike : kPlaces;
    for (int i = 0; i <= places; ++i) {
      const double t = from + (to - from) * i / places;
      const gp_Pnt2d p = border.Value(t);
      const gp_Pnt there = surface_.Value(p.X(), p.Y());
      gap = std::max(gap, alike ? there.Distance(curve->Value(t)) : distance(there, curve, first, last));
    }
    return gap;
  }

  static double distance(const gp_Pnt& point, const Handle(Geom_Curve) & curve, double first, double last) {
    const double ends = std::min(point.Distance(curve->Value(first)), point.Distance(curve->Value(last)));
    const GeomAPI_ProjectPointOnCurve feet(point, curve, first, last);
    return feet.NbPoints() > 0 ? std::min(ends, feet.LowerDistance()) : ends;
  }

  // How large the face is in its parameters.
  void measure(const RawLoop& loop) {
    for (const RawTrim& trim : loop)
      for (int i = 0; i < trim.curve.points.cols(); ++i) {
        const Vector2d p = trim.curve.points.col(i).head<2>() / trim.curve.points(2, i);
        low_ = low_.cwiseMin(p);
        high_ = high_.cwiseMax(p);
      }
  }
  double far(const Vector2d& step) const {
    return step.cwiseQuotient((high_ - low_).cwiseMax(1e-300)).norm();
  }

  // Whole turns that bring `step` nearest to zero.
  Vector2d turns(const Vector2d& step) const {
    Vector2d by = Vector2d::Zero();
    for (int d = 0; d < 2; ++d)
      if (period_[d] > 0.0) by[d] = -period_[d] * std::round(step[d] / period_[d]);
    return by;
  }

  // One behind the other, in one turn.  The file's order where it is one; what begins a turn away, only if
  // nothing begins at the end itself: beside a seam both may be there.
  void chain(RawLoop& loop) const {
    constexpr double kNear = 1e-6;
    for (size_t i = 0; i + 1 < loop.size(); ++i) {
      const Vector2d end = end_of(loop[i]);
      bool any_here = false;
      for (size_t k = i + 1; k < loop.size(); ++k)
        any_here = any_here || far(begin_of(loop[k]) - end) <= kNear;
      const auto distance = [&](size_t k) {
        const Vector2d step = begin_of(loop[k]) - end;
        return far(any_here ? step : step + turns(step));
      };
      size_t next = i + 1;
      double nearest = distance(next);
      for (size_t k = i + 2; k < loop.size() && nearest > kNear; ++k)
        if (distance(k) < nearest) next = k, nearest = distance(k);
      std::rotate(loop.begin() + i + 1, loop.begin() + next, loop.begin() + next + 1);
      const Vector2d step = begin_of(loop[i + 1]) - end, by = turns(step);
      RawLoop one{loop[i + 1]};
      shift(one, 0, by);
      loop[i + 1] = std::move(one.front());
    }
  }

  double gap_in_space(const Vector2d& a, const Vector2d& b) const {
    return surface_.Value(a.x(), a.y()).Distance(surface_.Value(b.x(), b.y()));
  }

  // How far a straight piece from a to b leads away from a: the parameters of a pole may be far apart.
  double widest_on_bridge(const Vector2d& a, const Vector2d& b) const {
    double gap = 0.0;
    for (const double part : {0.25, 0.5, 0.75, 1.0}) gap = std::max(gap, gap_in_space(a, a + part * (b - a)));
    return gap;
  }

  double allowed_gap(const RawTrim& a, const RawTrim& b) const {
    double allowed = BRep_Tool::Tolerance(face_);
    for (const TopoDS_Edge& edge : {a.edge, b.edge}) {
      allowed = std::max(allowed, BRep_Tool::Tolerance(edge));
      for (const TopoDS_Vertex& vertex : {TopExp::FirstVertex(edge), TopExp::LastVertex(edge)})
        if (!vertex.IsNull()) allowed = std::max(allowed, BRep_Tool::Tolerance(vertex));
    }
    return 3.0 * allowed;  // two balls round a vertex, and an edge's tube
  }

  // A common end for both: that of an iso line where one of them is.
  static void join(RawTrim& a, RawTrim& b) {
    Vector2d corner = 0.5 * (end_of(a) + begin_of(b));
    for (int d = 0; d < 2; ++d)
      for (const RawTrim* trim : {&b, &a})
        if (begin_of(*trim)[d] == end_of(*trim)[d]) corner[d] = begin_of(*trim)[d];
    const auto last = a.curve.points.cols() - 1;
    a.curve.points.col(last).head<2>() = corner * a.curve.points(2, last);
    b.curve.points.col(0).head<2>() = corner * b.curve.points(2, 0);
  }

  void close(RawLoop& loop) {
    constexpr double kSnap = 1e-8;
    RawLoop closed;
    for (size_t i = 0; i < loop.size(); ++i) {
      RawTrim& trim = loop[i];
      RawTrim& next = loop[(i + 1) % loop.size()];
      const Vector2d a = end_of(trim), b = begin_of(next);
      if (far(b - a) <= kSnap && gap_in_space(a, b) <= kSnap) {
        join(trim, next);
        closed.push_back(trim);
        if (i + 1 == loop.size()) closed.front().curve.points.col(0) = next.curve.points.col(0);
        continue;
      }
      closed.push_back(trim);
      const double gap = widest_on_bridge(a, b);
      if (i + 1 == loop.size() && !turns(b - a).isZero(0.0))
        throw std::runtime_error(
            "a border that goes round without a seam, expected one that is closed in the parameters");
      if (gap > allowed_gap(trim, next))
        throw std::runtime_error(
            fmt::format("a border that is open by {:.3g} mm, expected a closed one", gap));
      raw_.widest_gap = std::max(raw_.widest_gap, gap);
      RawTrim bridge;
      bridge.curve = segment(a, b, 0.0, 1.0);
      bridge.pole = true;
      closed.push_back(bridge);
    }
    loop = std::move(closed);
  }

  static double area(const RawLoop& loop) {
    constexpr int kParts = 8;
    double twice = 0.0;
    for (const RawTrim& trim : loop) {
      const auto& c = trim.curve;
      const int parts = c.degree == 1 ? 1 : kParts * static_cast<int>(c.points.cols());
      Vector2d last = first_point(c);
      for (int i = 1; i <= parts; ++i) {
        const Vector2d next =
            i < parts ? Vector2d(c.point(c.begin() + (c.end() - c.begin()) * i / parts)) : last_point(c);
        twice += last.x() * next.y() - last.y() * next.x();
        last = next;
      }
    }
    return 0.5 * twice;
  }

  void put_outer_first() {
    std::vector<std::pair<double, size_t>> areas;
    for (size_t i = 0; i < raw_.loops.size(); ++i) areas.push_back({area(raw_.loops[i]), i});
    const size_t outer = std::max_element(areas.begin(), areas.end())->second;
    if (!(areas[outer].first > 0.0))
      throw std::runtime_error(
          "a border that has no inside, expected an outer loop with the face at its left");
    std::rotate(raw_.loops.begin(), raw_.loops.begin() + outer, raw_.loops.begin() + outer + 1);
    const ParameterBox box = box_of({raw_.loops.front()});
    const Vector2d middle{0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1])};
    for (size_t i = 1; i < raw_.loops.size(); ++i) {
      const ParameterBox own = box_of({raw_.loops[i]});
      shift(raw_.loops[i], 0,
            turns(Vector2d{0.5 * (own.low[0] + own.high[0]), 0.5 * (own.low[1] + own.high[1])} - middle));
    }
  }

  const TopoDS_Face face_;
  const GeomAdaptor_Surface& surface_;
  Vector2d period_, low_ = Vector2d::Constant(1e300), high_ = -low_;
  RawLoops raw_;
};

AnySpline mapped_affinely(const AnySpline& curve, const ReadSurface& surface) {
  AnySpline out = curve;
  for (int d = 0; d < 2; ++d)
    out.points.row(d) =
        surface.map[d].scale * curve.points.row(d) + surface.map[d].shift * curve.points.row(2);
  return out;
}

// Straight, one parameter being the same all along, and not forth and back.
bool is_along_parameter(const AnySpline& curve, const ParameterBox& box) {
  constexpr double kSame = 1e-11;
  const Eigen::ArrayXXd points = curve.points.topRows<2>().array().rowwise() / curve.points.row(2).array();
  for (int d = 0; d < 2; ++d) {
    const Eigen::ArrayXd along = points.row(1 - d);
    const auto n = along.size();
    const Eigen::ArrayXd steps = along.tail(n - 1) - along.head(n - 1);
    const bool same =
        points.row(d).maxCoeff() - points.row(d).minCoeff() <= kSame * (box.high[d] - box.low[d]);
    if (same && (steps.minCoeff() >= 0.0 || steps.maxCoeff() <= 0.0)) return true;
  }
  return false;
}

// Not affine: straight pieces along a parameter stay so, others are fitted.
AnySpline mapped_curve(const AnySpline& curve, const ReadSurface& surface, const ParameterBox& box,
                       int& fitted_count) {
  const auto map = [&](const Vector2d& p) {
    Vector2d q;
    for (int d = 0; d < 2; ++d) q[d] = surface.map[d](p[d]);
    return q;
  };
  if (surface.map[0].affine() && surface.map[1].affine()) return mapped_affinely(curve, surface);
  if (is_along_parameter(curve, box))
    return segment(map(first_point(curve)), map(last_point(curve)), curve.begin(), curve.end());
  ++fitted_count;
  const auto point = [&](double t) -> VectorXd { return map(curve.point(t)); };
  const Vector2d size{box.high[0] - box.low[0], box.high[1] - box.low[1]};
  // Between knots of the curve, where it may have kinks; the map has none at angles but those of its arcs.
  AnySpline all = fitted(point, curve.begin(), curve.end(), [&](double t, const VectorXd& p) {
    return Vector2d(Vector2d(p - point(t)).cwiseQuotient(size)).norm() / kFitted;
  });
  all.points.conservativeResize(3, Eigen::NoChange);
  all.points.row(2).setOnes();
  return all;
}

}  // namespace

RawLoops loops_of(const TopoDS_Face& face, const GeomAdaptor_Surface& surface) {
  return LoopMaker(TopoDS::Face(face.Oriented(TopAbs_FORWARD)), surface).all();
}

ParameterBox box_of(const std::vector<RawLoop>& loops) {
  ParameterBox box{{1e300, 1e300}, {-1e300, -1e300}};
  for (const RawLoop& loop : loops)
    for (const RawTrim& trim : loop)
      for (int d = 0; d < 2; ++d) {
        const Range range = range_of(trim.curve, d);
        box.low[d] = std::min(box.low[d], range.low);
        box.high[d] = std::max(box.high[d], range.high);
      }
  return box;
}

std::vector<brep::Loop> mapped(const RawLoops& raw, const ReadSurface& surface, const ParameterBox& box,
                               const std::function<int(const RawTrim&)>& edge_number, int& fitted_count) {
  std::vector<brep::Loop> loops;
  for (const RawLoop& from : raw.loops) {
    brep::Loop loop;
    for (const RawTrim& trim : from) {
      AnySpline curve = mapped_curve(trim.curve, surface, box, fitted_count);
      const bool turn = !surface.same_side();
      if (turn) curve = reversed(curve);
      loop.push_back({finished<2>(curve), trim.pole ? -1 : edge_number(trim), trim.forward != turn});
    }
    if (!surface.same_side()) std::reverse(loop.begin(), loop.end());
    loops.push_back(std::move(loop));
  }
  return loops;
}

void set_range(const std::vector<brep::Loop>& loops, brep::Face& face) {
  face.low = {1e300, 1e300};
  face.high = {-1e300, -1e300};
  for (const brep::Loop& loop : loops)
    for (const brep::Trim& trim : loop) {
      const AnySpline curve = homogeneous(trim.curve);
      for (int d = 0; d < 2; ++d) {
        const Range range = range_of(curve, d);
        face.low[d] = std::min(face.low[d], range.low);
        face.high[d] = std::max(face.high[d], range.high);
      }
    }
}

}  // namespace geometry_io

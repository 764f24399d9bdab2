// SPDX-License-Identifier: GPL-2.0-or-later
#include "occt_samples.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "point_tree.h"
#include "read_plainly.h"

namespace step_parts::samples {

constexpr double kSpacing = 1.0 / 120.0;  // of samples, over the size
constexpr int kLeast = 6, kMost = 300;    // steps along a parameter
constexpr int kMostSteps = 50, kHalvings = 12;
constexpr double kNoLess = 1e-16;  // of a squared distance

static gp_Pnt pnt(const Point& p) { return {p[0], p[1], p[2]}; }

// One face, or one edge with v of no account.
struct Entity {
  std::unique_ptr<BRepAdaptor_Surface> surface;
  std::unique_ptr<BRepTopAdaptor_FClass2d> domain;
  std::unique_ptr<BRepAdaptor_Curve> curve;
  double low[2], high[2];
  bool goes_round[2] = {false, false};
  double period[2];

  // At an end, or a turn more or less.
  double within(int i, double at) const {
    if (!goes_round[i]) return std::clamp(at, low[i], high[i]);
    return at - period[i] * std::floor((at - low[i]) / period[i]);
  }
};

struct Sample {
  int entity;
  double at[2];
};

struct Place {
  double at[2];
  double square;  // of the distance
};

// Half the squared distance, its slope and its second derivatives.
struct Slope {
  double square, g[2], h[3], gauss[3];
};
static Slope slope_at(const Entity& entity, const double* at, const gp_Pnt& point) {
  gp_Pnt p;
  gp_Vec u, v, uu, vv, uv;
  if (entity.surface)
    entity.surface->D2(at[0], at[1], p, u, v, uu, vv, uv);
  else
    entity.curve->D2(at[0], p, u, uu);
  const gp_Vec r(point, p);
  return {r.SquareMagnitude(),
          {r.Dot(u), r.Dot(v)},
          {u.Dot(u) + r.Dot(uu), u.Dot(v) + r.Dot(uv), v.Dot(v) + r.Dot(vv)},
          {u.Dot(u), u.Dot(v), v.Dot(v)}};
}

static double square_at(const Entity& entity, const double* at, const gp_Pnt& point) {
  return point.SquareDistance(entity.surface ? entity.surface->Value(at[0], at[1])
                                             : entity.curve->Value(at[0]));
}

// Newton's step, where that leads down; else that of Gauss and Newton, or along one parameter.
static bool step_of(const Entity& entity, const Slope& at, double* step) {
  if (entity.curve) {
    const double h = at.h[0] > 0.0 ? at.h[0] : at.gauss[0];
    step[0] = -at.g[0] / h, step[1] = 0.0;
    return h > 0.0;
  }
  for (const double* h : {at.h, at.gauss}) {
    const double det = h[0] * h[2] - h[1] * h[1];
    if (!(h[0] > 0.0 && det > 1e-14 * h[0] * std::abs(h[2]))) continue;
    step[0] = (-at.g[0] * h[2] + at.g[1] * h[1]) / det;
    step[1] = (-at.g[1] * h[0] + at.g[0] * h[1]) / det;
    return true;
  }
  step[0] = at.gauss[0] > 0.0 ? -at.g[0] / at.gauss[0] : 0.0;
  step[1] = at.gauss[2] > 0.0 ? -at.g[1] / at.gauss[2] : 0.0;
  return step[0] != 0.0 || step[1] != 0.0;
}

// Downhill as far as it goes; at an end of a parameter along the other one alone.
static Place descend(const Entity& entity, const Sample& start, const gp_Pnt& point) {
  Place here{{start.at[0], start.at[1]}, square_at(entity, start.at, point)};
  for (int k = 0; k < kMostSteps; ++k) {
    Slope slope = slope_at(entity, here.at, point);
    for (int i = 0; i < 2; ++i) {
      const bool at_end = !entity.goes_round[i] && ((here.at[i] <= entity.low[i] && slope.g[i] > 0.0) ||
                                                    (here.at[i] >= entity.high[i] && slope.g[i] < 0.0));
      if (!at_end) continue;
      slope.g[i] = slope.h[1] = slope.gauss[1] = 0.0;
      slope.h[2 * i] = std::max(slope.h[2 * i], slope.gauss[2 * i]);
    }
    double step[2];
    if (!step_of(entity, slope, step)) break;
    bool lower = false;
    for (int half = 0; half < kHalvings && !lower; ++half) {
      Place next{{here.at[0] + step[0], here.at[1] + step[1]}, 0.0};
      for (int i = 0; i < 2; ++i) next.at[i] = entity.within(i, next.at[i]);
      next.square = square_at(entity, next.at, point);
      lower = next.square < here.square * (1.0 - kNoLess);
      if (lower) here = next;
      step[0] *= 0.5, step[1] *= 0.5;
    }
    if (!lower) break;
  }
  return here;
}

struct Parts {
  std::vector<Entity> entities;
  std::vector<Sample> samples;
  std::vector<Point> points;
  std::vector<double> near;  // how far points of an entity are from its nearest sample, at most
  std::unique_ptr<PointTree> tree;
  double farthest = 0.0;  // of these

  void add_face(const TopoDS_Face& face, double spacing);
  void add_edge(const TopoDS_Edge& edge, double spacing);
  void add(int entity, double u, double v, const gp_Pnt& p) {
    samples.push_back({entity, {u, v}});
    points.push_back({p.X(), p.Y(), p.Z()});
  }
};

// Steps along parameter i, short enough in space.
static int steps_along(const Entity& entity, int i, double spacing) {
  constexpr int kCoarse = 24;
  double longest = 0.0;
  for (int j = 0; j <= kCoarse; ++j)
    for (int k = 0; k < kCoarse; ++k) {
      double at[2][2];
      for (int end = 0; end < 2; ++end) {
        const double part[2] = {static_cast<double>(k + end) / kCoarse, static_cast<double>(j) / kCoarse};
        for (int d = 0; d < 2; ++d) {
          const double share = d == i ? part[0] : part[1];
          at[end][d] = entity.low[d] + share * (entity.high[d] - entity.low[d]);
        }
      }
      const gp_Pnt from = entity.surface->Value(at[0][0], at[0][1]);
      longest = std::max(longest, from.Distance(entity.surface->Value(at[1][0], at[1][1])));
    }
  return std::clamp(static_cast<int>(std::ceil(kCoarse * longest / spacing)), kLeast, kMost);
}

void Parts::add_face(const TopoDS_Face& face, double spacing) {
  const int number = static_cast<int>(entities.size());
  entities.emplace_back();
  Entity& entity = entities.back();
  entity.surface = std::make_unique<BRepAdaptor_Surface>(face);
  entity.domain = std::make_unique<BRepTopAdaptor_FClass2d>(face, 1e-9);
  BRepTools::UVBounds(face, entity.low[0], entity.high[0], entity.low[1], entity.high[1]);
  entity.goes_round[0] = entity.surface->IsUPeriodic(), entity.goes_round[1] = entity.surface->IsVPeriodic();
  if (entity.goes_round[0]) entity.period[0] = entity.surface->UPeriod();
  if (entity.goes_round[1]) entity.period[1] = entity.surface->VPeriod();
  const int n[2] = {steps_along(entity, 0, spacing), steps_along(entity, 1, spacing)};
  double most = 0.0;
  gp_Pnt before;
  for (int i = 0; i <= n[0]; ++i)
    for (int j = 0; j <= n[1]; ++j) {
      const double u = entity.low[0] + (entity.high[0] - entity.low[0]) * i / n[0],
                   v = entity.low[1] + (entity.high[1] - entity.low[1]) * j / n[1];
      const gp_Pnt p = entity.surface->Value(u, v);
      if (j > 0) most = std::max(most, p.Distance(before));
      before = p;
      if (entity.domain->Perform(gp_Pnt2d(u, v)) != TopAbs_OUT) add(number, u, v, p);
    }
  // Its border as the face has it: what is near that may be far from all places of the grid that are inside.
  for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next()) {
    double first, last;
    const Handle(Geom2d_Curve) curve =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(it.Current()), face, first, last);
    if (curve.IsNull()) continue;
    const int steps = 2 * std::max(n[0], n[1]);
    for (int k = 0; k <= steps; ++k) {
      const gp_Pnt2d uv = curve->Value(first + (last - first) * k / steps);
      add(number, uv.X(), uv.Y(), entity.surface->Value(uv.X(), uv.Y()));
    }
  }
  near.push_back(std::max(2.0 * most, 2.0 * spacing));
}

void Parts::add_edge(const TopoDS_Edge& edge, double spacing) {
  if (BRep_Tool::Degenerated(edge)) return;
  const int number = static_cast<int>(entities.size());
  entities.emplace_back();
  Entity& entity = entities.back();
  entity.curve = std::make_unique<BRepAdaptor_Curve>(edge);
  entity.low[0] = entity.curve->FirstParameter(), entity.high[0] = entity.curve->LastParameter();
  entity.low[1] = entity.high[1] = 0.0;
  double length = 0.0;
  gp_Pnt before = entity.curve->Value(entity.low[0]);
  const auto at = [&](int k, int n) { return entity.low[0] + (entity.high[0] - entity.low[0]) * k / n; };
  for (int k = 1; k <= kLeast * kLeast; ++k) {
    const gp_Pnt p = entity.curve->Value(at(k, kLeast * kLeast));
    length += p.Distance(before);
    before = p;
  }
  const int n = std::clamp(static_cast<int>(std::ceil(2.0 * length / spacing)), 2 * kLeast, 4 * kMost);
  for (int k = 0; k <= n; ++k) add(number, at(k, n), 0.0, entity.curve->Value(at(k, n)));
  near.push_back(spacing);
}

}  // namespace step_parts::samples

namespace step_parts {

OcctSamples::OcctSamples(const std::string& file) : parts_(std::make_unique<samples::Parts>()) {
  const TopoDS_Shape shape = read_plainly(file);
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  const double spacing = samples::kSpacing * std::sqrt(box.SquareExtent());
  TopTools_IndexedMapOfShape faces, edges;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int f = 1; f <= faces.Extent(); ++f) parts_->add_face(TopoDS::Face(faces(f)), spacing);
  for (int e = 1; e <= edges.Extent(); ++e) parts_->add_edge(TopoDS::Edge(edges(e)), spacing);
  parts_->tree = std::make_unique<PointTree>(parts_->points);
  parts_->farthest = 2.0 * spacing;
}

OcctSamples::~OcctSamples() = default;

int OcctSamples::count() const { return static_cast<int>(parts_->samples.size()); }

// A point of an entity that is the nearest has a sample of it beside it.  From samples of one entity that are
// close to each other one way down is enough.
OcctSamples::Found OcctSamples::nearest(const Point& point) const {
  thread_local std::vector<std::pair<double, int>> near;
  thread_local std::vector<int> starts;
  near.clear(), starts.clear();
  const gp_Pnt p = samples::pnt(point);
  const double first = parts_->tree->nearest(point);
  parts_->tree->within(point, std::sqrt(first) + parts_->farthest, near);
  std::sort(near.begin(), near.end());
  Found found{std::sqrt(first), false};
  for (const std::pair<double, int>& away : near) {
    const int number = away.second;
    const samples::Sample& sample = parts_->samples[number];
    const auto is_close = [&](int other) {
      return parts_->samples[other].entity == sample.entity &&
             samples::pnt(parts_->points[other]).Distance(samples::pnt(parts_->points[number])) <
                 parts_->near[sample.entity];
    };
    if (std::any_of(starts.begin(), starts.end(), is_close)) continue;
    starts.push_back(number);
    const samples::Entity& entity = parts_->entities[sample.entity];
    const samples::Place place = samples::descend(entity, sample, p);
    const double distance = std::sqrt(place.square);
    if (distance >= found.distance) continue;
    const bool inside = entity.surface != nullptr;
    if (!inside || entity.domain->Perform(gp_Pnt2d(place.at[0], place.at[1])) != TopAbs_OUT)
      found = {distance, inside};
  }
  return found;
}

}  // namespace step_parts

// SPDX-License-Identifier: GPL-2.0-or-later
#include "occt_winding.h"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <Poly_Triangulation.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <functional>

#include "read_plainly.h"

namespace step_parts {

struct OcctWinding::Shapes {
  TopoDS_Shape whole;
  TopTools_IndexedMapOfShape faces, solids;
  double chord = 0.0;
  bool meshed = false;
};

namespace {

constexpr double kTwoPi = 2.0 * M_PI;

double angle_between(const gp_Vec2d& a, const gp_Vec2d& b) { return std::atan2(a.Crossed(b), a.Dot(b)); }

/// Of a face, taken forward.
class Border {
 public:
  Border(const TopoDS_Face& face, const gp_Pnt& point)
      : face_(face), surface_(BRep_Tool::Surface(face)), point_(point) {}

  Winding at(const gp_Pnt2d& uv) {
    double turns = 0.0;
    for (TopExp_Explorer it(face_, TopAbs_EDGE); it.More(); it.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(it.Current());
      if (edge.Orientation() != TopAbs_FORWARD && edge.Orientation() != TopAbs_REVERSED) continue;
      double from, to;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face_, from, to);
      const double angle = swept(*curve, uv, from, curve->Value(from), to, curve->Value(to), 0);
      turns += (edge.Orientation() == TopAbs_FORWARD ? angle : -angle) / kTwoPi;
    }
    return {std::abs(turns) > 0.5, distance_};
  }

 private:
  // Halved until the angle is small beside a turn.
  double swept(const Geom2d_Curve& curve, const gp_Pnt2d& uv, double s, const gp_Pnt2d& from, double t,
               const gp_Pnt2d& to, int depth) {
    constexpr int kLeast = 7, kMost = 45;
    constexpr double kSmall = 0.3;
    const double angle = angle_between(gp_Vec2d(uv, from), gp_Vec2d(uv, to));
    if (depth >= kLeast && (std::abs(angle) < kSmall || depth == kMost)) {
      distance_ = std::min(distance_, surface_->Value(to.X(), to.Y()).Distance(point_));
      return angle;
    }
    const double half = 0.5 * (s + t);
    const gp_Pnt2d middle = curve.Value(half);
    return swept(curve, uv, s, from, half, middle, depth + 1) +
           swept(curve, uv, half, middle, t, to, depth + 1);
  }

  const TopoDS_Face face_;
  const Handle(Geom_Surface) surface_;
  const gp_Pnt point_;
  double distance_ = 1e300;
};

// A. van Oosterom and J. Strackee (1983), IEEE Trans. Biomed. Eng. 30, 125.
double solid_angle(const gp_Vec& a, const gp_Vec& b, const gp_Vec& c) {
  const double la = a.Magnitude(), lb = b.Magnitude(), lc = c.Magnitude();
  return 2.0 * std::atan2(a.DotCross(b, c), la * lb * lc + a.Dot(b) * lc + b.Dot(c) * la + c.Dot(a) * lb);
}

double solid_angle_of(const TopoDS_Face& face, const gp_Pnt& point) {
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
  if (mesh.IsNull()) return 0.0;
  const auto from_point = [&](int node) {
    return gp_Vec(point, mesh->Node(node).Transformed(place.Transformation()));
  };
  double sum = 0.0;
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    int a, b, c;
    mesh->Triangle(i).Get(a, b, c);
    sum += solid_angle(from_point(a), from_point(b), from_point(c));
  }
  return face.Orientation() == TopAbs_REVERSED ? -sum : sum;
}

gp_Pnt pnt(const Point& p) { return {p[0], p[1], p[2]}; }

}  // namespace

OcctWinding::OcctWinding(const std::string& file) : shapes_(std::make_unique<Shapes>()) {
  shapes_->whole = read_plainly(file);
  TopExp::MapShapes(shapes_->whole, TopAbs_FACE, shapes_->faces);
  TopExp::MapShapes(shapes_->whole, TopAbs_SOLID, shapes_->solids);
  Bnd_Box box;
  BRepBndLib::Add(shapes_->whole, box);
  shapes_->chord = 1e-4 * std::sqrt(box.SquareExtent());
}

OcctWinding::~OcctWinding() = default;

double OcctWinding::chord() const { return shapes_->chord; }

std::array<double, 2> OcctWinding::parameters(int face, const Point& point) const {
  const TopoDS_Face& shape = TopoDS::Face(shapes_->faces(face + 1));
  const gp_Pnt2d uv = ShapeAnalysis_Surface(BRep_Tool::Surface(shape)).ValueOfUV(pnt(point), 1e-9);
  return {uv.X(), uv.Y()};
}

Winding OcctWinding::in_face(int face, const Point& point) const {
  const TopoDS_Face shape = TopoDS::Face(shapes_->faces(face + 1).Oriented(TopAbs_FORWARD));
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(shape);
  const auto [u, v] = parameters(face, point);
  Border border(shape, pnt(point));
  Winding result{false, 1e300};
  const int nu = surface->IsUPeriodic() ? 2 : 0, nv = surface->IsVPeriodic() ? 2 : 0;
  for (int i = -nu; i <= nu; ++i)
    for (int j = -nv; j <= nv; ++j) {
      const Winding one = border.at(
          {u + (nu > 0 ? i * surface->UPeriod() : 0.0), v + (nv > 0 ? j * surface->VPeriod() : 0.0)});
      result = {result.inside || one.inside, one.distance};
    }
  return result;
}

bool OcctWinding::in_solid(int solid, const Point& point) const {
  constexpr double kAngle = 0.2;  // rad
  if (!shapes_->meshed) BRepMesh_IncrementalMesh(shapes_->whole, shapes_->chord, false, kAngle);
  shapes_->meshed = true;
  double sum = 0.0;
  for (TopExp_Explorer it(shapes_->solids(solid + 1), TopAbs_FACE); it.More(); it.Next())
    sum += solid_angle_of(TopoDS::Face(it.Current()), pnt(point));
  return std::abs(sum) > kTwoPi;  // half of all directions
}

}  // namespace step_parts

// SPDX-License-Identifier: GPL-2.0-or-later
#include "opencascade.h"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <limits>

namespace benchmarks {
namespace {

using nurbs::Vector3;

struct Knots {
  explicit Knots(const nurbs::KnotVector& knots)
      : values(1, knots.element_count() + 1), multiplicities(1, knots.element_count() + 1) {
    for (int i = 0; i <= knots.element_count(); ++i) values(i + 1) = knots.breaks()[i];
    multiplicities.Init(1);
    multiplicities.ChangeFirst() = multiplicities.ChangeLast() = knots.degree() + 1;
  }
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
};

Handle(Geom_BSplineSurface) converted(const nurbs::Surface& surface) {
  const nurbs::Space<2>& space = surface.space;
  const int n_xi = space.control_point_count(0), n_eta = space.control_point_count(1);
  TColgp_Array2OfPnt poles(1, n_xi, 1, n_eta);
  TColStd_Array2OfReal weights(1, n_xi, 1, n_eta);
  for (int a = 0; a < space.control_point_count(); ++a) {
    const auto x = surface.control_points.col(a);
    poles(1 + a % n_xi, 1 + a / n_xi) = gp_Pnt(x.x(), x.y(), x.z());
    weights(1 + a % n_xi, 1 + a / n_xi) = space.weight(a);
  }
  const Knots u(space.knots(0)), v(space.knots(1));
  return new Geom_BSplineSurface(poles, weights, u.values, v.values, u.multiplicities, v.multiplicities,
                                 space.degree(0), space.degree(1));
}

Vector3 vector(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

const Vector3 kFailed = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());

}  // namespace

OpenCascade::OpenCascade(const nurbs::Surface& surface)
    : surface_(converted(surface)), adaptor_(surface_), local_(adaptor_) {
  const auto &u = surface.space.knots(0), &v = surface.space.knots(1);
  global_.Init(surface_, u.front(), u.back(), v.front(), v.back(), Extrema_ExtAlgo_Tree);
  global_.SetExtremaFlag(Extrema_ExtFlag_MIN);
}

Vector3 OpenCascade::warm(const Vector3& d, const nurbs::Parameter<2>& guess) {
  local_.Perform(gp_Pnt(d.x(), d.y(), d.z()), guess[0], guess[1]);
  return local_.IsDone() ? vector(local_.Point().Value()) : kFailed;
}

Vector3 OpenCascade::cold(const Vector3& d) {
  global_.Perform(gp_Pnt(d.x(), d.y(), d.z()));
  return global_.NbPoints() > 0 ? vector(global_.NearestPoint()) : kFailed;
}

}  // namespace benchmarks

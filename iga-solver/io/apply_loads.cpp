// SPDX-License-Identifier: GPL-2.0-or-later
// From the loads of a model file to those of a solver: what is constant in one vector, the rest one by one.
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "io/load_keys.h"
#include "structure/conditions/columns.h"
#include "structure/conditions/loads.h"
#include "structure/conditions/pressure.h"

namespace io {

using structure::ExplicitSolver;
using structure::NodalVectors;

namespace {

/// On all ranks alike, though one alone may see what is not; collective.
void expect_finite(const NodalVectors& values, const std::string& place, const structure::Halo& halo) {
  if (halo.any(!values.allFinite()))
    throw geometry_io::InputError(
        fmt::format("{}: the expression is not finite somewhere on the solid, expected numbers", place));
}

class Applied {
 public:
  Applied(const geometry_io::GeometryFile& geometry, const structure::NodeNumbering& nodes,
          ExplicitSolver& solver)
      : geometry_(geometry), nodes_(nodes), solver_(solver), columns_(solver.node_ids()), dead_(none()) {}
  ~Applied() = default;
  Applied(const Applied&) = delete;

  void gravity(const Gravity& gravity) {
    take(gravity.value * solver_.mass().nodal_mass().transpose(), gravity.time);
  }
  void traction(const FaceLoad& load);
  void pressure(const FaceLoad& load) {
    solver_.add_load(std::make_unique<structure::FollowingPressure>(solver_.body(), skin(load),
                                                                    load.value.field, load.time),
                     "of " + load.value.place);
  }
  void line(const LineLoad& load) {
    NodalVectors f = none();
    structure::add_line_load(volume(load.patch), node_ids(nodes_, load.patch), load.faces, load.value.field,
                             columns_, f);
    take(f, load.time, load.value.place);
  }
  void point(const PointLoad& load) {
    NodalVectors f = none();
    structure::add_point_load(load.point, load.force, columns_, f);
    take(f, load.time);
  }
  void body_force(const BodyForce& load) {
    NodalVectors f = none();
    for (std::size_t patch = 0; patch < geometry_.patches.size(); ++patch)
      structure::add_body_force(volume(patch), node_ids(nodes_, static_cast<int>(patch)), load.value.field,
                                columns_, f);
    take(f, load.time, load.value.place);
  }
  const NodalVectors& dead() const { return dead_; }

 private:
  NodalVectors none() const { return NodalVectors::Zero(3, solver_.body().node_count()); }
  structure::SkinSurface skin(const FaceLoad& load) const { return skin_of(geometry_, nodes_, load.piece); }
  const nurbs::Volume& volume(std::size_t patch) const {
    return std::get<nurbs::Volume>(geometry_.patches[patch]);
  }
  void take(const NodalVectors& f, const structure::TimeFunction& time, const std::string& place = "") {
    expect_finite(f, place, solver_.halo());
    if (time)
      solver_.add_load(std::make_unique<structure::FactoredLoad>(f, time));
    else
      dead_ += f;
  }

  const geometry_io::GeometryFile& geometry_;
  const structure::NodeNumbering& nodes_;
  ExplicitSolver& solver_;
  structure::Columns columns_;
  NodalVectors dead_;
};

void Applied::traction(const FaceLoad& load) {
  const std::vector<structure::Id>& nodes = solver_.node_ids();
  const FieldKey& value = load.value;
  NodalVectors f = none();
  if (value.changes) {
    solver_.add_load(std::make_unique<structure::FieldTraction>(structure::SkinQuadrature(skin(load), nodes),
                                                                value.field, load.time),
                     "of " + value.place);
    return;
  }
  if (value.is_uniform)
    structure::add_traction_load(skin(load), value.field(Vector3::Zero(), 0.0), columns_, f);
  else
    structure::SkinQuadrature(skin(load), nodes)
        .integrate([&](const Vector3& X) { return value.field(X, 0.0); }, f);
  take(f, load.time, value.place);
}

}  // namespace

void apply_loads(const Loads& loads, const geometry_io::GeometryFile& geometry,
                 const structure::NodeNumbering& nodes, ExplicitSolver& solver) {
  Applied applied(geometry, nodes, solver);
  if (loads.gravity) applied.gravity(*loads.gravity);
  for (const FaceLoad& load : loads.tractions) applied.traction(load);
  for (const FaceLoad& load : loads.pressures) applied.pressure(load);
  for (const LineLoad& load : loads.lines) applied.line(load);
  for (const PointLoad& load : loads.points) applied.point(load);
  if (loads.body_force) applied.body_force(*loads.body_force);
  solver.set_load(applied.dead());
}

NodalVectors velocities_of(const FieldKey& velocity, const ExplicitSolver& solver) {
  const NodalVectors& X = solver.body().reference();
  NodalVectors v = NodalVectors::Zero(3, X.cols());
  for (Eigen::Index A = 0; A < solver.halo().held(X.cols()); ++A) v.col(A) = velocity.field(X.col(A), 0.0);
  expect_finite(v, velocity.place, solver.halo());
  return v;
}

}  // namespace io

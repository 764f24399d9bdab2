// SPDX-License-Identifier: GPL-2.0-or-later
// The keys `loads` and `initial` of a model file.  README.md of this folder has an example of each.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "io/expression.h"
#include "io/selection.h"
#include "structure/conditions/probe.h"
#include "structure/time/explicit_solver.h"

namespace io {

/// A value on a face: traction [force/length^2], or a pressure in x of the field.
struct FaceLoad {
  structure::SkinPiece piece;
  FieldKey value;
  structure::TimeFunction time;
};

struct PointLoad {
  structure::Probe point;
  Vector3 force;  ///< [force]
  structure::TimeFunction time;
};

/// On the edge where two faces of a patch meet [force/length].
struct LineLoad {
  int patch;
  std::array<nurbs::Face, 2> faces;
  FieldKey value;
  structure::TimeFunction time;
};

struct Gravity {
  Vector3 value = Vector3::Zero();  ///< [length/time^2]
  bool of_the_deck = false;         ///< which is to set it
  structure::TimeFunction time = {};
};

/// [force/length^3], of all patches.
struct BodyForce {
  FieldKey value;
  structure::TimeFunction time;
};

struct Loads {
  std::optional<Gravity> gravity = {};
  std::vector<FaceLoad> tractions = {}, pressures = {};
  std::vector<LineLoad> lines = {};
  std::vector<PointLoad> points = {};
  std::optional<BodyForce> body_force = {};
};

/// Throws geometry_io::InputError.
Loads read_loads(const geometry_io::YamlMap& map, const geometry_io::GeometryFile& geometry,
                 const structure::NodeNumbering& nodes);
/// The key `velocity` of `initial` [length/time]: of control points, at their places.
FieldKey read_initial_velocity(const geometry_io::YamlMap& map);

/// Gives a solver these loads.  Throws geometry_io::InputError if an expression is not finite somewhere.
/// Collective.
void apply_loads(const Loads& loads, const geometry_io::GeometryFile& geometry,
                 const structure::NodeNumbering& nodes, structure::ExplicitSolver& solver);
/// The nodal velocities, 3 x n; likewise.
structure::NodalVectors velocities_of(const FieldKey& velocity, const structure::ExplicitSolver& solver);

}  // namespace io

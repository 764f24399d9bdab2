// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_nurbs_checks.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "advised_size.h"
#include "coupling/model_text.h"
#include "fix_gravity.h"
#include "fix_property_global.h"
#include "modify.h"
#include "update.h"
#include "wall_nurbs_setup.h"

namespace liggghts_pkg {

namespace {

/// `round_off`: of a constant that may be 0.
void check_property(LAMMPS_NS::Modify& modify, const char* property, int wall_type, double model_value,
                    double round_off, const std::string& file) {
  LAMMPS_NS::Fix* fix =
      modify.find_fix_property(property, "property/global", "peratomtype", 0, 0, "wall/nurbs", false);
  if (!fix) return;  // the contact model does not use it
  const double deck_value = static_cast<LAMMPS_NS::FixPropertyGlobal*>(fix)->get_values()[wall_type - 1];
  if (std::abs(deck_value - model_value) > std::max(1e-6 * std::abs(model_value), round_off))
    throw std::invalid_argument(fmt::format(
        "{} of atom type {} is {:.10g} in the deck but {:.10g} in '{}'; make them equal, or write 'material "
        "independent' to keep both",
        property, wall_type, deck_value, model_value, file));
}

// LIGGGHTS tells a gravity's value, but not whether it is one for ever.
struct DeckGravity : LAMMPS_NS::FixGravity {
  static bool varies(const LAMMPS_NS::FixGravity& gravity) { return gravity.*(&DeckGravity::varflag) != 0; }
};

// Each fix integrates a solid of its own.
void refuse_second_solid(MPI_Comm world, const WallNurbsOptions& options, const WallNurbsOptions& other,
                         const char* other_id) {
  if (options.body != WallNurbsOptions::Body::iga || other.body != WallNurbsOptions::Body::iga) return;
  if (coupling::is_same_file(world, options.file, other.file))
    throw std::invalid_argument(fmt::format(
        "'{}' is the structure of fix {} already, and two fixes would make two solids of it; for several "
        "faces of one solid name one surface, as in 'surfaces: {{skin: [0 zeta-, 0 zeta+]}}', for two "
        "solids copy the file",
        options.file, other_id));
}

// Each fix would replace the other's files.
void refuse_shared_output(const WallNurbsOptions& options, const WallNurbsOptions& other,
                          const char* other_id) {
  const auto normal = [](const std::string& file) { return std::filesystem::path(file).lexically_normal(); };
  const auto refuse = [&](const char* word, const std::string& mine, const std::string& others,
                          const char* ending) {
    if (!mine.empty() && !others.empty() && normal(mine) == normal(others))
      throw std::invalid_argument(
          fmt::format("{} '{}': {}{} is being written by fix {}, expected another name", word, mine, mine,
                      ending, other_id));
  };
  refuse("output", options.output.file, other.output.file, ".pvd");
  refuse("stl", options.stl.file, other.stl.file, "_<step>.stl");
}

}  // namespace

void check_other_walls(const LAMMPS_NS::Modify& modify, MPI_Comm world, const WallNurbsOptions& options) {
  for (int i = 0; i < modify.nfix; ++i) {
    const auto* const other = dynamic_cast<const LAMMPS_NS::WallNurbsSetup*>(modify.fix[i]);
    if (!other) continue;
    refuse_second_solid(world, options, other->options(), modify.fix[i]->id);
    refuse_shared_output(options, other->options(), modify.fix[i]->id);
  }
}

void check_run_style(const LAMMPS_NS::Update& update) {
  constexpr int kMinimize = 2;
  if (update.whichflag == kMinimize) throw std::invalid_argument("minimize is not supported; use run");
  if (std::strstr(update.integrate_style, "respa"))
    throw std::invalid_argument("run_style respa is not supported; use run_style verlet");
}

void check_wall_material(LAMMPS_NS::Modify& modify, int wall_type,
                         const std::vector<coupling::SurfaceMaterial>& materials, const std::string& file) {
  if (materials.size() > 1)
    throw std::invalid_argument(fmt::format(
        "the surface lies on {} materials in '{}' (Young's moduli {:.6g}, {:.6g}, Poisson's ratios {:.6g}, "
        "{:.6g}), and contact laws have one of the wall: use a wall for each, or write 'material "
        "independent' to have the deck's for all",
        materials.size(), file, materials[0].youngs_modulus, materials[1].youngs_modulus,
        materials[0].poissons_ratio, materials[1].poissons_ratio));
  constexpr double kRoundOff = 1e-9;  // of the mean of an anisotropic law
  for (const coupling::SurfaceMaterial& material : materials) {
    check_property(modify, "youngsModulus", wall_type, material.youngs_modulus, 0.0, file);
    check_property(modify, "poissonsRatio", wall_type, material.poissons_ratio, kRoundOff, file);
  }
}

namespace {

struct Gravities {
  coupling::Vector3 sum = coupling::Vector3::Zero();
  std::vector<std::string> ids;
  bool varies = false;
};

Gravities gravities_of(const LAMMPS_NS::Modify& modify) {
  Gravities all;
  for (int i = 0; i < modify.nfix; ++i) {
    if (std::strcmp(modify.fix[i]->style, "gravity") != 0) continue;
    auto* const gravity = static_cast<LAMMPS_NS::FixGravity*>(modify.fix[i]);
    double g[3];
    gravity->get_gravity(g);
    all.sum += coupling::Vector3::Map(g);
    all.ids.emplace_back(gravity->id);
    all.varies |= DeckGravity::varies(*gravity);
  }
  return all;
}

}  // namespace

void give_gravity(const LAMMPS_NS::Modify& modify, coupling::StructureSolver& structure,
                  const std::string& file) {
  if (!structure.takes_gravity_of_deck()) return;
  const Gravities deck = gravities_of(modify);
  if (deck.varies)
    throw std::invalid_argument(
        fmt::format("fix gravity (id {}) varies, and '{}' has 'gravity: deck', expected a constant one, or a "
                    "vector there",
                    fmt::join(deck.ids, ", "), file));
  structure.set_gravity(deck.sum);
}

std::string missing_gravity(const LAMMPS_NS::Modify& modify, const coupling::StructureSolver& structure,
                            const std::string& file) {
  if (!structure.deforms()) return "";
  const auto [sum, ids, varies] = gravities_of(modify);
  if (structure.takes_gravity_of_deck() && ids.empty())
    return fmt::format(
        "'{}' has 'gravity: deck', and the deck no fix gravity, so nothing pulls the solid: expected one "
        "before the run, or 'gravity: [0, 0, 0]' if that is meant",
        file);
  if (structure.gravity()) return "";
  const std::string whose = fmt::format("fix gravity (id {}) acts on particles alone", fmt::join(ids, ", "));
  if (varies)
    return fmt::format(
        "{}; it varies, so that the solid in '{}' cannot have it: if that is meant add the line 'loads: "
        "{{gravity: [0, 0, 0]}}' to that file",
        whose, file);
  if (sum[0] == 0.0 && sum[1] == 0.0 && sum[2] == 0.0) return "";
  return fmt::format(
      "{}; for the solid add the line 'loads: {{gravity: [{:.10g}, {:.10g}, {:.10g}]}}' to '{}', or this "
      "gravity to the loads that it has; [0, 0, 0] if the solid shall have none",
      whose, sum[0] + 0.0, sum[1] + 0.0, sum[2] + 0.0, file);
}

std::vector<std::string> alarms_of_run(const contact::ContactLoop& loop, double dt, MPI_Comm world) {
  const contact::RunAlarm inside = loop.inside().of_all_ranks(world),
                          crossing = loop.crossing().of_all_ranks(world),
                          stiff = loop.stiff().of_all_ranks(world), brief = loop.brief().of_all_ranks(world);
  std::vector<std::string> alarms;
  if (inside.count > 0)
    alarms.push_back(fmt::format(
        "the centre of particle {} got inside the solid ({} contacts of this kind in this run): use a "
        "smaller timestep or a stiffer contact",
        inside.tag, inside.count));
  if (crossing.count > 0) {
    constexpr double kFraction = 0.1;  // of the radius, per step
    const double slow_enough = kFraction * crossing.radius / crossing.speed;
    alarms.push_back(fmt::format(
        "the centre of particle {} would cross the wall within one step, at a speed of {:.6g} towards it ({} "
        "cases of this kind in this run): {}",
        crossing.tag, crossing.speed, crossing.count,
        slow_enough < dt
            ? fmt::format("use a timestep of at most {:.3g}", slow_enough)
            : "its contact does not hold it, use a stiffer one or less cohesion; or it began inside "
              "a solid, where it feels nothing until it comes out: is the part the void?"));
  }
  if (stiff.count > 0)
    alarms.push_back(
        fmt::format("the contact of particle {} and the solid together may be unstable ({} cases of this "
                    "kind in this run): they are not with a timestep of at most {:.3g}",
                    stiff.tag, stiff.count, 2.0 / stiff.speed));
  if (brief.count > 0)
    alarms.push_back(
        fmt::format("the contact of particle {} lasts about {:.3g} ({} cases of this kind in this run), too "
                    "short for the modes that the solid keeps, which it finds too stiff: keep more of them",
                    brief.tag, 1.0 / brief.speed, brief.count));
  return alarms;
}

std::string alarm_of_mesh(const contact::ContactLoop& loop, bool can_be_corrected, MPI_Comm world) {
  const contact::MeshAlarm uncorrected = loop.uncorrected().of_all_ranks(world),
                           turning = loop.turning().of_all_ranks(world),
                           kinked = loop.kinked().of_all_ranks(world),
                           not_static = loop.not_static().of_all_ranks(world);
  constexpr double kMost = contact::ContactLoop::kMissing;
  const auto place = [](const contact::MeshAlarm& alarm) {
    return fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g})", alarm.tag, alarm.foot[0], alarm.foot[1],
                       alarm.foot[2]);
  };
  if (uncorrected.count > 0)
    return fmt::format(
        "elements of size {:.3g} give way under {} by what its contact law has counted already: about {:.1f} "
        "% of the force is missing ({} contacts above {:g} % in this run); use {}elements of at least {:.3g} "
        "there",
        uncorrected.size, place(uncorrected), 100.0 * uncorrected.value, uncorrected.count, 100.0 * kMost,
        can_be_corrected ? "'compliance corrected', or " : "",
        rounded_up(uncorrected.size * uncorrected.value / kMost));
  if (turning.count > 0)
    return fmt::format(
        "elements of size {:.3g} are so small beside the contact of {} that they turn below it ({} contacts "
        "of this kind in this run): its force may be wrong by some per cent; use elements of at least {:.3g} "
        "there",
        turning.size, place(turning), turning.count,
        rounded_up(turning.size * std::cbrt(turning.value / contact::ContactLoop::kTurning)));
  if (kinked.count > 0)
    return fmt::format(
        "the mesh kinks below the contact of {}, at a weld or C0 knot where control points do not run on "
        "from "
        "side to side ({} contacts of this kind in this run): its force may be wrong by more than {:.1f} %, "
        "and a particle that moves across gain energy; let rows of control points go straight across there, "
        "or use larger elements than of {:.3g}",
        place(kinked), kinked.count, 100.0 * kinked.value, kinked.size);
  if (not_static.count > 0)
    return fmt::format(
        "the contact of {} is too short for 'compliance corrected', which is static: it lasts {:.2g} of what "
        "a "
        "shear wave takes through three elements of size {:.3g} ({} contacts of this kind in this run), so "
        "that "
        "some of the {:.2g} % of its force that is corrected is not missing; use elements of at most {:.3g} "
        "there, or 'compliance none'",
        place(not_static), 1.0 / not_static.value, not_static.size, not_static.count,
        100.0 * not_static.share, rounded_down(not_static.size / not_static.value));
  return "";
}

}  // namespace liggghts_pkg

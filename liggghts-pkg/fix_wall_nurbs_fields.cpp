// SPDX-License-Identifier: GPL-2.0-or-later
// fix wall/nurbs: fields on the surface for ParaView, and the triangle twin for fix mesh/surface.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <filesystem>

#include "atom.h"
#include "coupling/all_or_none.h"
#include "coupling/finnie.h"
#include "fix_property_global.h"
#include "fix_wall_nurbs.h"
#include "modify.h"
#include "nurbs/memory.h"
#include "update.h"

using namespace LAMMPS_NS;
using nurbs::Vector3;

void FixWallNurbs::open_output() {
  if (options_.output.file.empty()) return;
  refuse_shared_output();
  output_ =
      std::make_unique<liggghts_pkg::WallOutput>(world, options_.output, surface_, exchange_.positions());
  nevery = output_->every();
}

// Each fix would replace the other's files.
void FixWallNurbs::refuse_shared_output() const {
  const auto normal = [](const std::string& file) { return std::filesystem::path(file).lexically_normal(); };
  for (int i = 0; i < modify->nfix; ++i) {
    const auto* const other = dynamic_cast<const FixWallNurbs*>(modify->fix[i]);
    if (other && other->output_ && normal(options_.output.file) == normal(other->options_.output.file))
      fail(fmt::format("output '{}': {}.pvd is being written by fix {}, expected another name",
                       options_.output.file, options_.output.file, other->id));
  }
}

void FixWallNurbs::init_wear() {
  if (!output_ || !output_->tracks_wear()) return;
  const int types = atom->ntypes;
  Fix* constants =
      modify->find_fix_property("k_finnie", "property/global", "peratomtypepair", types, types, style, false);
  if (!constants)
    fail(
        fmt::format("field wear needs Finnie's constants [1/pressure], expected 'fix ID all property/global "
                    "k_finnie peratomtypepair {0} ...' with {0} x {0} numbers in the deck",
                    types));
  k_finnie_ = static_cast<FixPropertyGlobal*>(constants)->get_array();
}

// In space: `delta` from the foot to the centre, F the force on the particle.
void FixWallNurbs::tell_output(int i, const nurbs::SurfacePoint& foot, const Vector3& delta, const Vector3& F,
                               const Vector3& v_wall) {
  const Vector3 normal = delta.normalized();
  double worn_volume = 0.0;
  if (output_->tracks_wear()) {
    const double k = k_finnie_[atom_type_wall_ - 1][atom->type[i] - 1];
    const Vector3 v = Vector3::Map(atom->v[i]) - v_wall;
    worn_volume = dt_ * coupling::finnie_wear_rate(v, normal, F.norm(), k);
  }
  const Eigen::Matrix3d to_body = frame_.rotation.transpose();
  output_->add({foot, -(to_body * F), to_body * normal, worn_volume});
}

void FixWallNurbs::end_of_step() {
  try {
    output_->write(update->ntimestep, update->get_cur_time(), exchange_.positions(), frame_);
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
}

/* ----------------------------------------------------------------------
   fix mesh/surface ... fix ID: this wall in triangles, as it stands when that fix is created
------------------------------------------------------------------------- */

// LIGGGHTS keeps more than a kilobyte of each triangle, on every rank; one may have less memory than another.
void FixWallNurbs::check_twin_size() const {
  constexpr double kBytesPerTriangle = 1500.0;
  const double triangles = 2.0 * options_.twin * options_.twin * surface_.element_count();
  try {
    coupling::on_every_rank(world, options_.file, [&] {
      nurbs::expect_memory(kBytesPerTriangle * triangles,
                           fmt::format("twin {} of a wall of {} elements: {:.3g} triangles", options_.twin,
                                       surface_.element_count(), triangles));
      return true;
    });
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
}

int FixWallNurbs::getCreateMeshTriCount() {
  check_twin_size();
  twin_ = nurbs::tessellate(nurbs::split(surface_, exchange_.positions()), options_.twin);
  const coupling::RigidFrame frame = structure_.frame();
  twin_.vertices = (frame.rotation * twin_.vertices).colwise() + frame.origin;
  return static_cast<int>(twin_.triangles.size());
}

double* FixWallNurbs::getCreateMeshTriNode(const int i) {
  return twin_.vertices.col(twin_.triangles[i / 3][i % 3]).data();
}

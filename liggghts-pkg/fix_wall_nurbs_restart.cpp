// SPDX-License-Identifier: GPL-2.0-or-later
// fix wall/nurbs: one solid for each fix, and what goes into restart files: the structure's state with what
// it belongs to, the surface fields; contact memory restarts with its fix property/atom.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "coupling/all_or_none.h"
#include "coupling/model_text.h"
#include "fix_wall_nurbs.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;
using liggghts_pkg::WallNurbsOptions;
using liggghts_pkg::WallState;

// Each fix integrates a solid of its own.
void FixWallNurbs::refuse_second_solid() const {
  if (options_.body != WallNurbsOptions::Body::iga) return;
  for (int i = 0; i < modify->nfix; ++i) {
    const auto* const other = dynamic_cast<const FixWallNurbs*>(modify->fix[i]);
    if (!other || other->options_.body != WallNurbsOptions::Body::iga) continue;
    if (coupling::is_same_file(world, options_.file, other->options_.file))
      fail(fmt::format(
          "'{}' is the structure of fix {} already, and two fixes would make two solids of it; for several "
          "faces of one solid name one surface, as in 'surfaces: {{skin: [0 zeta-, 0 zeta+]}}', for two "
          "solids copy the file",
          options_.file, other->id));
  }
}

/* ---------------------------------------------------------------------- */

WallState::Origin FixWallNurbs::origin() const {
  coupling::Fingerprint fingerprint = structure_.fingerprint();
  fingerprint.push_back(coupling::word_part("units", geometry_io::units_name(opened_.units)));
  return {std::move(fingerprint), options_.slots, dnum_};
}

void FixWallNurbs::write_restart(FILE* file) {
  const std::vector<double> fields = output_ ? output_->save(update->get_cur_time()) : std::vector<double>();
  const std::vector<double> all = liggghts_pkg::pack({structure_.save(), fields, origin()});
  try {
    const int bytes = liggghts_pkg::restart_bytes(all.size());
    coupling::on_first_rank(world, [&] {
      if (std::fwrite(&bytes, sizeof(int), 1, file) != 1 ||
          std::fwrite(all.data(), sizeof(double), all.size(), file) != all.size() || std::fflush(file) != 0)
        throw std::runtime_error(fmt::format(
            "cannot write its {} bytes to the restart file: {}; make room, or write the file elsewhere",
            bytes, std::strerror(errno)));
    });
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
}

void FixWallNurbs::restart(char* buffer) {
  try {
    const WallState state = liggghts_pkg::unpack_wall_state(buffer);
    if (state.origin)
      liggghts_pkg::check_origin(*state.origin, origin(), options_.file);
    else
      warn(fmt::format(
          "an older version wrote the restart file, which does not tell whether it belongs to the "
          "geometry, mesh, material and supports of '{}', nor to these contact models",
          options_.file));
    structure_.load(state.structure);
    if (output_ && !state.fields.empty()) output_->load(state.fields, update->ntimestep);
    if (!output_ && !state.fields.empty())
      warn("wear and fields in the restart file are not taken: the fix has no 'output'");
  } catch (const std::exception& problem) {
    fail(problem.what());
  }
  state_taken_ = true;
  import_surface();
}

// LIGGGHTS hands a state to the fix of the same ID, and to nobody if there is none.
void FixWallNurbs::note_restart_data() {
  for (int k = 0; k < modify->n_restart_data_global_style(style); ++k)
    ids_with_state_.emplace_back(modify->id_restart_data_global_style(style, k));
}

void FixWallNurbs::warn_of_state_not_taken() {
  for (const std::string& other : ids_with_state_)
    if (!state_taken_ && modify->find_fix(other.c_str()) < 0)
      warn(
          fmt::format("the restart file holds pose, structure and contact history of a wall with the ID {0}, "
                      "which no fix has taken, and nothing for {1}: this wall starts anew; name it {0} if it "
                      "is the same",
                      other, id));
  ids_with_state_.clear();
}

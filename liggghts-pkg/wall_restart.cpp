// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_restart.h"

#include <fmt/format.h>

#include <stdexcept>

#include "lammps.h"
#include "modify.h"
#include "update.h"

namespace liggghts_pkg {

std::vector<double> WallRestart::fields(const WallOutput* output) const {
  return output ? output->save(lmp_->update->get_cur_time()) : std::vector<double>();
}

void WallRestart::reserve(const WallState::Origin& origin, const WallOutput* output) {
  constexpr std::size_t kMayGrowBy = 1000;  // motions that `fix_modify` adds to a rigid wall
  const std::size_t now =
      structure_.state_size() + exchange_.state_size() + pack({{}, fields(output), {}, origin}).size();
  blocks_.reserve(2 * now + kMayGrowBy);  // within an outer step a solid saves 18 for 9 numbers
}

void WallRestart::write(std::FILE* file, const WallState::Origin& origin, const WallOutput* output) {
  write_block(lmp_->world, file,
              blocks_.split(pack({structure_.save(), fields(output), exchange_.save(), origin})));
}

void WallRestart::read(const char* buffer, const WallState::Origin& origin, WallOutput* output) {
  const std::vector<double> joined = blocks_.joined(buffer);
  const WallState state =
      joined.empty() ? unpack_wall_state(buffer)
                     : unpack_wall_state(reinterpret_cast<const char*>(joined.data()), joined.size());
  if (state.origin)
    check_origin(*state.origin, origin, file_);
  else if (structure_.local_compliance())
    throw std::invalid_argument(
        "an older version wrote the restart file, whose contacts are not corrected by what the mesh gives "
        "way; use 'compliance none', or give the fix another ID, which starts the wall anew");
  else
    messages_.warn(
        fmt::format("an older version wrote the restart file, which does not tell whether it belongs to the "
                    "geometry, mesh, material and supports of '{}', nor to these contact models",
                    file_));
  structure_.load(state.structure);
  if (!state.contacts.empty()) exchange_.load(state.contacts);
  if (output && !state.fields.empty()) output->load(state.fields, lmp_->update->ntimestep);
  if (!output && !state.fields.empty())
    messages_.warn("wear and fields in the restart file are not taken: the fix has no 'output'");
  taken_ = true;
}

void WallRestart::note_walls_in_file(const char* style) {
  LAMMPS_NS::Modify& modify = *lmp_->modify;
  for (int k = 0; k < modify.n_restart_data_global_style(const_cast<char*>(style)); ++k)
    walls_in_file_.emplace_back(modify.id_restart_data_global_style(const_cast<char*>(style), k));
}

void WallRestart::warn_of_state_not_taken() {
  for (const std::string& other : walls_in_file_)
    if (!taken_ && lmp_->modify->find_fix(other.c_str()) < 0)
      messages_.warn(
          fmt::format("the restart file holds pose, structure and contact history of a wall with the ID {0}, "
                      "which no fix has taken, and nothing for {1}: this wall starts anew; name it {0} if it "
                      "is the same",
                      other, id_));
  walls_in_file_.clear();
}

}  // namespace liggghts_pkg

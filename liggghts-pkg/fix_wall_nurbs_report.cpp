// SPDX-License-Identifier: GPL-2.0-or-later
// Who reads contacts one by one: those who take the local array; compute wall/gran/local of LIGGGHTS, which
// knows walls of triangles, and how it comes to know ours.
#include <cstddef>

#include "atom.h"
#include "compute_pair_gran_local.h"
#include "compute_reduce.h"
#include "dump_local.h"
#include "fix_wall_nurbs.h"
#include "modify.h"
#include "output.h"
#include "setting.h"
#include "update.h"

using namespace LAMMPS_NS;

std::vector<FixWallNurbs*> FixWallNurbs::walls_of_deck() const {
  std::vector<FixWallNurbs*> walls;
  for (int i = 0; i < modify->nfix; ++i)
    if (auto* const wall = dynamic_cast<FixWallNurbs*>(modify->fix[i])) walls.push_back(wall);
  return walls;
}

// The compute looks for a wall of style mesh, of which LIGGGHTS allows one in a deck: where there is none
// ours say that they are.
bool FixWallNurbs::may_pose_as_mesh() const {
  for (int i = 0; i < modify->nfix; ++i) {
    const auto* const wall = dynamic_cast<FixWallGran*>(modify->fix[i]);
    if (wall && wall->is_mesh_wall() && !dynamic_cast<const FixWallNurbs*>(wall)) return false;
  }
  return true;
}

// These read a fix's local array without asking it for one; whatever else they read, it is made for them.
bool FixWallNurbs::may_be_read_locally() const {
  for (int k = 0; k < output->ndump; ++k)
    if (dynamic_cast<DumpLocal*>(output->dump[k])) return true;
  for (int k = 0; k < modify->ncompute; ++k)
    if (dynamic_cast<ComputeReduce*>(modify->compute[k])) return true;
  return false;
}

void FixWallNurbs::show_local_rows() {
  array_local = columns_.local_rows();
  size_local_rows = static_cast<int>(loop_.contacts().size());
}

// It knows one wall, and takes the contacts of all.
void FixWallNurbs::post_force_pgl() {
  const std::vector<FixWallNurbs*> walls = walls_of_deck();
  std::size_t count = 0;
  for (const FixWallNurbs* wall : walls) count += wall->loop_.contacts().size();
  liggghts_pkg::ContactReport rows(*cwl_, static_cast<int>(count), dnum_);
  for (std::size_t k = 0; k < walls.size(); ++k) walls[k]->report(rows, static_cast<int>(k), cwl_);
  cwl_->pair_finalize();
}

// As LIGGGHTS' walls do: the models are asked once more, with velocities as they are when the compute is;
// what they remember, the particles' forces and heat stay as they are.
void FixWallNurbs::report(liggghts_pkg::ContactReport& rows, int number, ComputePairGranLocal* compute) {
  const bool gives_heat = heattransfer_flag_;
  const liggghts_pkg::Setting<int> no_memory(shearupdate_, 0);
  const liggghts_pkg::Setting<bool> no_heat(heattransfer_flag_, false), no_storage(store_force_, false);
  const liggghts_pkg::Setting<FixPropertyAtom*> no_sums(fix_sum_normal_force_, nullptr);
  const contact::ContactMemory memory = memory_.rows();
  contact::ParticleView view = particles();
  if (!loop_.contacts().empty()) view.mass = masses();
  for (contact::Contact contact : loop_.contacts()) {
    const int i = contact.particle;
    contact.history = memory.slot(i, contact.slot).history();
    const double overlap = loop_.ask_again(view, update->ntimestep, model_, contact);
    rows.add(number, contact, nurbs::Vector3::Map(atom->x[i]), atom->radius[i], dnum_);
    if (!gives_heat) continue;
    const liggghts_pkg::Setting<int> only_tell(computeflag_, 0), tell(addflag_, 1);
    const liggghts_pkg::Setting<ComputePairGranLocal*> to(cwl_, compute);
    addHeatFlux(nullptr, i, contact.effective_radius, overlap, 1.0);
  }
}

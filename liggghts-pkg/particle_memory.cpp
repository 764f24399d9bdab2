// SPDX-License-Identifier: GPL-2.0-or-later
#include "particle_memory.h"

#include <fmt/format.h>

#include <stdexcept>

#include "fix_property_atom.h"
#include "lammps.h"
#include "modify.h"
#include "setting.h"

namespace liggghts_pkg {

using contact::ContactMemory;
using contact::ContactSlot;
using LAMMPS_NS::FixPropertyAtom;

ParticleMemory::ParticleMemory(LAMMPS_NS::LAMMPS* lmp, const std::string& wall_id, int slot_count,
                               bool stores_force)
    : lmp_(lmp), modify_(*lmp->modify), wall_id_(wall_id) {
  for (int s = 0; s < slot_count; ++s) slot_ids_.push_back(fmt::format("contact{}_{}", s + 1, wall_id));
  if (stores_force) force_id_ = fmt::format("force_{}", wall_id);
}

void ParticleMemory::create(int history_count) {
  history_count_ = history_count;
  std::vector<std::string> empty_slot(ContactMemory::row_size(history_count), "0.");
  empty_slot[0] = fmt::format("{}", ContactSlot::kEmpty);
  for (const std::string& id : slot_ids_) add(id, "yes", empty_slot);
  if (!force_id_.empty()) add(force_id_, "no", {"0.", "0.", "0."});
  find();
}

void ParticleMemory::add(const std::string& name, const char* restart,
                         const std::vector<std::string>& initial) {
  std::vector<std::string> words = {name, "all", "property/atom", name, "vector", restart, "no", "no"};
  words.insert(words.end(), initial.begin(), initial.end());
  std::vector<char*> arg;
  for (std::string& word : words) arg.push_back(word.data());
  // LIGGGHTS asks on every rank whether rows longer than 20 are meant.
  const Setting<FILE*> no_screen(lmp_->screen, nullptr), no_log(lmp_->logfile, nullptr);
  modify_.add_fix(static_cast<int>(arg.size()), arg.data());
}

FixPropertyAtom* ParticleMemory::found(const std::string& name) const {
  const int place = modify_.find_fix(name.c_str());
  auto* const property = place < 0 ? nullptr : dynamic_cast<FixPropertyAtom*>(modify_.fix[place]);
  if (!property)
    throw std::runtime_error(
        fmt::format("its fix '{0}', where particles keep what belongs to this wall, is gone; do not unfix "
                    "'{0}', or 'unfix {1}' and define the wall anew",
                    name, wall_id_));
  return property;
}

void ParticleMemory::find() {
  slots_.clear();
  for (const std::string& id : slot_ids_) slots_.push_back(found(id));
  rows_.resize(slots_.size());
  if (!force_id_.empty()) force_ = found(force_id_);
}

void ParticleMemory::remove() {
  const auto remove = [this](const std::string& id) {
    if (modify_.find_fix(id.c_str()) >= 0) modify_.delete_fix(id.c_str());
  };
  for (const std::string& id : slot_ids_) remove(id);
  if (!force_id_.empty()) remove(force_id_);
}

ContactMemory ParticleMemory::rows() {
  for (size_t s = 0; s < slots_.size(); ++s)
    rows_[s] = slots_[s]->array_atom ? slots_[s]->array_atom[0] : nullptr;
  return {rows_.data(), static_cast<int>(rows_.size()), history_count_};
}

}  // namespace liggghts_pkg

// SPDX-License-Identifier: GPL-2.0-or-later
// Makes the contact laws known to LIGGGHTS when the program starts, as `model` of `fix wall/gran`, of our
// walls and of `pair_style gran`, with every combination of the other parts.
#include <vector>

#include "contact_laws.h"
#include "fix_insert_stream.h"  // pair_gran_base.h needs these two before it
#include "fix_wall_gran_base.h"
#include "granular_pair_style.h"
#include "granular_wall.h"
#include "law_contact_model.h"
#include "model_words.h"
#include "pair_gran_base.h"

namespace liggghts_pkg {

namespace {

namespace Walls = LIGGGHTS::Walls;
namespace PairStyles = LIGGGHTS::PairStyles;

Walls::IGranularWall* make_wall(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::FixWallGran* parent, std::int64_t hash) {
  return new Walls::Granular<LawContactModel>(lmp, parent, hash);
}

PairStyles::IGranularPairStyle* make_pair(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::PairGran* parent,
                                          std::int64_t hash) {
  return new PairStyles::Granular<LawContactModel>(lmp, parent, hash);
}

// Also the combinations that LawContactModel refuses: LIGGGHTS itself would only say "Unknown normal
// model".
bool register_contact_laws() {
  for_each_law([](auto law) {
    LIGGGHTS::ContactModels::Factory::instance().addNormalModel(law.word, law.id);
    for (const ModelWord& tangential : known_models(ModelKind::tangential))
      for (const ModelWord& cohesion : known_models(ModelKind::cohesion))
        for (const ModelWord& rolling : known_models(ModelKind::rolling))
          for (const ModelWord& surface : known_models(ModelKind::surface)) {
            const std::int64_t hash = LIGGGHTS::Utils::generate_gran_hashcode(
                law.id, tangential.id, cohesion.id, rolling.id, surface.id);
            Walls::Factory::instance().addStyle("gran", hash, &make_wall);
            PairStyles::Factory::instance().addStyle("gran", hash, &make_pair);
          }
  });
  return true;
}

const bool registered = register_contact_laws();

}  // namespace
}  // namespace liggghts_pkg

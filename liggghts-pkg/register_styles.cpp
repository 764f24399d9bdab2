// SPDX-License-Identifier: GPL-2.0-or-later
#include "register_styles.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "error.h"
#include "fix_wall_nurbs.h"
#include "fix_wall_nurbs_state.h"
#include "modify.h"

#if defined(SUPERQUADRIC_ACTIVE_FLAG) || defined(NONSPHERICAL_ACTIVE_FLAG) || defined(CONVEX_ACTIVE_FLAG)
#error "LIGGGHTS changes the size of its structs with these macros; libliggghts is built without them"
#endif

namespace liggghts_pkg {

namespace {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::Modify;

using FixCreator = Fix* (*)(LAMMPS*, int, char**);
using FixMap = std::map<std::string, FixCreator>;

// Modify::fix_map is private.  An explicit instantiation may name it all the same ([temp.spec.general]), and
// hands it out through a friend.
FixMap* Modify::*fix_map_member();
template <FixMap* Modify::*member>
struct Expose {
  friend FixMap* Modify::*fix_map_member() { return member; }
};
template struct Expose<&Modify::fix_map>;

// For an id in use LIGGGHTS deletes the old fix, leaves a null in its list and builds the new one, whose base
// class then walks over the list and crashes.
void refuse_replacement(LAMMPS* lmp, char** arg) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (!lmp->modify->fix[i])
      lmp->error->all(FLERR, fmt::format("Fix {} (id {}): this id is in use, expected 'unfix {}' first",
                                         arg[2], arg[0], arg[0])
                                 .c_str());
}

template <class FixType>
Fix* make_fix(LAMMPS* lmp, int narg, char** arg) {
  refuse_replacement(lmp, arg);
  return new FixType(lmp, narg, arg);
}

/// Deck word -> class.  A new fix is one line here.
const std::pair<const char*, FixCreator> kFixStyles[] = {
    {"wall/nurbs", &make_fix<LAMMPS_NS::FixWallNurbs>},
    {"wall/gran/nurbs", &make_fix<LAMMPS_NS::FixWallNurbs>},  // what LIGGGHTS calls it in its own messages
    {"wall/nurbs/state", &make_fix<LAMMPS_NS::FixWallNurbsState>},
};

}  // namespace

void register_styles(LAMMPS* lmp) {
  for (const auto& [word, make] : kFixStyles) (*(lmp->modify->*fix_map_member()))[word] = make;
}

}  // namespace liggghts_pkg

/// Takes the place of libliggghts' function of the same name (exports.map), see register_styles.h.
void LAMMPS_NS::LAMMPS::create() {
  using Create = void (*)(LAMMPS*);  // the ABI of a member function: `this` is the first argument
  static const auto original = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS6createEv"));
  original(this);
  liggghts_pkg::register_styles(this);
}

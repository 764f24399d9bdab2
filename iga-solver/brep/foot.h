// SPDX-License-Identifier: GPL-2.0-or-later
// What a search on a wall of faces returns.
#pragma once

#include "brep/names.h"

namespace brep {

/// patch: number of the face through which the sheet claims the foot, xi on that face.
struct Foot : search::Foot {
  int sheet;
  int side;    ///< +1 or -1: of the face, which looks to d
  int entity;  ///< number of the face, edge or vertex on which it is, by its status
};

}  // namespace brep

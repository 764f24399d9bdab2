// SPDX-License-Identifier: GPL-2.0-or-later
// The names of other rooms that walls of faces use throughout.
#pragma once

#include "search/foot.h"

namespace brep {

using nurbs::NodalVectors;
using search::FootStatus;
using search::Parameter;
using search::Vector3;

}  // namespace brep

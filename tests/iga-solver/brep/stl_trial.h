// SPDX-License-Identifier: GPL-2.0-or-later
// Random walls of triangles that were written to an STL file and read again, against the judge's opinion of
// what was meant, before it was rounded.
#pragma once

#include <memory>

#include "trials.h"

namespace brep::trials {

std::unique_ptr<Trial> stl_trial(unsigned seed, int index);

}  // namespace brep::trials

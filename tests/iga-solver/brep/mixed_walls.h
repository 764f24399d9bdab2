// SPDX-License-Identifier: GPL-2.0-or-later
// Random walls of planes, cylinders, cones, spheres and tori in closed form.
#pragma once

#include <random>
#include <vector>

#include "brep/face.h"

namespace brep::trials {

/// By turns: boxes with rounded edges, slices of a cylinder between planes, silos, bent pipes, capsules,
/// gutters; some without a few of their faces.
constexpr int kMixedFamilies = 6;
const char* mixed_family_name(int family);
std::vector<Face> random_mixed_wall(std::mt19937& random, int family);

/// In space near one of the faces, beside its sides and corners, over them (on borders), nearly over them.
Vector3 random_point(std::mt19937& random, const std::vector<Face>& faces, int place);

}  // namespace brep::trials

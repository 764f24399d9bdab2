// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid walls of faces for tests of contact.
#pragma once

#include <memory>
#include <vector>

#include "brep/builder.h"
#include "brep/faced_patches.h"
#include "coupling/rigid/rigid_surface.h"

namespace test {

/// Of triangles between these points.
inline coupling::RigidSurface wall_of(const nurbs::NodalVectors& points, const std::vector<int>& triangles) {
  return coupling::RigidSurface(std::make_shared<brep::Surface>(brep::from_triangles(points, triangles)));
}

/// Of patches, not given by words, which are faces as they turn where they meet.
inline coupling::RigidSurface wall_of(const std::vector<nurbs::Surface>& patches) {
  auto faced = brep::faced_patches(patches, false, brep::kEdgeAngle);
  return coupling::RigidSurface(patches, {}, std::make_shared<brep::FacedPatches>(std::move(faced.value())));
}

}  // namespace test

// SPDX-License-Identifier: GPL-2.0-or-later
// From a plug-in's description of its body to the skin that particles see.
#pragma once

#include <string>
#include <vector>

#include "coupling/contact_surface.h"
#include "coupling/plugin/structure_plugin.h"

namespace coupling {

/// Copies of what the description points at.
struct PluginSkin {
  std::vector<nurbs::Space<2>> patches;
  std::vector<int> outward_sign;
  SurfaceMap map;             ///< from the nodes to the control points of all patches
  std::vector<NodeId> own;    ///< nodes of this rank, rising
  NodalVectors inverse_mass;  ///< 3 x own [1/mass], or empty
};

/// Throws std::invalid_argument, saying what is wrong with which field.
PluginSkin read_skin(const StructurePluginDescription& description);

/// The skin where its nodes, all of them, stand at 3 x node_count [length]: topology and welds.
ContactSurface surface_at(const PluginSkin& skin, const NodalVectors& nodes);

}  // namespace coupling

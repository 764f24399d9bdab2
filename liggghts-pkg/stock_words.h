// SPDX-License-Identifier: GPL-2.0-or-later
// Words of LIGGGHTS' own walls that a deck may still hold, and what stands in their place: the short form of
// doc/mesh_walls.md.
#ifndef LMP_STOCK_WORDS_H
#define LMP_STOCK_WORDS_H

namespace liggghts_pkg {

struct StockWord {
  const char* word;
  const char* instead;
};

inline constexpr StockWord kStockWords[] = {
    {"file", "'geometry FILE surface all'"},
    {"mesh", "'geometry FILE surface all', in a fix for each mesh"},
    {"n_meshes", "'geometry FILE surface all', in a fix for each mesh"},
    {"meshes", "'geometry FILE surface all', in a fix for each mesh"},
    {"primitive", "'geometry FILE surface NAME' of a plane or a cylinder, or 'structure FILE surface NAME'"},
    {"shear", "'surface_vel Vx Vy Vz'"},
    {"region", "'surface NAME' of patches that the geometry file names"},
    {"curvature", "'edge_angle A' in rad"},
    {"curvature_tolerant", "'edge_angle A' in rad"},
    {"extrude_planar", "a shape with thickness in the geometry file, as 'box'"},
    {"stress", "nothing: f_ID[1..3] is the force on any of these walls, f_ID[4..6] the torque"},
    {"reference_point", "nothing: f_ID[4..6] is the torque about the origin"},
    {"wear", "'output FILE every N fields wear'"},
    {"mass_temperature", "nothing: the temperature of a wall stays"},
    {"precision", "nothing: corners within 1e-6 of the size are one"},
    {"heal", "nothing: thin and repeated triangles do no harm"},
    {"min_feature_length", "nothing: thin and repeated triangles do no harm"},
    {"element_exclusion_list", "nothing: thin and repeated triangles do no harm"},
};

}  // namespace liggghts_pkg

#endif

// SPDX-License-Identifier: GPL-2.0-or-later
// The `units`, `geometry` and `surfaces` part of a model file; a rigid wall's file has nothing else.
//
//   units: si                                   # si | cgs | mm-g-ms | mm-t-s (tonne: N, MPa)
//   geometry:                                   # one of:
//     box: {origin: [x,y,z], size: [x,y,z], elements: [31,31,8], degree: 2}
//     rolled_plate: {origin: [x,y,z], width: y, strips: [{length: x, thickness: t, elements: 9}, ..],
//                    elements: [36,1], degree: 2}                         # a solid of varying thickness
//     plane: {origin: [x,y,z], edges: [[x,y,z],[x,y,z]], elements: [10,10], degree: 2}
//     cylinder: {origin: [x,y,z], axis: [x,y,z], radius: r, length: l, angle: [0,360], elements: [8,4]}
//     cone: {origin, axis, radii: [r,r], length, angle, elements}         # a frustum; one radius may be 0
//     sphere: {centre, axis, radius, longitude: [0,360], latitude: [-90,90], elements}
//     torus: {centre, axis, radius, tube_radius, angle: [0,360], tube_angle: [0,360], elements}
//     tube: {origin, axis, inner_radius, outer_radius, length, angle, elements: [8,4,2]}        # a solid
//     patches: [{degrees: [2,2], knots: [[..],[..]], control_points: [[x,y,z],..], weights: [..]}, ..]
//     shapes: [{box: {..}}, {tube: {..}, move: [x,y,z]}, ..]      # several of these, each with its changes
//     file: drum.h5                             # another geometry file, of any format; relative to this one
//                                               # and, if wanted: refine, scale, rotate, move
//                                               (shape_changes.h)
//   surfaces: {top: zeta+}                      # a volume's face; `all` for surface patches
//
// Of several patches, counted from 0, a surface is a list of patches and of "PATCH FACE", as in
// `surfaces: {shell: [0, 1], bore: [2 zeta-, 3 zeta-]}`; blocks of STL files also by name: `[cone, lid]`.
//
// `degree` is one number or one per direction.  In a box or plane `breaks: [[0, .5, 1], ..]` (relative, from
// 0 to 1) may stand in place of `elements` for graded meshes.
//
// A rolled plate is flat below, at the z of its origin; its strips follow one another along x.  `thickness:
// [from, to]` makes a C1 ramp of two parabolas, with an even number of elements; strips meet in the same
// thickness.  `elements` are those along y and z.
//
// Round shapes are exact.  Their first direction is the azimuth; the second is the length, the latitude or
// the angle round the tube (0 outside, 90 on top); a tube's third runs from the inner to the outer radius.
// Angles are in degrees, [from, to] with from < to <= from + 360, counted from the direction `reference`
// round `axis` by the right hand; the reference may be left out (x for an axis along z, and so on in cyclic
// order), so may the angles (the whole turn), a sphere's axis (z) and the degree (2).  An angle is cut into
// arcs of at most 90 degrees, and `elements` of that direction is a multiple of their number.  In one whole
// turn the first and the last edge touch; the model of a solid welds them (io/README.md).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "geometry_io/named_surface.h"
#include "geometry_io/yaml_map.h"

namespace brep {
struct CadModel;
}

namespace geometry_io {

enum class Units { si, cgs, mm_g_ms, mm_t_s };
const char* units_name(Units units);
/// Throws std::invalid_argument that lists the names.
Units units_from_name(const std::string& name);

/// What the three keys say.  One patch at least, or a CAD model; `surfaces`: one piece at least each.
struct GeometryFile {
  Units units;
  std::vector<Shape> patches;
  std::map<std::string, std::vector<SurfacePiece>> surfaces;
  std::set<int> from_words{};  ///< patches that a word such as `cylinder` gives, not control points
  std::shared_ptr<const brep::CadModel> cad{};  ///< of a CAD file, which has neither patches nor pieces
  std::map<std::string, std::vector<int>> cad_surfaces{};  ///< faces of `cad`, by the names under `surfaces`
};

/// Reads the geometry file that another one names.  `units` are those of the file that names it: units for
/// formats without, and the only ones allowed for others.
using OpenGeometry = std::function<GeometryFile(const std::string& path, Units units)>;

/// Reads the three keys from a document that may have others (a model file).  Without `open`, the key `file`
/// is refused.  Throws InputError.
GeometryFile read_geometry(const YamlMap& document, const OpenGeometry& open = {});
/// A rigid wall's file: any other top-level key is an error.
GeometryFile parse_geometry_file(const std::string& text, const std::string& file,
                                 const OpenGeometry& open = {});

/// What one surface is made of.  Throws InputError that lists the names there are.
const std::vector<SurfacePiece>& pieces_of(const GeometryFile& geometry, const std::string& name,
                                           const std::string& file);
/// The triangles of these pieces as one mesh; `part` is the patch that each is from.
JoinedMesh joined_triangles(const GeometryFile& geometry, const std::vector<SurfacePiece>& pieces);
/// Those of one named surface; none if all of its patches are NURBS.  Throws InputError as pieces_of does.
JoinedMesh named_triangles(const GeometryFile& geometry, const std::string& name, const std::string& file);
/// The patches of one named surface.  Throws InputError as pieces_of does, and if one of its patches is
/// triangles.
std::vector<OrientedSurface> named_surface(const GeometryFile& geometry, const std::string& name,
                                           const std::string& file);

/// The faces of one surface of a CAD file: a name under `surfaces`, else a word as cad_faces takes it
/// (cad_selection.h). Throws InputError that lists what there is.
std::vector<int> named_cad_faces(const GeometryFile& geometry, const std::string& name,
                                 const std::string& file);

}  // namespace geometry_io

// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "brep/builder.h"
#include "brep/faced_patches.h"
#include "coupling/model_text.h"
#include "coupling/open_structure.h"
#include "coupling/rigid/rigid_surface.h"
#include "geometry_io/cad_placement.h"
#include "geometry_io/geometry_io.h"
#include "geometry_io/wall_size.h"
#include "nurbs/memory.h"
#include "nurbs/usable_number.h"
#include "parallel/all_or_none.h"

namespace coupling {

namespace {

// What contact keeps of each element, whether particles come near or not.
void expect_room(const std::vector<nurbs::Surface>& patches, const std::string& path) {
  constexpr double kBytesPerElement = 450.0;
  double elements = 0.0;
  for (const nurbs::Surface& patch : patches) elements += patch.space.element_count();
  try {
    nurbs::expect_memory(kBytesPerElement * elements, fmt::format("a wall of {:.3g} elements", elements));
  } catch (const std::invalid_argument& error) {
    throw geometry_io::InputError(fmt::format("{}: {}", path, error.what()));
  }
}

void expect_usable(const nurbs::NodalVectors& points, const std::string& path) {
  const double largest = points.cwiseAbs().maxCoeff();
  if (!nurbs::is_usable(largest))
    throw geometry_io::InputError(fmt::format(
        "{}: scaled and moved as the deck says it has a coordinate of size {:.6g}, expected at most {}", path,
        largest, nurbs::kLargestNumber));
}

void place(nurbs::NodalVectors& points, const RigidOptions& options, const std::string& path) {
  if (!options.placement) return;
  geometry_io::place(points, *options.placement);
  expect_usable(points, path);
}

std::unique_ptr<RigidSurface> wall_of_triangles(const geometry_io::TriangleMesh& mesh, double edge_angle) {
  return std::make_unique<RigidSurface>(
      std::make_shared<const brep::Surface>(brep::from_triangles(mesh.points, mesh.triangles, edge_angle)));
}

void expect_sane_size(const geometry_io::GeometryFile& file, const RigidOptions& options,
                      const std::string& path) {
  const double factor = options.placement ? options.placement->linear().col(0).stableNorm() : 1.0;
  const std::string problem = geometry_io::size_problem(geometry_io::extents_of(file.patches, file.cad.get()),
                                                        nurbs::Vector3::Constant(factor));
  if (problem.empty()) return;
  const std::string scaled = options.placement ? fmt::format("scaled by {:.6g} ", factor) : "";
  throw geometry_io::InputError(fmt::format("{}: {}it is {}", path, scaled, problem));
}

// Of a CAD file, whose lengths are already those of `options.units`.
std::unique_ptr<RigidSurface> wall_of_cad(const geometry_io::GeometryFile& file, const std::string& surface,
                                          const RigidOptions& options, const std::string& path) {
  const std::vector<int> faces = geometry_io::named_cad_faces(file, surface, path);
  try {
    brep::CadModel model = *file.cad;
    if (options.placement) geometry_io::place(model, *options.placement);
    auto wall = std::make_shared<const brep::Surface>(brep::from_cad(model, faces, options.edge_angle));
    expect_usable((nurbs::NodalVectors(3, 2) << wall->low, wall->high).finished(), path);
    return std::make_unique<RigidSurface>(std::move(wall));
  } catch (const std::invalid_argument& error) {
    throw geometry_io::InputError(fmt::format("{}: {}", path, error.what()));
  }
}

// The others have the same, and a file is written once.
void keep_on_first_rank(MPI_Comm comm, const geometry_io::GeometryFile& file, const std::string& path,
                        const std::string& keep) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) geometry_io::write_geometry_file(file, keep, {path});
}

OpenedStructure read_rigid_surface(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   const RigidOptions& options) {
  const std::optional<geometry_io::Format> format = geometry_io::format_of_path(path);
  const bool takes_units = format == geometry_io::format::stl || format == geometry_io::format::cad;
  const geometry_io::GeometryFile file = geometry_io::read_geometry(
      path, reader_on_all_ranks(comm), takes_units ? options.units : geometry_io::Units::si);
  expect_sane_size(file, options, path);
  if (!options.keep.empty()) keep_on_first_rank(comm, file, path, options.keep);
  if (file.cad) return {wall_of_cad(file, surface, options, path), file.units};
  geometry_io::TriangleMesh triangles = geometry_io::named_triangles(file, surface, path).mesh;
  if (triangles.count() > 0) {
    place(triangles.points, options, path);
    return {wall_of_triangles(triangles, options.edge_angle), file.units};
  }
  std::vector<nurbs::Surface> patches;
  std::vector<int> outward_sign;
  bool from_words = true;
  for (geometry_io::OrientedSurface& patch : geometry_io::named_surface(file, surface, path)) {
    place(patch.surface.control_points, options, path);
    from_words = from_words && patch.from_words;
    patches.push_back(std::move(patch.surface));
    outward_sign.push_back(patch.outward_sign);
  }
  expect_room(patches, path);
  std::shared_ptr<const brep::FacedPatches> faced;
  if (options.faces)
    if (auto as_faces = brep::faced_patches(patches, from_words, options.edge_angle))
      faced = std::make_shared<const brep::FacedPatches>(std::move(*as_faces));
  return {std::make_unique<RigidSurface>(patches, std::move(outward_sign), std::move(faced)), file.units};
}

}  // namespace

OpenedStructure open_rigid_surface(MPI_Comm comm, const std::string& path, const std::string& surface,
                                   RigidDrive drive, const RigidOptions& options) {
  OpenedStructure opened =
      parallel::on_every_rank(comm, path, [&] { return read_rigid_surface(comm, path, surface, options); });
  static_cast<RigidSurface&>(*opened.solver).drive(std::move(drive));
  return opened;
}

}  // namespace coupling

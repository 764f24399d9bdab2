// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/triangle_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "brep/builder.h"
#include "brep/summary.h"

namespace geometry_io {
namespace {

constexpr size_t kGapsShown = 5, kShellsShown = 5;

// "line 12 of patch 0": where a triangle stands in its file.
std::string place_text(const GeometryFile& geometry, const JoinedMesh& all, int triangle) {
  const int patch = all.part[triangle];
  return fmt::format("{} {} of patch {}",
                     std::get<TriangleMesh>(geometry.patches[patch]).binary ? "triangle" : "line",
                     all.mesh.place[triangle], patch);
}

// Volumes of shells that point the wrong way are taken off, not added.
std::string shells_text(const std::vector<brep::Shell>& shells) {
  if (shells.size() < 2) return "";
  std::string text;
  size_t turned = 0;
  for (const brep::Shell& shell : shells) {
    if (!shell.inside_out || ++turned > kShellsShown) continue;
    text += fmt::format("    from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}), volume {:.6g}\n",
                        shell.low[0], shell.low[1], shell.low[2], shell.high[0], shell.high[1], shell.high[2],
                        std::abs(shell.volume));
  }
  if (turned > kShellsShown) text += fmt::format("    and {} more\n", turned - kShellsShown);
  if (turned == 0 || turned == shells.size()) return fmt::format("  shells: {}\n", shells.size());
  return fmt::format("  shells: {}; {} inside out, whose volume counts with the wrong sign:\n{}",
                     shells.size(), turned, text);
}

// Faces, edges, area and volume, as a wall has them.
std::string wall_text(const GeometryFile& geometry, const JoinedMesh& all, double edge_angle) {
  brep::BuildReport report;
  brep::Summary wall;
  try {
    wall = summary_of(brep::from_triangles(all.mesh.points, all.mesh.triangles, edge_angle, &report));
  } catch (const std::invalid_argument& error) {
    return fmt::format("  no wall: {}\n", error.what());
  }
  std::string text = fmt::format("  {} plane faces; edges: {} convex, {} concave, {} smooth", wall.faces[0],
                                 wall.convex, wall.concave, wall.smooth + wall.near_smooth);
  text +=
      fmt::format(", {} free, {} of more than two faces\n  area {:.6g}, ", wall.free, wall.many, wall.area);
  if (!wall.closed)
    text += "open: no volume\n";
  else if (wall.volume == 0.0)
    text += "closed, but turned in and out: no volume\n";
  else
    text += fmt::format("closed, volume {:.6g}{}\n", std::abs(wall.volume),
                        wall.volume < 0.0 ? ", normals inwards" : "");
  text += shells_text(wall.shells);
  text += fmt::format("  worst triangle: {}, height {:.3g}", place_text(geometry, all, report.worst_triangle),
                      report.least_height);
  text += fmt::format("; {} are thinner than 1e-6 of the whole\n", report.thin + report.collapsed);
  if (report.t_junctions > 0)
    text += fmt::format("  T-junctions: {} corners on sides of other triangles, which are joined there\n",
                        report.t_junctions);
  return text;
}

std::string gaps_text(const GeometryFile& geometry, const JoinedMesh& all) {
  const std::vector<Gap> gaps = gaps_of(all.mesh);
  if (gaps.empty()) return "  gaps: none\n";
  std::string text = fmt::format("  gaps: {}\n", gaps.size());
  for (size_t g = 0; g < gaps.size() && g < kGapsShown; ++g)
    text += fmt::format("    {} free sides of triangles, length {:.6g}, one at {}\n", gaps[g].edges,
                        gaps[g].length, place_text(geometry, all, gaps[g].triangle));
  if (gaps.size() > kGapsShown) text += fmt::format("    and {} shorter ones\n", gaps.size() - kGapsShown);
  return text;
}

std::string pairs_text(const GeometryFile& geometry, const JoinedMesh& all, const OverlappingPairs& pairs,
                       const std::string& what) {
  if (pairs.count == 0) return "";
  return fmt::format("    {} pair{} of triangles {}, one at {} and {}\n", pairs.count,
                     pairs.count == 1 ? "" : "s", what, place_text(geometry, all, pairs.first),
                     place_text(geometry, all, pairs.second));
}

std::string overlaps_text(const GeometryFile& geometry, const JoinedMesh& all) {
  const Overlaps overlaps = overlaps_of(all.mesh);
  const std::string text = pairs_text(geometry, all, overlaps.in_plane,
                                      "in one plane cover each other (contacts there may count twice)") +
                           pairs_text(geometry, all, overlaps.piercing, "pierce each other");
  return text.empty() ? "  overlaps: none\n" : "  overlaps:\n" + text;
}

}  // namespace

std::string triangles_text(const GeometryFile& geometry, double edge_angle) {
  std::vector<geometry_io::SurfacePiece> pieces;
  for (int p = 0; p < static_cast<int>(geometry.patches.size()); ++p)
    if (is_triangles(geometry.patches[p])) pieces.push_back({p, std::nullopt});
  if (pieces.empty()) return "";
  const JoinedMesh all = joined_triangles(geometry, pieces);
  return fmt::format(
             "triangles of all patches: {}, {} points; left out: {} without an area, {} that lie twice\n",
             all.mesh.count(), all.mesh.points.cols(), all.mesh.degenerate, all.mesh.repeated) +
         wall_text(geometry, all, edge_angle) + gaps_text(geometry, all) + overlaps_text(geometry, all);
}

}  // namespace geometry_io

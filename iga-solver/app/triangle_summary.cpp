// SPDX-License-Identifier: GPL-2.0-or-later
#include "triangle_summary.h"

#include <fmt/format.h>

#include <vector>

namespace app {
namespace {

using geometry_io::TriangleMesh;

constexpr size_t kGapsShown = 5;

std::string gaps_text(const TriangleMesh& mesh) {
  const std::vector<geometry_io::Gap> gaps = gaps_of(mesh);
  if (gaps.empty()) return "  gaps: none\n";
  std::string text = fmt::format("  gaps: {}\n", gaps.size());
  for (size_t g = 0; g < gaps.size() && g < kGapsShown; ++g)
    text += fmt::format("    {} free edges, length {:.6g}, the first at triangle {}\n", gaps[g].edges,
                        gaps[g].length, mesh.place[gaps[g].triangle]);
  if (gaps.size() > kGapsShown) text += fmt::format("    and {} shorter ones\n", gaps.size() - kGapsShown);
  return text;
}

}  // namespace

std::string triangles_text(const geometry_io::GeometryFile& geometry) {
  std::vector<const TriangleMesh*> meshes;
  for (const geometry_io::Shape& patch : geometry.patches)
    if (const auto* mesh = std::get_if<TriangleMesh>(&patch)) meshes.push_back(mesh);
  if (meshes.empty()) return "";
  const TriangleMesh all = geometry_io::joined(meshes).mesh;
  std::string text = fmt::format(
      "all triangles: {}, with {} points, after leaving out {} without an area and {} that lie twice\n",
      all.count(), all.points.cols(), all.degenerate, all.repeated);
  return text + gaps_text(all);
}

}  // namespace app

// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "nurbs/coincident.h"

namespace geometry_io {
namespace {

using nurbs::NodalVectors;
using Points = Eigen::Ref<const NodalVectors>;
using Corners = std::array<int, 3>;

struct Triangle {
  Corners corners;
  int place;
  int from;  // block of a soup, or mesh that is joined
};

bool two_are_one(const Corners& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; }

template <class Condition>
void erase_if(std::vector<Triangle>& triangles, Condition condition) {
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), condition), triangles.end());
}

// Those without an area because two corners are one point; how many of each block or mesh is added.
void drop_degenerate(std::vector<Triangle>& triangles, std::vector<int>& dropped) {
  erase_if(triangles, [&](const Triangle& triangle) {
    const bool degenerate = two_are_one(triangle.corners);
    dropped[triangle.from] += degenerate;
    return degenerate;
  });
}

// Keeps the first of those with the same three points; how many were others.
int drop_repeated(std::vector<Triangle>& triangles) {
  std::vector<std::pair<Corners, int>> order(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    order[t] = {triangles[t].corners, static_cast<int>(t)};
    std::sort(order[t].first.begin(), order[t].first.end());
  }
  std::sort(order.begin(), order.end());
  int repeated = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    if (order[i].first == order[i - 1].first) triangles[order[i].second].from = -1, ++repeated;
  if (repeated > 0) erase_if(triangles, [](const Triangle& triangle) { return triangle.from < 0; });
  return repeated;
}

// Numbers the points of a mesh from 0, in the order in which triangles name them.
class PointNumbers {
 public:
  explicit PointNumbers(const Points& points) : points_(points), number_(points.cols()), used_(0) {
    std::fill(number_.begin(), number_.end(), -1);
  }

  void fill(const std::vector<Triangle>& triangles, TriangleMesh& mesh) {
    for (const Triangle& triangle : triangles) {
      for (const int corner : triangle.corners) mesh.triangles.push_back(number(corner));
      mesh.place.push_back(triangle.place);
    }
    mesh.points.resize(3, static_cast<Eigen::Index>(used_.size()));
    for (std::size_t n = 0; n < used_.size(); ++n) mesh.points.col(n) = points_.col(used_[n]);
    for (const int point : used_) number_[point] = -1;
    used_.clear();
  }

 private:
  int number(int point) {
    if (number_[point] < 0) {
      number_[point] = static_cast<int>(used_.size());
      used_.push_back(point);
    }
    return number_[point];
  }

  const Points& points_;
  std::vector<int> number_;  // or -1
  std::vector<int> used_;
};

}  // namespace

TriangleMesh mesh_of(const nurbs::TriangleMesh& triangles) {
  TriangleMesh mesh;
  mesh.points = triangles.vertices;
  for (const std::array<int, 3>& corners : triangles.triangles)
    mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
  mesh.place.resize(triangles.triangles.size());
  std::iota(mesh.place.begin(), mesh.place.end(), 1);
  mesh.binary = true;
  return mesh;
}

std::vector<TriangleMesh> meshes_of(const TriangleSoup& soup) {
  const int count = static_cast<int>(soup.place.size()), blocks = static_cast<int>(soup.blocks.size());
  const Eigen::Map<const NodalVectors> corners(soup.corners.data(), 3, 3 * count);
  const Points points(corners);
  const std::vector<int> first = nurbs::first_coincident(points, kSamePoint);
  std::vector<int> dropped(blocks, 0);
  std::vector<Triangle> all(count);
  for (int t = 0, block = 0; t < count; ++t) {
    while (block + 1 < blocks && soup.blocks[block + 1].first <= t) ++block;
    all[t] = {{first[3 * t], first[3 * t + 1], first[3 * t + 2]}, soup.place[t], block};
  }
  drop_degenerate(all, dropped);

  std::vector<TriangleMesh> meshes;
  PointNumbers numbers(points);
  for (auto begin = all.begin(); begin != all.end();) {
    const int block = begin->from;
    const auto end = std::find_if(begin, all.end(), [&](const Triangle& t) { return t.from != block; });
    std::vector<Triangle> own(begin, end);
    TriangleMesh mesh;
    mesh.name = soup.blocks[block].name;
    mesh.binary = soup.binary;
    mesh.degenerate = dropped[block];
    mesh.repeated = drop_repeated(own);
    numbers.fill(own, mesh);
    meshes.push_back(std::move(mesh));
    begin = end;
  }
  return meshes;
}

JoinedMesh joined(const std::vector<const TriangleMesh*>& meshes) {
  Eigen::Index count = 0;
  for (const TriangleMesh* mesh : meshes) count += mesh->points.cols();
  NodalVectors all_points(3, count);
  std::vector<Triangle> triangles;
  std::vector<int> dropped(meshes.size(), 0);
  TriangleMesh mesh;
  int before = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const TriangleMesh& part = *meshes[m];
    all_points.middleCols(before, part.points.cols()) = part.points;
    for (int t = 0; t < part.count(); ++t) {
      const int* c = &part.triangles[3 * t];
      triangles.push_back(
          {{before + c[0], before + c[1], before + c[2]}, part.place[t], static_cast<int>(m)});
    }
    before += static_cast<int>(part.points.cols());
    dropped[m] = part.degenerate;
    mesh.repeated += part.repeated;
  }
  const Points points(all_points);
  const std::vector<int> first = nurbs::first_coincident(points, kSamePoint);
  for (Triangle& triangle : triangles)
    for (int& corner : triangle.corners) corner = first[corner];
  drop_degenerate(triangles, dropped);
  mesh.repeated += drop_repeated(triangles);
  for (const int degenerate : dropped) mesh.degenerate += degenerate;
  PointNumbers(points).fill(triangles, mesh);
  JoinedMesh all{std::move(mesh), {}};
  for (const Triangle& triangle : triangles) all.part.push_back(triangle.from);
  return all;
}

}  // namespace geometry_io

// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry_io/cad_cuts.h"

#include <algorithm>
#include <utility>

#include "geometry_io/cad_curves.h"

namespace geometry_io {
namespace {

using brep::CadEdge;
using brep::CadModel;
using brep::Trim;

// The parts of a trim along the parts of its edge, in the sense of the loop.
std::vector<Trim> parts_of(const CadModel& model, const brep::CadFace& face, const Trim& trim,
                           const EdgeCurve& curve, const std::vector<Cut>& cuts,
                           const std::vector<int>& parts) {
  const BorderCurve border(model, face, trim);
  std::vector<double> ends{border.at_part(0.0)};
  for (size_t k = 0; k < cuts.size(); ++k) {
    const double t = cuts[trim.forward ? k : cuts.size() - 1 - k].t;
    ends.push_back(border.beside(curve.point(t), curve.tangent(t)));
  }
  ends.push_back(border.at_part(1.0));
  std::vector<Trim> all;
  for (size_t k = 0; k < parts.size(); ++k) {
    all.push_back({part_of(trim.curve, ends[k], ends[k + 1]), parts[trim.forward ? k : parts.size() - 1 - k],
                   trim.forward});
    if (k > 0) all[k].curve.points.col(0) = all[k - 1].curve.points.rightCols<1>();
  }
  return all;
}

std::vector<int> parts_of(CadModel& model, int number, const EdgeCurve& curve, const std::vector<Cut>& cuts) {
  const CadEdge whole = model.edges[number];
  std::vector<int> parts;
  double from = curve.begin();
  int vertex = whole.vertex[0];
  for (size_t k = 0; k <= cuts.size(); ++k) {
    const bool last = k == cuts.size();
    const double to = last ? curve.end() : cuts[k].t;
    CadEdge part = part_of(whole, from, to);
    part.vertex[0] = vertex;
    part.vertex[1] = last ? whole.vertex[1] : cuts[k].vertex;
    parts.push_back(k == 0 ? number : static_cast<int>(model.edges.size()));
    if (k == 0)
      model.edges[number] = std::move(part);
    else
      model.edges.push_back(std::move(part));
    from = to, vertex = last ? vertex : cuts[k].vertex;
  }
  return parts;
}

// New numbers of those that are used, -1 of the others, which are taken out.
template <class Item>
std::vector<int> kept(std::vector<Item>& items, const std::vector<bool>& used) {
  std::vector<int> number(items.size(), -1);
  int count = 0;
  for (size_t i = 0; i < items.size(); ++i)
    if (used[i]) {
      if (static_cast<size_t>(count) != i) items[count] = std::move(items[i]);
      number[i] = count++;
    }
  items.resize(count);
  return number;
}

}  // namespace

std::vector<std::vector<TrimPlace>> uses_of_edges(const CadModel& model) {
  std::vector<std::vector<TrimPlace>> uses(model.edges.size());
  for (size_t f = 0; f < model.faces.size(); ++f)
    for (size_t l = 0; l < model.faces[f].loops.size(); ++l)
      for (size_t t = 0; t < model.faces[f].loops[l].size(); ++t)
        if (const int edge = model.faces[f].loops[l][t].edge; edge >= 0)
          uses[edge].push_back({static_cast<int>(f), static_cast<int>(l), static_cast<int>(t)});
  return uses;
}

const Trim& trim_at(const CadModel& model, const TrimPlace& place) {
  return model.faces[place.face].loops[place.loop][place.trim];
}

std::vector<std::vector<int>> cut_edges(CadModel& model, const std::vector<std::vector<Cut>>& cuts) {
  const size_t count = model.edges.size();
  std::vector<EdgeCurve> curves;  // before they are cut
  std::vector<int> curve_of(count, -1);
  std::vector<std::vector<int>> parts(count);
  for (size_t e = 0; e < count; ++e) {
    parts[e] = {static_cast<int>(e)};
    if (cuts[e].empty()) continue;
    curve_of[e] = static_cast<int>(curves.size());
    curves.emplace_back(model.edges[e]);
    parts[e] = parts_of(model, static_cast<int>(e), curves.back(), cuts[e]);
  }
  for (brep::CadFace& face : model.faces)
    for (brep::Loop& loop : face.loops) {
      brep::Loop cut;
      for (const Trim& trim : loop) {
        if (trim.edge < 0 || curve_of[trim.edge] < 0) {
          cut.push_back(trim);
          continue;
        }
        for (Trim& part :
             parts_of(model, face, trim, curves[curve_of[trim.edge]], cuts[trim.edge], parts[trim.edge]))
          cut.push_back(std::move(part));
      }
      loop = std::move(cut);
    }
  return parts;
}

void merge_vertices(CadModel& model, brep::DisjointSets& sets) {
  const std::vector<brep::CadVertex> old = model.vertices;
  for (size_t v = 0; v < old.size(); ++v) {
    brep::CadVertex& stays = model.vertices[sets.find(static_cast<int>(v))];
    stays.tolerance = std::max(stays.tolerance, (old[v].point - stays.point).norm() + old[v].tolerance);
  }
  for (CadEdge& edge : model.edges)
    for (int& vertex : edge.vertex)
      if (vertex >= 0) vertex = sets.find(vertex);
}

double note_gap(CadModel& model, const brep::CadFace& face, const Trim& trim) {
  constexpr int kPlaces = 40;
  constexpr double kBetween = 1.01;  // of what is seen there
  CadEdge& edge = model.edges[trim.edge];
  const EdgeCurve curve(edge);
  const BorderCurve border(model, face, trim);
  double gap = 0.0;
  for (int k = 0; k <= kPlaces; ++k) {
    const brep::Vector3 p = border.point(border.at_part(static_cast<double>(k) / kPlaces));
    gap = std::max(gap, curve.nearest(p, curve.begin(), curve.end()).distance);
  }
  edge.tolerance = std::max(edge.tolerance, kBetween * gap);
  return gap;
}

void drop_unused(CadModel& model) {
  std::vector<bool> edges(model.edges.size(), false), vertices(model.vertices.size(), false);
  for (const brep::CadFace& face : model.faces)
    for (const brep::Loop& loop : face.loops)
      for (const Trim& trim : loop)
        if (trim.edge >= 0) edges[trim.edge] = true;
  for (size_t e = 0; e < model.edges.size(); ++e)
    for (const int vertex : model.edges[e].vertex)
      if (edges[e] && vertex >= 0) vertices[vertex] = true;
  const std::vector<int> edge_number = kept(model.edges, edges),
                         vertex_number = kept(model.vertices, vertices);
  for (CadEdge& edge : model.edges)
    for (int& vertex : edge.vertex)
      if (vertex >= 0) vertex = vertex_number[vertex];
  for (brep::CadFace& face : model.faces)
    for (brep::Loop& loop : face.loops)
      for (Trim& trim : loop)
        if (trim.edge >= 0) trim.edge = edge_number[trim.edge];
}

}  // namespace geometry_io

// SPDX-License-Identifier: GPL-2.0-or-later
// What is inside of faces and of solids against OpenCASCADE's classifiers; winding numbers settle where they
// disagree.  Exit code 1 if one of these is against us.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <random>

#include "brep/builder.h"
#include "brep/face_shape.h"
#include "brep/foot_search.h"
#include "cad_wall.h"
#include "occt_judge.h"
#include "occt_winding.h"
#include "tried_files.h"

namespace {

using brep::Vector3;
using step_parts::Place;

step_parts::Point point_of(const Vector3& p) { return {p[0], p[1], p[2]}; }

struct Counts {
  long points = 0;
  long disputed = 0;   ///< OpenCASCADE says otherwise
  long on_border = 0;  ///< of these: within tolerance, or too close for triangles to tell
  long against = 0;    ///< of these: by the winding number we are wrong
};

/// A wall of these faces, all of two sides.
brep::Surface wall_of(brep::CadModel model, const std::vector<int>& faces) {
  for (brep::CadFace& face : model.faces) face.outward = 0;
  return brep::from_cad(model, faces);
}

class Trial {
 public:
  Trial(const std::string& file, unsigned seed)
      : model_(step_parts::model_of(file)), judge_(file), winding_(file), random_(seed) {
    if (judge_.face_count() != static_cast<int>(model_.faces.size()))
      throw std::runtime_error(
          fmt::format("{} faces, OpenCASCADE has {}", model_.faces.size(), judge_.face_count()));
  }

  Counts faces(int points) {
    std::vector<int> all(model_.faces.size());
    std::iota(all.begin(), all.end(), 0);
    const brep::Surface wall = wall_of(model_, all);
    const double tolerance = tolerance_of(wall);
    Counts counts;
    for (size_t f = 0; f < all.size(); ++f)
      for (int k = 0; k < points; ++k) try_face(wall, static_cast<int>(f), tolerance, counts);
    return counts;
  }

  Counts solids(int points) {
    Counts counts;
    int number = 0;
    for (size_t s = 0; s < model_.solids.size(); ++s)
      if (model_.solids[s].closed) try_solid(static_cast<int>(s), number++, points, counts);
    if (number != judge_.solid_count())
      throw std::runtime_error(fmt::format("{} solids, OpenCASCADE has {}", number, judge_.solid_count()));
    return counts;
  }

 private:
  double tolerance_of(const brep::Surface& wall) const {
    return std::max({1e-9 * wall.size, judge_.tolerance(),
                     *std::max_element(wall.edge_slack.begin(), wall.edge_slack.end())});
  }

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void try_face(const brep::Surface& wall, int face, double tolerance, Counts& counts) {
    const brep::TrimDomain& domain = wall.domains[face];
    const brep::Parameter<2> xi{between(domain.low()[0], domain.high()[0]),
                                between(domain.low()[1], domain.high()[1])};
    const bool ours = domain.inside(xi);
    const step_parts::Point point = point_of(brep::point_on(wall, face, xi));
    const auto [u, v] = winding_.parameters(face, point);
    const Place polygon = judge_.in_face_by_polygon(face, u, v);
    ++counts.points;
    if (polygon == (ours ? Place::kIn : Place::kOut)) return;
    ++counts.disputed;
    const step_parts::Winding settled = winding_.in_face(face, point);
    if (settled.distance <= tolerance) return void(++counts.on_border);
    if (settled.inside == ours) return;
    if (++counts.against <= 5)
      fmt::print("  face {} at ({:.17g}, {:.17g}): ours {}, winding number {}, {:.3g} mm from its border\n",
                 face + 1, xi[0], xi[1], ours, settled.inside, settled.distance);
  }

  void try_solid(int solid, int number, int points, Counts& counts) {
    std::vector<int> faces;
    for (size_t f = 0; f < model_.faces.size(); ++f)
      if (model_.faces[f].solid == solid) faces.push_back(static_cast<int>(f));
    const brep::Surface wall = wall_of(model_, faces);
    const brep::FootSearch search(wall);
    const double tolerance = std::max(tolerance_of(wall), 2.0 * winding_.chord());
    for (int k = 0; k < points; ++k) {
      Vector3 d;
      for (int i = 0; i < 3; ++i) d[i] = between(wall.low[i], wall.high[i]);
      const brep::Foot foot = nearest(search, d);
      const bool ours = foot.side * model_.faces[faces[foot.patch]].outward < 0;
      ++counts.points;
      if (judge_.in_solid(number, point_of(d), judge_.tolerance()) == (ours ? Place::kIn : Place::kOut))
        continue;
      ++counts.disputed;
      if (foot.distance <= tolerance)
        ++counts.on_border;
      else if (winding_.in_solid(number, point_of(d)) != ours && ++counts.against <= 5)
        fmt::print(
            "  solid {} at ({:.17g}, {:.17g}, {:.17g}): ours {}, winding number {}, {:.3g} mm from face {}\n",
            solid + 1, d[0], d[1], d[2], ours, !ours, foot.distance, faces[foot.patch] + 1);
    }
  }

  brep::Foot nearest(const brep::FootSearch& search, const Vector3& d) {
    for (double reach = search.surface().size / 64.0;; reach *= 2.0) {
      near_.clear(), feet_.clear();
      search.near(d, reach, near_);
      search.feet(d, reach, near_.data(), static_cast<int>(near_.size()), feet_);
      const auto least = std::min_element(
          feet_.begin(), feet_.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
      if (least != feet_.end()) return *least;
      if (reach > 4.0 * search.surface().size) throw std::runtime_error("no foot");
    }
  }

  const brep::CadModel model_;
  const step_parts::OcctJudge judge_;
  const step_parts::OcctWinding winding_;
  std::mt19937 random_;
  std::vector<int> near_;
  std::vector<brep::Foot> feet_;
};

void print(const char* what, const Counts& counts) {
  fmt::print("  {}: {} points, {} disputed, {} of these at a border, {} against us\n", what, counts.points,
             counts.disputed, counts.on_border, counts.against);
}

}  // namespace

int main(int argc, char** argv) {
  step_parts::TriedFiles tried("What is inside of faces and solids, against OpenCASCADE's classifiers",
                               "for each face, and three times as many for each solid", 200);
  return tried.run(argc, argv, [&](const std::string& file) {
    fmt::print("\n");
    Trial trial(file, tried.seed);
    const Counts faces = trial.faces(tried.points), solids = trial.solids(3 * tried.points);
    print("faces", faces), print("solids", solids);
    return faces.against + solids.against;
  });
}

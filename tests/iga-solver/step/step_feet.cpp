// SPDX-License-Identifier: GPL-2.0-or-later
// The nearest foot on the faces of CAD files against OpenCASCADE's distance.  Exit code 1 if one differs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>

#include "brep/builder.h"
#include "brep/edge_uses.h"
#include "brep/face_shape.h"
#include "brep/foot_search.h"
#include "geometry_io/step_reader.h"
#include "occt_judge.h"

namespace {

using brep::Vector3;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

brep::Surface wall_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream bytes;
  bytes << in.rdbuf();
  brep::CadModel model = geometry_io::read_step(bytes.str());
  for (brep::CadFace& face : model.faces) face.outward = 0;
  std::vector<int> all(model.faces.size());
  std::iota(all.begin(), all.end(), 0);
  return brep::from_cad(model, all);
}

class Trial {
 public:
  Trial(const std::string& file, unsigned seed)
      : wall_(wall_of(file)), search_(wall_), judge_(file), random_(seed) {}

  void run(int points) {
    std::vector<int> near;
    std::vector<brep::Foot> feet;
    double ours = 0.0, theirs = 0.0;
    int missed = 0, theirs_missed = 0;
    for (int k = 0; k < points; ++k) {
      const Vector3 d = point(k);
      Clock::time_point start = Clock::now();
      const double distance = judge_.nearest({d[0], d[1], d[2]}).distance;
      theirs += seconds_since(start);
      near.clear(), feet.clear();
      start = Clock::now();
      const double reach = 1.01 * distance + 1e-3 * wall_.size;
      search_.near(d, reach, near);
      search_.feet(d, reach, near.data(), static_cast<int>(near.size()), feet);
      ours += seconds_since(start);
      double least = 1e300;
      for (const brep::Foot& foot : feet) least = std::min(least, foot.distance);
      const double off = least - distance;
      if (std::abs(off) <= tolerance_) {
        worst_ = std::max(worst_, std::abs(off));
        continue;
      }
      if (off < 0.0 && is_on_wall(feet, least)) {  // a nearer point that OpenCASCADE does not see
        ++theirs_missed;
        continue;
      }
      ++missed;
      if (missed <= 5)
        fmt::print("  ({:.17g}, {:.17g}, {:.17g}): {} feet, nearest at {:.12g}, OpenCASCADE's at {:.12g}\n",
                   d[0], d[1], d[2], feet.size(), least, distance);
    }
    fmt::print(
        "{} faces, {} edges, size {:.4g}: {} points, {} missed, {} by OpenCASCADE, most {:.3g} (tolerance "
        "{:.2g}); {:.2f} us ours, {:.1f} OpenCASCADE's\n",
        wall_.faces.size(), wall_.edges.size(), wall_.size, points, missed, theirs_missed, worst_, tolerance_,
        1e6 * ours / points, 1e6 * theirs / points);
    misses_ += missed;
  }
  int misses() const { return misses_; }

 private:
  bool is_on_wall(const std::vector<brep::Foot>& feet, double distance) const {
    for (const brep::Foot& foot : feet)
      if (foot.distance == distance)
        return judge_.nearest({foot.point[0], foot.point[1], foot.point[2]}).distance <= tolerance_;
    return false;
  }

  // Near a face, near an edge, near a vertex, anywhere.
  Vector3 point(int k) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Vector3 off = 0.02 * wall_.size * Vector3(uniform(random_), uniform(random_), uniform(random_));
    const auto any = [&](size_t count) { return random_() % count; };
    if (k % 4 == 3 || wall_.vertices.empty()) {
      const Vector3 half = 0.6 * (wall_.high - wall_.low);
      return 0.5 * (wall_.low + wall_.high) +
             Vector3(half[0] * uniform(random_), half[1] * uniform(random_), half[2] * uniform(random_));
    }
    if (k % 4 == 2) return wall_.vertices[any(wall_.vertices.size())].point + off;
    if (k % 4 == 1) {
      const brep::Edge& edge = wall_.edges[any(wall_.edges.size())];
      return brep::at_part(wall_, edge, 0.5 + 0.5 * uniform(random_)).point + off;
    }
    const auto face = static_cast<int>(any(wall_.faces.size()));
    const brep::TrimDomain& domain = wall_.domains[face];
    for (int tries = 0; tries < 1000; ++tries) {
      brep::Parameter<2> xi;
      for (int i = 0; i < 2; ++i)
        xi[i] = domain.low()[i] + (0.5 + 0.5 * uniform(random_)) * (domain.high()[i] - domain.low()[i]);
      if (domain.inside(xi)) return brep::point_on(wall_, face, xi) + off;
    }
    return wall_.vertices[0].point + off;
  }

  brep::Surface wall_;
  brep::FootSearch search_;
  step_parts::OcctJudge judge_;
  std::mt19937 random_;
  double worst_ = 0.0;
  // That of edges, which may be farther off their faces than the file says; OpenCASCADE measures to edges,
  // too.
  double tolerance_ = std::max({1e-9 * wall_.size, judge_.tolerance(),
                                *std::max_element(wall_.edge_slack.begin(), wall_.edge_slack.end())});
  int misses_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  int points = 200;
  unsigned seed = 1;
  CLI::App app("Feet on CAD files against OpenCASCADE's distances");
  app.add_option("files", files, "STEP or IGES")->required();
  app.add_option("--points", points, "for each file");
  app.add_option("--seed", seed, "of the random numbers");
  CLI11_PARSE(app, argc, argv);
  int misses = 0;
  for (const std::string& file : files) {
    try {
      fmt::print("{}: ", file);
      Trial trial(file, seed);
      trial.run(points);
      misses += trial.misses();
    } catch (const std::exception& error) {
      fmt::print("{}\n", error.what());
      ++misses;
    }
  }
  return misses == 0 ? 0 : 1;
}

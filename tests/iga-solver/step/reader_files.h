// SPDX-License-Identifier: GPL-2.0-or-later
// What tests of the reader share: a folder for their parts, and what holds for every border.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "geometry_io/any_spline.h"
#include "geometry_io/cad_measures.h"
#include "read_plainly.h"

namespace step_parts {

class Files : public testing::Test {
 public:
  ~Files() override { std::filesystem::remove_all(folder_); }

 protected:
  Files() : folder_(testing::TempDir() + "step_reader." + std::to_string(getpid())) {
    step_parts::silence();
    std::filesystem::create_directories(folder_);
  }

  std::string path(const std::string& file) const { return folder_ + "/" + file; }
  std::string bytes(const std::string& file) const {
    std::stringstream all;
    all << std::ifstream(path(file)).rdbuf();
    return all.str();
  }

 private:
  const std::string folder_;
};

inline Eigen::Vector2d end_of(const brep::Trim& trim) {
  return trim.curve.points.col(trim.curve.points.cols() - 1);
}

// Loops are closed, trims lie on their edges, and run as `forward` says.
inline void check_borders(const brep::CadModel& model, const brep::CadFace& face) {
  for (const brep::Loop& loop : face.loops)
    for (size_t i = 0; i < loop.size(); ++i) {
      const brep::Trim& trim = loop[i];
      EXPECT_EQ(end_of(trim), Eigen::Vector2d(loop[(i + 1) % loop.size()].curve.points.col(0)));
      if (trim.edge < 0) continue;
      const brep::CadEdge& edge = model.edges[trim.edge];
      const geometry_io::AnySpline curve = geometry_io::homogeneous(trim.curve);
      const auto on_face = [&](double part) {
        const Eigen::VectorXd p = curve.point(curve.begin() + part * (curve.end() - curve.begin()));
        return geometry_io::point_of(model, face, {p(0), p(1)});
      };
      for (int k = 0; k <= 4; ++k)
        EXPECT_LE(geometry_io::distance_to(edge, on_face(0.25 * k)), 1.02 * edge.tolerance + 1e-9);
      ASSERT_GE(edge.vertex[0], 0);
      const brep::CadVertex& start = model.vertices[edge.vertex[trim.forward ? 0 : 1]];
      EXPECT_LE((on_face(0.0) - start.point).norm(), 1e-9 + start.tolerance + edge.tolerance);
    }
}

}  // namespace step_parts

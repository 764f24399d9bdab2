// SPDX-License-Identifier: GPL-2.0-or-later
// Feet of points on walls of faces in closed form by brute force: minima of each face from a grid of its
// parameters; what counts where faces meet says the judge of triangles, on the planes that touch them there.
#pragma once

#include "face_grid.h"
#include "judge.h"

namespace brep::trials {

class MixedJudge final : public AnyJudge {
 public:
  /// Borders of faces coincide as a whole, and no edge is nearly but not quite smooth.
  MixedJudge(const std::vector<Face>& faces, double edge_angle);

  std::vector<Minimum> minima(const Vector3& d, double reach, double tolerance,
                              const std::vector<Vector3>& also = {}) const override;
  /// Of a face and a side (0: where its normal points to).
  int sheet(int face, int side) const { return sheets_[2 * face + side]; }

 private:
  // What is round a point: triangles that touch the faces there.
  struct Round {
    Wall wall;
    std::vector<int> face;  // of each triangle
    int inside = -1;        // the face that it is inside
    Parameter<2> xi{0.0, 0.0};
  };
  Round round(const Vector3& p) const;
  void add_sector(int face, const Vector3& p, const Parameter<2>& xi, Round& round) const;
  void join_sides(int face);
  void add_at(const Vector3& p, const Vector3& d, double angle, std::vector<Minimum>& found) const;

  std::vector<Face> faces_;
  std::vector<Grid> grids_;
  double edge_angle_;
  std::vector<int> sheets_;
};

}  // namespace brep::trials

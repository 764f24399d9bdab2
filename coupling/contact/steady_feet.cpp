// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/steady_feet.h"

#include <algorithm>
#include <cmath>

namespace contact {

void SteadyFeet::keep(int candidate, int piece, int face, int side, const nurbs::Vector3& centre,
                      double reach, double margin, const nurbs::Parameter<2>& xi) {
  Rest& rest = rests_[candidate];
  rest.centre = centre;
  rest.reach = reach, rest.margin = margin;
  rest.sign = side;
  rest.piece = piece, rest.face = face;
  rest.marks.side = static_cast<std::int8_t>(charts_ ? (*charts_)[face].side * side : side);
  rest.marks.is_curved = !search_.triangle(piece).exists();
  rest.marks.is_settled = false;
  if (!followed_.empty()) followed_[candidate] = xi;
}

void SteadyFeet::find() {
  bring_into_frame();
  find_in_frame();
  if (is_turned_) turn_into_space();
}

void SteadyFeet::find_in_frame() {
  for (int k = 0; k < count_; ++k) room_[k] = room_to_move(k);
  if (curved_count_ < count_) find_on_planes();
  if (curved_count_ == count_ && find_on_one_cylinder()) return;
  for (int n = 0; n < curved_count_; ++n) find_on_curved(curved_[n]);
}

bool SteadyFeet::is_one_face() const {
  int others = 0;
  for (int k = 1; k < count_; ++k) others |= face_[k] ^ face_[0];
  return others == 0;
}

void SteadyFeet::bring_into_frame() {
  const double origin[3] = {frame_->origin[0], frame_->origin[1], frame_->origin[2]};
  for (int k = 0; k < count_; ++k) {
    centre_[0][k] -= origin[0];
    centre_[1][k] -= origin[1];
    centre_[2][k] -= origin[2];
  }
  if (!is_turned_) return;
  const Eigen::Matrix3d R = frame_->rotation;
  for (int k = 0; k < count_; ++k) {
    const double x = centre_[0][k], y = centre_[1][k], z = centre_[2][k];
    centre_[0][k] = R(0, 0) * x + R(1, 0) * y + R(2, 0) * z;
    centre_[1][k] = R(0, 1) * x + R(1, 1) * y + R(2, 1) * z;
    centre_[2][k] = R(0, 2) * x + R(1, 2) * y + R(2, 2) * z;
  }
}

void SteadyFeet::turn_into_space() {
  const Eigen::Matrix3d R = frame_->rotation;
  for (int k = 0; k < count_; ++k) {
    const double x = delta_[0][k], y = delta_[1][k], z = delta_[2][k];
    delta_[0][k] = R(0, 0) * x + R(0, 1) * y + R(0, 2) * z;
    delta_[1][k] = R(1, 0) * x + R(1, 1) * y + R(1, 2) * z;
    delta_[2][k] = R(2, 0) * x + R(2, 1) * y + R(2, 2) * z;
  }
}

// It may have grown or shrunk.
inline double SteadyFeet::room_to_move(int k) const {
  const double margin = std::min(reach_[k] - touch_reach_[k], margin_[k]);
  const double x = centre_[0][k] - before_[0][k], y = centre_[1][k] - before_[1][k],
               z = centre_[2][k] - before_[2][k];
  return margin * std::abs(margin) - (x * x + y * y + z * z);
}

struct SteadyFeet::OnePlane {
  nurbs::Vector3 o, a, b, n;
  double c[2], e[2];
  double origin(int d, int) const { return o[d]; }
  double x(int d, int) const { return a[d]; }
  double y(int d, int) const { return b[d]; }
  double normal(int d, int) const { return n[d]; }
  double scale(int i, int) const { return c[i]; }
  double shift(int i, int) const { return e[i]; }
};

struct SteadyFeet::EachItsPlane {
  const SteadyFeet& of;
  double origin(int d, int k) const { return of.origin_[d][k]; }
  double x(int d, int k) const { return of.x_[d][k]; }
  double y(int d, int k) const { return of.y_[d][k]; }
  double normal(int d, int k) const {
    const int i = (d + 1) % 3, j = (d + 2) % 3;
    return x(i, k) * y(j, k) - x(j, k) * y(i, k);
  }
  double scale(int i, int k) const { return of.scale_[i][k]; }
  double shift(int i, int k) const { return of.shift_[i][k]; }
};

void SteadyFeet::find_on_planes() {
  if (is_one_face()) {
    const brep::PlaneTriangle& plane = search_.triangle(piece_[0]);
    OnePlane all{plane.origin(), plane.x(), plane.y(), plane.normal(), {1.0, 1.0}, {0.0, 0.0}};
    for (int i = 0; i < 2 && charts_; ++i) {
      const brep::ChartLine& line = (*charts_)[face_[0]].line[i];
      all.c[i] = line.scale(), all.e[i] = line.shift();
    }
    return find_over(all);
  }
  for (int k = 0; k < count_; ++k) {
    if (marks_[k].is_curved) continue;
    const brep::PlaneTriangle& plane = search_.triangle(piece_[k]);
    for (int d = 0; d < 3; ++d)
      origin_[d][k] = plane.origin()[d], x_[d][k] = plane.x()[d], y_[d][k] = plane.y()[d];
    for (int i = 0; i < 2; ++i) {
      scale_[i][k] = charts_ ? (*charts_)[face_[k]].line[i].scale() : 1.0;
      shift_[i][k] = charts_ ? (*charts_)[face_[k]].line[i].shift() : 0.0;
    }
  }
  find_over(EachItsPlane{*this});
}

// In the order in which brep::PlaneTriangle adds up.
template <class Planes>
inline void SteadyFeet::find_over(const Planes& planes) {
  for (int k = 0; k < count_; ++k) {
    const double x = centre_[0][k] - planes.origin(0, k), y = centre_[1][k] - planes.origin(1, k),
                 z = centre_[2][k] - planes.origin(2, k);
    const auto along = [=](double a, double b, double c) { return a * x + b * y + c * z; };
    const double n[3] = {planes.normal(0, k), planes.normal(1, k), planes.normal(2, k)};
    const double height = along(n[0], n[1], n[2]);
    const double u = along(planes.x(0, k), planes.x(1, k), planes.x(2, k)),
                 v = along(planes.y(0, k), planes.y(1, k), planes.y(2, k));
    delta_[0][k] = centre_[0][k] - (centre_[0][k] - height * n[0]);
    delta_[1][k] = centre_[1][k] - (centre_[1][k] - height * n[1]);
    delta_[2][k] = centre_[2][k] - (centre_[2][k] - height * n[2]);
    xi_[0][k] = u * planes.scale(0, k) + planes.shift(0, k);
    xi_[1][k] = v * planes.scale(1, k) + planes.shift(1, k);
    distance_[k] = sign_[k] * height;
    room_[k] = std::min(room_[k], std::min(distance_[k], touch_reach_[k] - distance_[k]));
  }
}

// As brep::Face::polar_foot and brep::Chart::place have it, if all are on the same that has a chart.
bool SteadyFeet::find_on_one_cylinder() {
  const brep::Face& face = search_.surface().faces[face_[0]];
  if (!charts_ || face.kind != brep::Kind::cylinder || !is_one_face()) return false;
  const brep::Frame frame = face.frame;
  const double R = face.R, least = brep::kOnAxis * R;
  const auto along = [](const nurbs::Vector3& a, double x, double y, double z) {
    return a[0] * x + a[1] * y + a[2] * z;
  };
  for (int k = 0; k < count_; ++k) {
    const double x = centre_[0][k] - frame.origin[0], y = centre_[1][k] - frame.origin[1],
                 z = centre_[2][k] - frame.origin[2];
    cos_[k] = along(frame.x, x, y, z), sin_[k] = along(frame.y, x, y, z);
    length_[k] = along(frame.z, x, y, z);
    from_axis_[k] = cos_[k] * cos_[k] + sin_[k] * sin_[k];
  }
  Eigen::Map<Eigen::ArrayXd> from_axis(from_axis_, count_);
  from_axis = from_axis.sqrt();  // std::sqrt may set errno, which no vector instruction does
  for (int k = 0; k < count_; ++k) {
    const double inverse = 1.0 / from_axis_[k];
    cos_[k] *= inverse, sin_[k] *= inverse;
    distance_[k] = sign_[k] * (from_axis_[k] - R);
    room_[k] = std::min(room_[k], std::min(distance_[k], touch_reach_[k] - distance_[k]));
    room_[k] = std::min(room_[k], from_axis_[k] - least);
  }
  for (int k = 0; k < count_; ++k) {
    const auto delta = [&](int d, double centre) {
      return centre -
             (frame.origin[d] + R * (cos_[k] * frame.x[d] + sin_[k] * frame.y[d]) + length_[k] * frame.z[d]);
    };
    delta_[0][k] = delta(0, centre_[0][k]);
    delta_[1][k] = delta(1, centre_[1][k]);
    delta_[2][k] = delta(2, centre_[2][k]);
  }
  const brep::Chart& chart = (*charts_)[face_[0]];
  chart.line[0].place_angles(count_, cos_, sin_, xi_[0], inside_[0]);
  chart.line[1].place_lengths(count_, length_, xi_[1], inside_[1]);
  for (int k = 0; k < count_; ++k) room_[k] = std::min(room_[k], std::min(inside_[0][k], inside_[1][k]));
  return true;
}

void SteadyFeet::find_on_curved(int k) {
  room_[k] = room_to_move(k);
  if (!(room_[k] > 0.0)) return;
  const nurbs::Vector3 centre(centre_[0][k], centre_[1][k], centre_[2][k]);
  search::Foot foot;
  if (!followed_.empty()) foot.xi = followed_[candidate_[k]];
  const int side = search_.foot_inside_curved(piece_[k], centre, touch_reach_[k], charts_, foot);
  if (side != sign_[k]) {
    room_[k] = 0.0;
    return;
  }
  if (!followed_.empty()) followed_[candidate_[k]] = foot.xi;
  for (int d = 0; d < 3; ++d) delta_[d][k] = centre[d] - foot.point[d];
  distance_[k] = foot.distance;
  for (int i = 0; i < 2; ++i) xi_[i][k] = foot.xi[i];
}

}  // namespace contact

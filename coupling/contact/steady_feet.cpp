// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/steady_feet.h"

#include <algorithm>
#include <cmath>

namespace contact {

SteadyFeet::SteadyFeet(const brep::FootSearch& search, const FaceNames& names)
    : search_(search),
      names_(names),
      charts_(names.charts),
      waits_for_memory_(search.outgrows_cache()),
      kernel_(feet_kernel(nurbs::simd_level())),
      face_kernel_(face_kernel(nurbs::simd_level())) {
  if (!charts_ && search.surface().trimmed())
    for (const brep::Face& face : search.surface().faces) faces_.push_back(FaceNumbers::of(face));
}

void SteadyFeet::set(Rest& rest, const Room& room, int piece, int face, int side) {
  rest.centre = room.centre;
  rest.reach = room.reach, rest.margin = room.margin;
  rest.sign = static_cast<float>(side);
  rest.piece = piece, rest.face = face;
  rest.feet = 1;
}

void SteadyFeet::keep(int candidate, const Room& room, int piece, const brep::Foot& foot,
                      const nurbs::Vector3& centre) {
  Rest& rest = rests_[candidate];
  set(rest, room, piece, foot.patch, foot.side);
  rest.marks = {of_patch(foot.patch, foot.side), kNone, 0, !search_.triangle(piece).exists()};
  if (!followed_.empty()) followed_[candidate] = {foot.xi, centre - foot.point};
}

void SteadyFeet::keep(int candidate, const Room& room, const std::vector<brep::Foot>& feet,
                      const int* pieces) {
  const int count = static_cast<int>(feet.size());
  NURBS_ASSERT(0 < count && count <= kMostFeet, count);
  Rest& rest = rests_[candidate];
  if (count > 1 && rest.further < 0) {
    rest.further = static_cast<std::int32_t>(further_.size());
    further_.resize(further_.size() + kMostFeet - 1);
  }
  for (int k = 0; k < count; ++k) {
    Rest& own = k == 0 ? rest : further_[rest.further + k - 1];
    set(own, room, pieces[k], feet[k].patch, feet[k].side);
    own.marks = {of_patch(feet[k].patch, feet[k].side), kNone, static_cast<std::int8_t>(k), false};
  }
  rest.feet = count;
}

void SteadyFeet::go_on(int candidate, int before, const nurbs::Vector3& centre, double known) {
  const Rest& old = rests_before_[before];
  if (old.piece < 0) return;
  const double reach = std::min(old.reach, known - (old.centre - centre).norm());
  Rest& rest = rests_[candidate];
  rest = old;
  rest.further = kNone;
  if (old.feet > 1) {
    rest.further = static_cast<std::int32_t>(further_.size());
    const auto first = further_before_.begin() + old.further;
    further_.insert(further_.end(), first, first + kMostFeet - 1);
  }
  for (int k = 0; k < rest.feet; ++k) {
    Rest& own = k == 0 ? rest : further_[rest.further + k - 1];
    own.reach = reach;
    own.marks.slot = kNone;  // somebody may have looked at the particle's memory meanwhile
  }
}

int SteadyFeet::add_group(int particle, const double* x, const double* v, double touch_reach,
                          const Rest& rest) {
  const int first = block_.count - 1, candidate = candidate_[first];
  for (int k = 1; k < rest.feet; ++k)
    add_line(candidate, particle, x, v, touch_reach, further_[rest.further + k - 1]);
  groups_[group_count_++] = {first, rest.feet};
  return rest.feet;
}

void SteadyFeet::find(const StepNumbers& step) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = frame_->rotation;
  kernel_.into_frame(block_, frame_->origin.data(), is_turned_ ? R.data() : nullptr);
  find_in_frame();
  if (is_turned_) kernel_.into_space(block_, R.data());
  kernel_.stay_outside(block_, step);
  for (const Group& group : *this) bring_together(group);
}

// Their order is that of a search, which forces are added in: the nearest is the first.
void SteadyFeet::bring_together(const Group& group) {
  const int first = group.first;
  double room = block_.room[first];
  for (int k = first + 1; k < first + group.count; ++k) {
    room = std::min(room, block_.room[k]);
    if (!(block_.distance[k - 1] < block_.distance[k])) room = 0.0;
  }
  std::fill_n(block_.room + first, group.count, room);
}

void SteadyFeet::find_in_frame() {
  kernel_.room_to_move(block_);
  if (!faces_.empty()) return find_on_faces();
  if (curved_count_ < block_.count) find_on_planes();
  if (curved_count_ == block_.count && find_on_one_cylinder()) return;
  for (int n = 0; n < curved_count_; ++n) find_on_chart(curved_[n]);
}

bool SteadyFeet::is_one_face() const {
  int others = 0;
  for (int k = 1; k < block_.count; ++k) others |= face_[k] ^ face_[0];
  return others == 0;
}

namespace {

void copy(const nurbs::Vector3& from, double (&to)[3]) { nurbs::Vector3::Map(to) = from; }

}  // namespace

void SteadyFeet::find_on_planes() {
  if (is_one_face()) {
    const brep::PlaneTriangle& plane = search_.triangle(piece_[0]);
    PlaneNumbers all{{}, {}, {}, {}, {1.0, 1.0}, {0.0, 0.0}};
    copy(plane.origin(), all.origin), copy(plane.x(), all.x), copy(plane.y(), all.y);
    copy(plane.normal(), all.normal);
    for (int i = 0; i < 2 && charts_; ++i) {
      const brep::ChartLine& line = (*charts_)[face_[0]].line[i];
      all.scale[i] = line.scale(), all.shift[i] = line.shift();
    }
    return kernel_.over_one_plane(block_, all);
  }
  for (int k = 0; k < block_.count; ++k) {
    if (marks_[k].is_curved) continue;
    const brep::PlaneTriangle& plane = search_.triangle(piece_[k]);
    for (int d = 0; d < 3; ++d) {
      block_.origin[d][k] = plane.origin()[d];
      block_.x[d][k] = plane.x()[d], block_.y[d][k] = plane.y()[d];
    }
    for (int i = 0; i < 2; ++i) {
      block_.scale[i][k] = charts_ ? (*charts_)[face_[k]].line[i].scale() : 1.0;
      block_.shift[i][k] = charts_ ? (*charts_)[face_[k]].line[i].shift() : 0.0;
    }
  }
  kernel_.over_planes(block_);
}

// As brep::Chart::place has it, if all are on the same that has a chart.
bool SteadyFeet::find_on_one_cylinder() {
  const brep::Face& face = search_.surface().faces[face_[0]];
  if (!charts_ || face.kind != brep::Kind::cylinder || !is_one_face()) return false;
  CylinderNumbers numbers{{}, {}, {}, {}, face.R, brep::kOnAxis * face.R};
  copy(face.frame.origin, numbers.origin), copy(face.frame.x, numbers.x);
  copy(face.frame.y, numbers.y), copy(face.frame.z, numbers.z);
  kernel_.over_one_cylinder(block_, numbers);
  const brep::Chart& chart = (*charts_)[face_[0]];
  chart.line[0].place_angles(block_.count, block_.cos, block_.sin, block_.xi[0], inside_[0]);
  chart.line[1].place_lengths(block_.count, block_.length, block_.xi[1], inside_[1]);
  for (int k = 0; k < block_.count; ++k)
    block_.room[k] = std::min(block_.room[k], std::min(inside_[0][k], inside_[1][k]));
  return true;
}

// What planes have made of its room is not meant for it.
void SteadyFeet::find_on_chart(int k) {
  const nurbs::Vector3 centre(block_.centre[0][k], block_.centre[1][k], block_.centre[2][k]);
  const double margin = block_.margin[k];
  block_.room[k] = margin * std::abs(margin) - (centre - rests_[candidate_[k]].centre).squaredNorm();
  if (!(block_.room[k] > 0.0)) return;
  search::Foot foot;
  const int side = search_.foot_inside_curved(piece_[k], centre, block_.touch_reach[k], charts_, foot);
  if (side != block_.sign[k]) {
    block_.room[k] = 0.0;
    return;
  }
  for (int d = 0; d < 3; ++d) block_.delta[d][k] = centre[d] - foot.point[d];
  block_.distance[k] = foot.distance;
  for (int i = 0; i < 2; ++i) block_.xi[i][k] = foot.xi[i];
}

// Of trimmed faces, whose borders are out of reach.
void SteadyFeet::find_on_faces() {
  FaceBlock& on = on_faces_;
  int line[kBlock], closed = 0;
  for (int k = 0; k < block_.count; ++k) {
    if (search_.surface().faces[face_[k]].kind == brep::Kind::nurbs) {
      find_on_patch(k);
      continue;
    }
    const double* const numbers = faces_[face_[k]].value;
    for (int i = 0; i < FaceNumbers::count; ++i) on.face[i][closed] = numbers[i];
    for (int d = 0; d < 3; ++d) on.centre[d][closed] = block_.centre[d][k];
    on.sign[closed] = block_.sign[k];
    on.touch_reach[closed] = block_.touch_reach[k], on.room[closed] = block_.room[k];
    line[closed++] = k;
  }
  on.count = closed;
  face_kernel_(on);
  for (int n = 0; n < closed; ++n) {
    const int k = line[n];
    for (int d = 0; d < 3; ++d) block_.delta[d][k] = on.delta[d][n];
    for (int i = 0; i < 2; ++i) block_.xi[i][k] = on.xi[i][n];
    block_.distance[k] = on.distance[n], block_.room[k] = on.room[n];
  }
}

// As long as it is near one foot nothing but its side of the surface may change.
void SteadyFeet::find_on_patch(int k) {
  if (!(block_.room[k] > 0.0)) return;
  const nurbs::Vector3 centre(block_.centre[0][k], block_.centre[1][k], block_.centre[2][k]);
  Followed& followed = followed_[candidate_[k]];
  const search::Foot foot = search_.foot_on_patch(face_[k], centre, followed.xi);
  const nurbs::Vector3 up = centre - foot.point;
  if (foot.status != search::FootStatus::interior || !(foot.distance < block_.touch_reach[k]) ||
      !(up.dot(followed.up) > 0.0)) {
    block_.room[k] = 0.0;
    return;
  }
  followed.xi = foot.xi;
  for (int d = 0; d < 3; ++d) block_.delta[d][k] = up[d];
  block_.distance[k] = foot.distance;
  for (int i = 0; i < 2; ++i) block_.xi[i][k] = foot.xi[i];
}

}  // namespace contact

// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/contact/steady_feet.h"

#include <algorithm>
#include <cmath>

namespace contact {

SteadyFeet::SteadyFeet(const brep::FootSearch& search, const FaceNames& names)
    : search_(search),
      names_(names),
      charts_(names.charts),
      kernel_(feet_kernel(nurbs::simd_level())),
      face_kernel_(face_kernel(nurbs::simd_level())) {
  if (!charts_ && search.surface().trimmed())
    for (const brep::Face& face : search.surface().faces) faces_.push_back(FaceNumbers::of(face));
}

/* ---------------------------------------------------------------------- what is kept of candidates */

SteadyFeet::Page::Page() {
  std::fill_n(piece, kBlock, kNone);
  std::fill_n(face, kBlock, kNone), std::fill_n(patch, kBlock, kNone);
  std::fill_n(marks, kBlock, Marks());
  std::fill_n(further, kBlock, kNone);
  std::fill_n(kept.margin, kBlock, kAway);
}

void SteadyFeet::Page::set(int k, const Room& room, const Under& under, int side_of_face,
                           const Marks& of_foot) {
  count += piece[k] < 0;
  for (int d = 0; d < 3; ++d) kept.centre[d][k] = room.centre[d];
  kept.reach[k] = room.reach, kept.margin[k] = room.margin;
  kept.sign[k] = side_of_face;
  piece[k] = under.piece, face[k] = under.face, patch[k] = under.patch;
  marks[k] = of_foot;
  below.is_known = false;
}

SteadyFeet::Ground SteadyFeet::ground_of(On on, int piece, int face) const {
  if (on == On::plane) return plane_ground(piece, face);
  return on == On::edge ? edge_ground(piece, face) : Ground();
}

SteadyFeet::Ground SteadyFeet::plane_ground(int piece, int face) const {
  const brep::PlaneTriangle& plane = search_.triangle(piece);
  Ground ground{plane.origin(), plane.x(), plane.y(), {1.0, 1.0}, {0.0, 0.0}};
  for (int i = 0; i < 2 && charts_; ++i) {
    const brep::ChartLine& line = (*charts_)[face].line[i];
    ground.scale[i] = line.scale(), ground.shift[i] = line.shift();
  }
  return ground;
}

SteadyFeet::Ground SteadyFeet::edge_ground(int number, int face) const {
  const brep::Edge& edge = search_.surface().edges[number];
  const auto on_patch = [&](double along) {
    return names_.on_patch(face, search_.surface().faces[face].in_plane(edge.point(along)));
  };
  const nurbs::Parameter<2> start = on_patch(0.0), end = on_patch(edge.length);
  Ground ground{edge.origin, edge.axis, nurbs::Vector3::Zero(), {}, {start[0], start[1]}};
  for (int i = 0; i < 2; ++i) ground.scale[i] = (end[i] - start[i]) / edge.length;
  return ground;
}

void SteadyFeet::Ground::copy_to(KeptFeet& kept, int k) const {
  for (int d = 0; d < 3; ++d) kept.origin[d][k] = origin[d], kept.x[d][k] = x[d], kept.y[d][k] = y[d];
  for (int i = 0; i < 2; ++i) kept.scale[i][k] = scale[i], kept.shift[i][k] = shift[i];
}

void SteadyFeet::set(Page& page, int k, const Room& room, int piece, int face, int side,
                     const Marks& marks) const {
  page.set(k, room, {piece, face, names_.patch_of(face)}, side, marks);
  if (marks.on != On::curved) ground_of(marks.on, piece, face).copy_to(page.kept, k);
}

void SteadyFeet::Page::forget(int k) {
  if (piece[k] < 0) return;
  piece[k] = kNone;
  kept.margin[k] = kAway;
  --count;
  below.is_known = false;
}

void SteadyFeet::Page::look_below() {
  below = Below();
  below.is_known = below.is_one_face = true;
  below.first = static_cast<int>(std::find_if(piece, piece + kBlock, [](int of) { return of >= 0; }) - piece);
  for (int k = below.first; k < kBlock; ++k) {
    if (piece[k] < 0) continue;
    below.is_one_face &= face[k] == face[below.first] && marks[k].on == marks[below.first].on;
    (marks[k].on == On::plane ? below.has_planes : below.has_others) = true;
    below.has_several |= marks[k].kept > 1;
  }
}

void SteadyFeet::forget_all(std::size_t candidates) {
  pages_.swap(pages_before_), further_.swap(further_before_);
  pages_.assign((candidates + kBlock - 1) / kBlock, Page());
  further_.clear();
  if (search_.surface().patches) followed_.resize(candidates);
}

void SteadyFeet::keep(int candidate, const Room& room, int piece, const brep::Foot& foot,
                      const nurbs::Vector3& centre) {
  set(page_of(candidate), line_of(candidate), room, piece, foot.patch, foot.side,
      {kNone, 1, 1, search_.triangle(piece).exists() ? On::plane : On::curved});
  if (!followed_.empty()) followed_[candidate] = {foot.xi, centre - foot.point};
}

// The place of a candidate's further feet.
int SteadyFeet::room_for_others() {
  const std::size_t first = further_.size();
  further_.resize(first + kMostFeet - 1);
  return static_cast<int>(first);
}

void SteadyFeet::keep(int candidate, const Room& room, const std::vector<brep::Foot>& feet, int touching,
                      const int* pieces) {
  const int count = static_cast<int>(feet.size()), k = line_of(candidate);
  NURBS_ASSERT(0 < touching && touching <= count && count <= kMostFeet, touching, count);
  Page& page = page_of(candidate);
  const auto marks = [&](const brep::Foot& foot) {
    return Marks{kNone, static_cast<std::uint8_t>(touching & 15), static_cast<std::uint8_t>(count & 15),
                 foot.status == search::FootStatus::edge ? On::edge : On::plane};
  };
  set(page, k, room, pieces[0], feet[0].patch, feet[0].side, marks(feet[0]));
  if (count > 1 && page.further[k] < 0) page.further[k] = room_for_others();
  for (int n = 1; n < count; ++n) {
    const Marks of_foot = marks(feet[n]);
    further_[page.further[k] + n - 1] = {room.centre,
                                         room.reach,
                                         room.margin,
                                         static_cast<double>(feet[n].side),
                                         ground_of(of_foot.on, pieces[n], feet[n].patch),
                                         pieces[n],
                                         feet[n].patch,
                                         of_foot};
  }
}

void SteadyFeet::go_on(int candidate, int before, const nurbs::Vector3& centre, double known) {
  const Page& old = pages_before_[before / kBlock];
  const int from = line_of(before), k = line_of(candidate);
  if (old.piece[from] < 0) return;
  const nurbs::Vector3 then(old.kept.centre[0][from], old.kept.centre[1][from], old.kept.centre[2][from]);
  const double reach = std::min(old.kept.reach[from], known - (then - centre).norm());
  Page& page = page_of(candidate);
  Marks marks = old.marks[from];
  marks.slot = kNone;  // somebody may have looked at the particle's memory meanwhile
  set(page, k, {then, reach, old.kept.margin[from]}, old.piece[from], old.face[from],
      static_cast<int>(old.kept.sign[from]), marks);
  if (marks.kept == 1) return;
  page.further[k] = room_for_others();
  for (int n = 0; n < marks.kept - 1; ++n) {
    Further& own = further_[page.further[k] + n] = further_before_[old.further[from] + n];
    own.reach = reach;
    own.marks.slot = kNone;
  }
}

/* ---------------------------------------------------------------------- one block */

bool SteadyFeet::begin_block(int first, int count, const coupling::RigidFrame& frame, bool is_turned) {
  NURBS_ASSERT(first % kBlock == 0 && count <= kBlock, first, count);
  first_ = first;
  page_ = &page_of(first);
  frame_ = &frame;
  is_turned_ = is_turned;
  block_.count = count;
  std::fill_n(block_.touch_reach, count, kAway);
  others_.count = several_count_ = 0;
  has_other_edges_ = false;
  return page_->count > 0;
}

void SteadyFeet::add_others() {
  for (int k = 0; k < block_.count; ++k)
    if (page_->marks[k].kept > 1 && has(k) && block_.touch_reach[k] >= 0.0) add_others(k);
}

// Those for which there is no room are not there.
void SteadyFeet::add_others(int k) {
  const int count = page_->marks[k].kept - 1;
  if (others_.count + count > kBlock) {
    block_.touch_reach[k] = kAway;
    return;
  }
  several_[several_count_++] = k;
  first_other_[k] = others_.count;
  for (int n = 0; n < count; ++n) {
    const Further& own = further_[page_->further[k] + n];
    const int line = others_.count++;
    for (int d = 0; d < 3; ++d) others_.centre[d][line] = block_.centre[d][k];
    others_.squared_speed[line] = block_.squared_speed[k];
    others_.touch_reach[line] = block_.touch_reach[k];
    for (int d = 0; d < 3; ++d) others_kept_.centre[d][line] = own.centre[d];
    others_kept_.reach[line] = own.reach, others_kept_.margin[line] = own.margin;
    others_kept_.sign[line] = own.sign;
    other_piece_[line] = own.piece, other_face_[line] = own.face;
    other_marks_[line] = own.marks;
    has_other_edges_ |= own.marks.on == On::edge;
    own.ground.copy_to(others_kept_, line);
  }
}

void SteadyFeet::find(const StepNumbers& step) {
  if (!page_->below.is_known) page_->look_below();
  if (page_->below.has_several) add_others();
  find({block_, page_->kept, page_->piece, page_->face, page_->marks, page_->below}, step);
  if (others_.count == 0) return;
  Below below;
  below.has_planes = true, below.has_others = has_other_edges_;
  find({others_, others_kept_, other_piece_, other_face_, other_marks_, below}, step);
  for (int n = 0; n < several_count_; ++n) bring_together(several_[n]);
}

void SteadyFeet::find(const Lines& lines, const StepNumbers& step) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = frame_->rotation;
  kernel_.into_frame(lines.block, frame_->origin.data(), is_turned_ ? R.data() : nullptr);
  find_in_frame(lines);
  if (is_turned_) kernel_.into_space(lines.block, R.data());
  kernel_.stay_outside(lines.block, step);
}

// Of a candidate all feet are there, or none, and those that do not touch stay away.  Their order is that of
// a search, which forces are added in: the nearest is the first.
void SteadyFeet::bring_together(int k) {
  constexpr double kJustTouches = 1.0 + 1e-15;
  const Marks& marks = page_->marks[k];
  double room = block_.room[k], distance = block_.distance[k];
  const int first = first_other_[k];
  for (int n = 1; n < marks.kept; ++n) {
    const int line = first + n - 1;
    if (n < marks.feet) {
      room = std::min(room, others_.room[line]);
      if (!(distance < others_.distance[line])) room = 0.0;
      distance = others_.distance[line];
    } else if (!(others_.distance[line] > kJustTouches * others_.touch_reach[line])) {
      room = 0.0;
    }
  }
  block_.room[k] = room;
}

void SteadyFeet::find_in_frame(const Lines& lines) {
  kernel_.room_to_move(lines.block, lines.kept);
  if (!faces_.empty()) return find_on_faces(lines);
  if (lines.below.has_planes) find_on_planes(lines);
  if (!lines.below.has_others || (!lines.below.has_planes && find_on_one_cylinder(lines))) return;
  for (int k = 0; k < lines.block.count; ++k) {
    if (!lines.has(k))
      lines.block.room[k] = 0.0;
    else if (lines.marks[k].on == On::curved)
      find_on_chart(lines, k);
    else if (lines.marks[k].on == On::edge)
      find_on_edge(lines, k);
  }
}

namespace {

void copy(const nurbs::Vector3& from, double (&to)[3]) { nurbs::Vector3::Map(to) = from; }

}  // namespace

void SteadyFeet::find_on_planes(const Lines& lines) {
  FeetBlock& block = lines.block;
  if (lines.below.is_one_face) {
    const int first = lines.below.first;
    const Ground ground = plane_ground(lines.piece[first], lines.face[first]);
    PlaneNumbers all;
    copy(ground.origin, all.origin), copy(ground.x, all.x), copy(ground.y, all.y);
    copy(search_.triangle(lines.piece[first]).normal(), all.normal);
    std::copy_n(ground.scale, 2, all.scale), std::copy_n(ground.shift, 2, all.shift);
    return kernel_.over_one_plane(block, lines.kept, all);
  }
  kernel_.over_planes(block, lines.kept);
}

// If all are on the same that has a chart.
bool SteadyFeet::find_on_one_cylinder(const Lines& lines) {
  const int number = lines.face[lines.below.first];
  const brep::Face& face = search_.surface().faces[number];
  if (!charts_ || face.kind != brep::Kind::cylinder || !lines.below.is_one_face) return false;
  const brep::Chart& chart = (*charts_)[number];
  CylinderNumbers numbers{
      {}, {}, {}, {}, face.R, brep::kOnAxis * face.R, chart.line[0].numbers(), chart.line[1].numbers()};
  copy(face.frame.origin, numbers.origin), copy(face.frame.x, numbers.x);
  copy(face.frame.y, numbers.y), copy(face.frame.z, numbers.z);
  kernel_.over_one_cylinder(lines.block, lines.kept, numbers);
  return true;
}

// What planes have made of their room is not meant for them.
void SteadyFeet::find_on_chart(const Lines& lines, int k) {
  const nurbs::Vector3 centre = lines.centre(k);
  search::Foot foot;
  const int side =
      search_.foot_inside_curved(lines.piece[k], centre, lines.block.touch_reach[k], charts_, foot);
  set_foot(lines, k, side == lines.kept.sign[k] ? lines.room_to_move(k) : 0.0, centre - foot.point,
           foot.distance, foot.xi);
}

// As brep::EdgeFoot has it.
void SteadyFeet::find_on_edge(const Lines& lines, int k) {
  const KeptFeet& kept = lines.kept;
  const nurbs::Vector3 centre = lines.centre(k),
                       start(kept.origin[0][k], kept.origin[1][k], kept.origin[2][k]),
                       axis(kept.x[0][k], kept.x[1][k], kept.x[2][k]);
  const double along = (centre - start).dot(axis);
  const nurbs::Vector3 delta = centre - (start + along * axis);
  const nurbs::Parameter<2> xi = {kept.shift[0][k] + along * kept.scale[0][k],
                                  kept.shift[1][k] + along * kept.scale[1][k]};
  const double distance = delta.norm(), left = lines.block.touch_reach[k] - distance;
  set_foot(lines, k, std::min(lines.room_to_move(k), left), delta, distance,
           names_.inside(lines.face[k], xi));
}

// As the kernel has it for all.
double SteadyFeet::Lines::room_to_move(int k) const {
  const nurbs::Vector3 then(kept.centre[0][k], kept.centre[1][k], kept.centre[2][k]);
  const double margin = std::min(kept.reach[k] - block.touch_reach[k], kept.margin[k]);
  return margin * std::abs(margin) - (centre(k) - then).squaredNorm();
}

void SteadyFeet::set_foot(const Lines& lines, int k, double room, const nurbs::Vector3& delta,
                          double distance, const nurbs::Parameter<2>& xi) {
  FeetBlock& block = lines.block;
  block.room[k] = room;
  for (int d = 0; d < 3; ++d) block.delta[d][k] = delta[d];
  block.distance[k] = distance;
  for (int i = 0; i < 2; ++i) block.xi[i][k] = xi[i];
}

// Of trimmed faces, whose borders are out of reach.
void SteadyFeet::find_on_faces(const Lines& lines) {
  FeetBlock& block = lines.block;
  FaceBlock& on = on_faces_;
  int line[kBlock], closed = 0;
  for (int k = 0; k < block.count; ++k) {
    if (!lines.has(k)) {
      block.room[k] = 0.0;
      continue;
    }
    if (search_.surface().faces[lines.face[k]].kind == brep::Kind::nurbs) {
      find_on_patch(lines, k);
      continue;
    }
    const double* const numbers = faces_[lines.face[k]].value;
    for (int i = 0; i < FaceNumbers::count; ++i) on.face[i][closed] = numbers[i];
    for (int d = 0; d < 3; ++d) on.centre[d][closed] = block.centre[d][k];
    on.sign[closed] = lines.kept.sign[k];
    on.touch_reach[closed] = block.touch_reach[k], on.room[closed] = block.room[k];
    line[closed++] = k;
  }
  on.count = closed;
  face_kernel_(on);
  for (int n = 0; n < closed; ++n) {
    const int k = line[n];
    for (int d = 0; d < 3; ++d) block.delta[d][k] = on.delta[d][n];
    for (int i = 0; i < 2; ++i) block.xi[i][k] = on.xi[i][n];
    block.distance[k] = on.distance[n], block.room[k] = on.room[n];
  }
}

// As long as it is near one foot nothing but its side of the surface may change.
void SteadyFeet::find_on_patch(const Lines& lines, int k) {
  FeetBlock& block = lines.block;
  if (!(block.room[k] > 0.0)) return;
  const nurbs::Vector3 centre = lines.centre(k);
  Followed& followed = followed_[first_ + k];
  const search::Foot foot = search_.foot_on_patch(lines.face[k], centre, followed.xi);
  const nurbs::Vector3 up = centre - foot.point;
  if (foot.status != search::FootStatus::interior || !(foot.distance < block.touch_reach[k]) ||
      !(up.dot(followed.up) > 0.0)) {
    block.room[k] = 0.0;
    return;
  }
  followed.xi = foot.xi;
  set_foot(lines, k, block.room[k], up, foot.distance, foot.xi);
}

}  // namespace contact

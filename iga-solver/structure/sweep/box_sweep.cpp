// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/sweep/box_sweep.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace structure {

namespace {

/// The direction whose spans fill words best, then the two others in cyclic order.
std::array<int, 3> axes_of(const SpanBox& box, int lanes) {
  int best = 0;
  double most = 0.0;
  for (int d = 0; d < 3; ++d) {
    const int words = (box.spans(d) + lanes - 1) / lanes;
    const double filled = static_cast<double>(box.spans(d)) / (words * lanes);
    if (filled > most + 0.05) {
      best = d;
      most = filled;
    }
  }
  return {best, (best + 1) % 3, (best + 2) % 3};
}

SpanRange range_of(const nurbs::Space<3>& space, const SpanBox& box, int direction) {
  return {space.knots(direction), box.begin[direction], box.end[direction]};
}

/// Whether a row-major K has its only numbers in columns (d + shift) % 3.
bool is_aligned(const std::vector<double>& K, int shift) {
  for (int d = 0; d < 3; ++d)
    for (int j = 0; j < 3; ++j)
      if (j != (d + shift) % 3 && K[3 * d + j] != 0.0) return false;
  return true;
}

}  // namespace

BoxSweep::BoxSweep(const nurbs::Space<3>& space, const PlacedBox& box, std::size_t first_element,
                   const SweepPlan& plan)
    : axes_(axes_of(box.spans, line_kernel(kLowestSweptDegree, plan.level).lanes)),
      rational_(space.rational()),
      x_(range_of(space, box.spans, axes_[0]), plan.rules[axes_[0]],
         line_kernel(kLowestSweptDegree, plan.level).lanes),
      y_(range_of(space, box.spans, axes_[1]), plan.rules[axes_[1]]),
      z_(range_of(space, box.spans, axes_[2]), plan.rules[axes_[2]]),
      row_(x_.row()),
      kernel_x_(&line_kernel(space.degree(axes_[0]), plan.level)),
      kernel_y_(&line_kernel(space.degree(axes_[1]), plan.level)),
      kernel_z_(&line_kernel(space.degree(axes_[2]), plan.level)),
      loops_(&point_loops(plan.geometry.mode, rational_, plan.level)),
      geometry_loops_(&geometry_loops(rational_, plan.level)),
      mode_(plan.geometry.mode),
      field_kernel_(&field_kernel(plan.level)),
      read_(rows_along(axes_, box_node_counts(space, box.spans), box.read())),
      write_(rows_along(axes_, box_node_counts(space, box.spans), box.write())) {
  plane_ = row_ * box_node_counts(space, box.spans)[axes_[1]];
  field_ = row_ * read_.rows();
  if (rational_)
    for (const int node : along(axes_, box_node_counts(space, box.spans), box_nodes(space, box.spans)))
      weights_.push_back(space.weight(node));
  if (plan.geometry.J && mode_ == GeometryMode::affine) {
    const Matrix3 K = plan.geometry.J->inverse();
    for (int d = 0; d < 3; ++d)
      for (int j = 0; j < 3; ++j) affine_.push_back(K(axes_[d], j));
    affine_.push_back(plan.geometry.J->determinant());
    for (int shift = 0; shift < 3; ++shift)
      if (is_aligned(affine_, shift)) loops_ = &aligned_loops(shift, plan.level);
  }
  place_memories(box.spans, first_element, plan);
}

void BoxSweep::place_memories(const SpanBox& box, std::size_t first_element, const SweepPlan& plan) {
  std::size_t points[3], slots = 1;
  for (int d = 0; d < 3; ++d) {
    points[d] = 0;
    for (const nurbs::QuadratureRule& rule : plan.rules[d])
      points[d] = std::max(points[d], rule.points.size());
    slots *= points[d];
  }
  const std::size_t size = plan.state_size;
  const std::size_t elements[3] = {1, std::size_t(box.spans(0)), std::size_t(box.spans(0)) * box.spans(1)};
  const std::size_t slot[3] = {1, points[0], points[0] * points[1]};
  first_memory_ = first_element * slots * size;
  for (int d = 0; d < 3; ++d) {
    element_stride_[d] = elements[axes_[d]] * slots * size;
    point_stride_[d] = slot[axes_[d]] * size;
  }
  const int lanes = kernel_x_->lanes;
  for (int word = 0; word < x_.point_words(); ++word)
    for (int lane = 0; lane < lanes; ++lane) {
      const LaneBases::Place place = x_.place(word, lane);
      offsets_.push_back(place.span * element_stride_[0] + place.point * point_stride_[0]);
    }
}

void BoxSweep::reserve(SweepSpace& space, int further_fields) const {
  const int most = (rational_ ? 7 : 6) + further_fields;  // of recomputed geometry
  grow(space.nodes, most * field_);
  grow(space.forces, 3 * field_);
  grow(space.planes_in, z_.most_points() * 2 * most * plane_);
  grow(space.planes_out, z_.most_points() * 6 * plane_);
  grow(space.rows_in, std::size_t(y_.most_points()) * 3 * most * row_);
  grow(space.rows_out, std::size_t(y_.most_points()) * 9 * row_);
  grow(space.values, std::size_t(x_.point_words()) * 4 * most * kernel_x_->lanes);
  grow(space.scratch, x_.scratch_size(most));
}

void BoxSweep::read(const NodalVectors& values, double* fields) const {
  read_.read(*field_kernel_, values, weights_, fields, field_, row_);
}

void BoxSweep::read_geometry(const NodalVectors& X, double* fields) const {
  read(X, fields);
  if (!rational_) return;
  const double* weight = weights_.data();
  for (double* row = fields + 3 * field_; row < fields + 4 * field_; row += row_, weight += read_.count())
    std::fill(std::copy_n(weight, read_.count(), row), row + row_, 0.0);
}

/// place: span and point in y, then in z.
void BoxSweep::do_points(const std::array<int, 4>& place, Pass& pass, double* values) const {
  const auto [y, y_point, z, z_point] = place;
  PointRow row{values,     x_.point_words(), x_.weights(), y_.weight(y, y_point) * z_.weight(z, z_point),
               pass.table, affine_.data(),   nullptr};
  if (pass.table) pass.table += std::size_t(x_.point_words()) * table_numbers(rational_) * kernel_x_->lanes;
  OutsideLaw outside;
  if (pass.law && pass.law->inlined) row.law = pass.law->inlined;
  if (pass.law && !pass.law->inlined) {
    const PointMemory& memory = pass.law->memory;
    const std::size_t first = first_memory_ + y * element_stride_[1] + y_point * point_stride_[1] +
                              z * element_stride_[2] + z_point * point_stride_[2];
    outside = pass.law->outside;
    outside.state = memory.held ? memory.held + first : nullptr;
    outside.next = memory.next ? memory.next + first : nullptr;
    outside.dt = memory.dt;
    outside.offset = offsets_.data();
    row.law = &outside;
  }
  pass.loop(row, pass.sums);
}

void BoxSweep::sweep_plane(int z, int z_point, Pass& pass, SweepSpace& space) const {
  const LaneBasis x = x_.basis(space.scratch.data());
  const double* const planes_in = space.planes_in.data() + z_point * 2 * pass.fields_in * plane_;
  double* const planes_out = space.planes_out.data() + z_point * 2 * pass.fields_out * plane_;
  const std::size_t stride = std::size_t(pass.fields_in) * (pass.with_value ? 4 : 3) * kernel_x_->lanes;
  for (int span = 0; span < y_.spans(); ++span) {
    const SpanBasis y = y_.at(span);
    const std::size_t first = y_.first(span) * row_;
    kernel_y_->to_rows(y, planes_in + first, row_, plane_, pass.fields_in, space.rows_in.data());
    for (int q = 0; q < y.points; ++q) {
      kernel_x_->to_points(x, space.rows_in.data() + q * 3 * pass.fields_in * row_, pass.fields_in,
                           pass.with_value, space.values.data());
      do_points({span, q, z, z_point}, pass, space.values.data());
      if (pass.fields_out > 0)
        kernel_x_->from_points(x, space.values.data(), stride, pass.fields_out, pass.with_value,
                               space.rows_out.data() + q * 3 * pass.fields_out * row_);
    }
    if (pass.fields_out > 0)
      kernel_y_->from_rows(y, space.rows_out.data(), row_, plane_, pass.fields_out, planes_out + first);
  }
}

void BoxSweep::sweep(Pass& pass, SweepSpace& space) const {
  for (int span = 0; span < z_.spans(); ++span) {
    const SpanBasis z = z_.at(span);
    const std::size_t first = z_.first(span) * plane_;
    kernel_z_->to_planes(z, space.nodes.data() + first, plane_, field_, pass.fields_in,
                         space.planes_in.data());
    for (int q = 0; q < z.points; ++q) sweep_plane(span, q, pass, space);
    if (pass.fields_out > 0)
      kernel_z_->from_planes(z, space.planes_out.data(), plane_, field_, pass.fields_out,
                             space.forces.data() + first);
  }
}

double BoxSweep::tabulate(const NodalVectors& X, SweepSpace& space) {
  std::size_t rows = 1;
  for (const SpanBases* bases : {&y_, &z_}) {
    std::size_t points = 0;
    for (int span = 0; span < bases->spans(); ++span) points += bases->at(span).points;
    rows *= points;
  }
  table_.resize(rows * x_.point_words() * table_numbers(rational_) * kernel_x_->lanes);
  read_geometry(X, space.nodes.data());
  Pass pass{geometry_fields(), 0, rational_, geometry_loops_->tabulate, table_.data()};
  sweep(pass, space);
  return pass.sums.least_det;
}

double BoxSweep::sweep_law(const LawAtPoints& law, const NodalVectors& X,
                           std::initializer_list<const NodalVectors*> displacements, int fields_out,
                           PointLoop loop, SweepSpace& space) const {
  int fields = 0;
  for (const NodalVectors* u : displacements) {
    read(*u, space.nodes.data() + fields * field_);
    fields += 3;
  }
  if (mode_ == GeometryMode::recomputed) {
    read_geometry(X, space.nodes.data() + fields * field_);
    fields += geometry_fields();
  }
  Pass pass{
      fields, fields_out, rational_, loop, const_cast<double*>(table_.empty() ? nullptr : table_.data()),
      &law};
  sweep(pass, space);
  return pass.sums.sum;
}

void BoxSweep::add_forces(const LawAtPoints& law, const NodalVectors& X, const NodalVectors& u,
                          NodalVectors& f, SweepSpace& space) const {
  sweep_law(law, X, {&u}, 3, loops_->stress[law.loop], space);
  write_.add(*field_kernel_, space.forces.data(), field_, row_, weights_, f);
}

void BoxSweep::add_force_changes(const LawAtPoints& law, const NodalVectors& X, const NodalVectors& u,
                                 const NodalVectors& w, NodalVectors& f, SweepSpace& space) const {
  reserve(space, 3);
  sweep_law(law, X, {&u, &w}, 3, loops_->stress_change[law.loop], space);
  write_.add(*field_kernel_, space.forces.data(), field_, row_, weights_, f);
}

double BoxSweep::energy(const LawAtPoints& law, const NodalVectors& X, const NodalVectors& u,
                        SweepSpace& space) const {
  return sweep_law(law, X, {&u}, 0, loops_->energy[law.loop], space);
}

PointSums BoxSweep::add_row_sums(const NodalVectors& X, double density, Eigen::VectorXd& sums,
                                 SweepSpace& space) const {
  read_geometry(X, space.nodes.data());
  Pass pass{geometry_fields(), 1, true, geometry_loops_->mass};
  sweep(pass, space);
  const double* weight = weights_.data();
  for (int row = 0; row < write_.rows(); ++row)
    for (int i = 0; i < write_.count(); ++i)
      sums[write_.column(row, i)] += density * ((rational_ ? *weight++ : 1.0) * space.forces[row * row_ + i]);
  return pass.sums;
}

}  // namespace structure

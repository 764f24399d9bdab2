// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/sweep/mass_sweep.h"

#include <Eigen/LU>

#include <algorithm>

#include "structure/material/material.h"
#include "structure/sweep/field_kernel.h"

namespace structure {

namespace {

constexpr std::size_t kWord = 8;  // the longest; no band is wider
constexpr int kLargestDegree = 8;

std::size_t whole_words(std::size_t n) { return (n + kWord - 1) / kWord * kWord; }

std::array<int, 3> longest_first(const SpanBox& box) {
  int longest = 0;
  for (int d = 1; d < 3; ++d)
    if (box.spans(d) > box.spans(longest)) longest = d;
  return {longest, (longest + 1) % 3, (longest + 2) % 3};
}

SpanBases bases_of(const nurbs::Space<3>& space, const SpanBox& box, int direction) {
  return {{space.knots(direction), box.begin[direction], box.end[direction]},
          rules_of(space.knots(direction), Quadrature::full)};
}

int points_of(const SpanBases& bases) {
  int points = 0;
  for (int span = 0; span < bases.spans(); ++span) points += bases.at(span).points;
  return points;
}

LineMass line_mass(const SpanBases& bases, int degree, int count) {
  LineMass line{std::min(2 * degree + 1, count), {}, {}};
  for (int i = 0; i < count; ++i) line.first.push_back(std::clamp(i - degree, 0, count - line.width));
  line.value.assign(std::size_t(count) * line.width, 0.0);
  for (int span = 0; span < bases.spans(); ++span)
    for (int q = 0; q < bases.at(span).points; ++q) {
      const double* const B = bases.at(span).basis + 2 * q * (degree + 1);
      for (int a = 0; a <= degree; ++a)
        for (int b = 0; b <= degree; ++b) {
          const int i = bases.first(span) + a, j = bases.first(span) + b;
          line.value[std::size_t(i) * line.width + j - line.first[i]] += bases.weight(span, q) * B[a] * B[b];
        }
    }
  return line;
}

}  // namespace

/// A quadrature point of a direction: its functions B and dB, from a first control point on.
struct MassBox::Point {
  const double *B, *dB;
  int first, count;
  static Point of(const SpanBases& bases, int degree, int span, int q) {
    const double* const B = bases.at(span).basis + 2 * q * (degree + 1);
    return {B, B + degree + 1, bases.first(span), degree + 1};
  }
};

MassBox::MassBox(const nurbs::Space<3>& space, const PlacedBox& box, const NodalVectors& X, double density,
                 bool is_affine, nurbs::SimdLevel level)
    : axes_(longest_first(box.spans)),
      rational_(space.rational()),
      x_(bases_of(space, box.spans, axes_[0])),
      y_(bases_of(space, box.spans, axes_[1])),
      z_(bases_of(space, box.spans, axes_[2])),
      degree_{space.degree(axes_[0]), space.degree(axes_[1]), space.degree(axes_[2])},
      kernel_(&mass_kernel(level)),
      field_kernel_(&field_kernel(level)),
      read_(rows_along(axes_, box_node_counts(space, box.spans), box.read())),
      write_(rows_along(axes_, box_node_counts(space, box.spans), box.write())) {
  const std::array<int, 3> count = box_node_counts(space, box.spans);
  row_ = whole_words(count[axes_[0]]);
  plane_ = row_ * count[axes_[1]];
  field_ = plane_ * count[axes_[2]];
  if (rational_)
    for (const int node : along(axes_, count, box_nodes(space, box.spans)))
      weights_.push_back(space.weight(node));
  band_ = kWord + row_;
  row_bands_ = (degree_[0] + 1) * band_;

  std::vector<double> net(4 * field_, 1.0);  // X times weights, and weights
  read_.read(*field_kernel_, X, weights_, net.data(), field_, row_);
  for (int r = 0; rational_ && r < read_.rows(); ++r)
    std::copy_n(&weights_[std::size_t(r) * read_.count()], read_.count(), &net[3 * field_ + r * row_]);
  if (is_affine) {
    line_y_ = line_mass(y_, degree_[1], count[axes_[1]]);
    line_z_ = line_mass(z_, degree_[2], count[axes_[2]]);
  }
  bands_.assign(row_bands_ * (is_affine ? 1 : std::size_t(points_of(y_)) * points_of(z_)), 0.0);
  double* bands = bands_.data();
  for (int span_z = 0; span_z < z_.spans(); ++span_z)
    for (int q_z = 0; q_z < z_.at(span_z).points; ++q_z)
      for (int span_y = 0; span_y < y_.spans(); ++span_y)
        for (int q_y = 0; q_y < y_.at(span_y).points && bands < bands_.data() + bands_.size();
             ++q_y, bands += row_bands_)
          add_bands(Point::of(y_, degree_[1], span_y, q_y), Point::of(z_, degree_[2], span_z, q_z), net,
                    density, bands);
}

/// Integrals along x of density |J| / W^2 B_i B_(i+k), at one point of y and z.
void MassBox::add_bands(const Point& y, const Point& z, const std::vector<double>& net, double density,
                        double* bands) const {
  const int fields = rational_ ? 4 : 3;
  std::vector<double> rows(3 * fields * row_, 0.0);  // [field][value, d/dy, d/dz]
  for (int f = 0; f < fields; ++f)
    for (int c = 0; c < z.count; ++c)
      for (int b = 0; b < y.count; ++b) {
        const double factors[3] = {y.B[b] * z.B[c], y.dB[b] * z.B[c], y.B[b] * z.dB[c]};
        const double* const in = &net[f * field_ + (z.first + c) * plane_ + (y.first + b) * row_];
        for (int k = 0; k < 3; ++k)
          for (std::size_t i = 0; i < row_; ++i) rows[(3 * f + k) * row_ + i] += factors[k] * in[i];
      }
  for (int span = 0; span < x_.spans(); ++span)
    for (int q = 0; q < x_.at(span).points; ++q) {
      const Point x = Point::of(x_, degree_[0], span, q);
      Eigen::Matrix4d N = Eigen::Matrix4d::Zero();  // columns: of X W and W the value, then derivatives
      N(3, 0) = 1.0;
      for (int f = 0; f < fields; ++f) {
        const double* const in = &rows[3 * f * row_ + x.first];
        const auto sum = [&](const double* B, int k) {
          double sum = 0.0;
          for (int a = 0; a < x.count; ++a) sum += B[a] * in[k * row_ + a];
          return sum;
        };
        N.row(f) << sum(x.B, 0), sum(x.dB, 0), sum(x.B, 1), sum(x.B, 2);
      }
      const double W = N(3, 0);
      const Matrix3 J =
          (N.topRightCorner<3, 3>() - N.topLeftCorner<3, 1>() / W * N.bottomRightCorner<1, 3>()) / W;
      const double mass = density * x_.weight(span, q) * J.determinant() / (W * W);
      for (int a = 0; a < x.count; ++a)
        for (int b = a; b < x.count; ++b)
          bands[kWord + (b - a) * band_ + x.first + a] += mass * x.B[a] * x.B[b];
    }
}

void MassBox::reserve(MassSpace& space) const {
  grow(space.in, 3 * field_);
  grow(space.out, 3 * field_);
  grow(space.plane_in, 3 * plane_);
  grow(space.plane_out, 3 * plane_);
  grow(space.row_in, row_ + 2 * kWord);
  grow(space.row_out, row_);
}

/// row_out from row_in, whose ends are 0.
void MassBox::multiply_row(const double* bands, MassSpace& space) const {
  kernel_->multiply(bands + kWord, band_, degree_[0], space.row_in.data() + kWord, row_,
                    space.row_out.data());
}

/// out = M in, direction by direction; in is lost.
void MassBox::multiply_by_lines(MassSpace& space) const {
  const int planes = static_cast<int>(field_ / plane_), rows = static_cast<int>(plane_ / row_);
  for (std::size_t row = 0; row < 3 * field_; row += row_) {
    std::copy_n(&space.in[row], row_, space.row_in.data() + kWord);
    multiply_row(bands_.data(), space);
    std::copy_n(space.row_out.data(), row_, &space.out[row]);
  }
  for (std::size_t plane = 0; plane < 3 * field_; plane += plane_)
    for (int y = 0; y < rows; ++y)
      kernel_->gather(line_y_.row(y), line_y_.width, &space.out[plane + line_y_.first[y] * row_], row_, row_,
                      &space.in[plane + y * row_]);
  for (std::size_t field = 0; field < 3 * field_; field += field_)
    for (int z = 0; z < planes; ++z)
      kernel_->gather(line_z_.row(z), line_z_.width, &space.in[field + line_z_.first[z] * plane_], plane_,
                      plane_, &space.out[field + z * plane_]);
}

/// Of one point of z; `bands`: of its first point of y.
void MassBox::sweep_plane(const double* bands, double scale, MassSpace& space) const {
  for (int span = 0; span < y_.spans(); ++span)
    for (int q = 0; q < y_.at(span).points; ++q, bands += row_bands_) {
      const Point y = Point::of(y_, degree_[1], span, q);
      double scaled[kLargestDegree + 1];
      for (int b = 0; b < y.count; ++b) scaled[b] = scale * y_.weight(span, q) * y.B[b];
      for (int c = 0; c < 3; ++c) {
        const std::size_t first = c * plane_ + y.first * row_;
        kernel_->gather(y.B, y.count, &space.plane_in[first], row_, row_, space.row_in.data() + kWord);
        multiply_row(bands, space);
        kernel_->scatter(scaled, y.count, space.row_out.data(), row_, &space.plane_out[first], row_);
      }
    }
}

/// out = M in, point by point of y and z.
void MassBox::sweep(MassSpace& space) const {
  std::fill_n(space.out.data(), 3 * field_, 0.0);
  const double* bands = bands_.data();
  const std::size_t next = points_of(y_) * row_bands_;
  for (int span = 0; span < z_.spans(); ++span)
    for (int q = 0; q < z_.at(span).points; ++q, bands += next) {
      const Point z = Point::of(z_, degree_[2], span, q);
      std::fill_n(space.plane_out.data(), 3 * plane_, 0.0);
      for (int c = 0; c < 3; ++c)
        kernel_->gather(z.B, z.count, &space.in[c * field_ + z.first * plane_], plane_, plane_,
                        &space.plane_in[c * plane_]);
      sweep_plane(bands, z_.weight(span, q), space);
      for (int c = 0; c < 3; ++c)
        kernel_->scatter(z.B, z.count, &space.plane_out[c * plane_], plane_,
                         &space.out[c * field_ + z.first * plane_], plane_);
    }
}

void MassBox::add_product(const NodalVectors& a, NodalVectors& f, MassSpace& space) const {
  read_.read(*field_kernel_, a, weights_, space.in.data(), field_, row_);
  std::fill_n(space.row_in.data(), kWord, 0.0);
  std::fill_n(space.row_in.data() + kWord + row_, kWord, 0.0);
  if (line_y_.width > 0)
    multiply_by_lines(space);
  else
    sweep(space);
  write_.add(*field_kernel_, space.out.data(), field_, row_, weights_, f);
}

MassSweep::MassSweep(const nurbs::Space<3>& space, const NodalVectors& X, const std::vector<PlacedBox>& boxes,
                     double density, bool is_affine, nurbs::SimdLevel level) {
  for (const PlacedBox& box : boxes) {
    boxes_.emplace_back(space, box, X, density, is_affine, level);
    boxes_.back().reserve(space_);
  }
}

double MassSweep::table_bytes() const {
  double bytes = 0.0;
  for (const MassBox& box : boxes_) bytes += box.table_bytes();
  return bytes;
}

double MassSweep::expected_bytes(const nurbs::Space<3>& space, const std::vector<PlacedBox>& boxes) {
  double numbers = 0.0;
  for (const PlacedBox& box : boxes) {
    const auto [x, y, z] = longest_first(box.spans);
    const std::size_t row = whole_words(box_node_counts(space, box.spans)[x]);
    numbers += double(points_of(bases_of(space, box.spans, y))) * points_of(bases_of(space, box.spans, z)) *
               (space.degree(x) + 1) * double(kWord + row);
  }
  return sizeof(double) * numbers;
}

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// The simplex method for a function of two variables: a regular triangle that tumbles downhill.
// Source: Spendley, Hext & Himsworth (1962), "Sequential application of simplex designs in optimisation and
// evolutionary operation", Technometrics 4; it halves the triangle where they start a new one.
#pragma once

#include <Eigen/Core>
#include <utility>

namespace search {

/// A triangle and the function's values at its vertices; vertex 0 is the best.
template <class Function>
class Simplex {
 public:
  /// Equilateral triangle with the vertices start, start + (a, 0) and start + (a, sqrt(3) b) / 2, where
  /// edge = (a, b) and |a| = |b|: the signs turn it into one of the four quadrants.
  Simplex(const Function& f, const Eigen::Vector2d& start, const Eigen::Vector2d& edge) : f_(f) {
    vertex_[0] = start;
    vertex_[1] = start + Eigen::Vector2d(edge[0], 0.0);
    vertex_[2] = start + Eigen::Vector2d(0.5 * edge[0], kHeight * edge[1]);
    for (int k = 0; k < 3; ++k) value_[k] = f_(vertex_[k]);
    sort();
  }

  const Eigen::Vector2d& best() const { return vertex_[0]; }

  /// Tumbles over the edge opposite the worst vertex, or else the second worst, if that lowers its value.
  bool reflect() {
    const bool lower = reflect(2) || reflect(1);
    if (lower) sort();
    return lower;
  }

  /// Shrinks to half the size about the best vertex.
  void halve() {
    for (int k = 1; k < 3; ++k) {
      vertex_[k] = 0.5 * (vertex_[0] + vertex_[k]);
      value_[k] = f_(vertex_[k]);
    }
    sort();
  }

 private:
  static constexpr double kHeight = 0.86602540378443864676;  // of an equilateral triangle of edge 1

  bool reflect(int k) {
    const Eigen::Vector2d image = vertex_[0] + vertex_[3 - k] - vertex_[k];
    const double value = f_(image);
    if (!(value < value_[k])) return false;
    vertex_[k] = image;
    value_[k] = value;
    return true;
  }

  void sort() {
    const auto order = [this](int a, int b) {
      if (value_[b] < value_[a]) std::swap(vertex_[a], vertex_[b]), std::swap(value_[a], value_[b]);
    };
    order(0, 1), order(1, 2), order(0, 1);
  }

  const Function& f_;
  Eigen::Vector2d vertex_[3];
  double value_[3];
};

/// Point near a local minimum of f: reflects while that goes downhill, then halves, `halvings` times.  Every
/// reflection lowers a vertex on a grid of triangles, so it ends if f is infinite outside a bounded set.
template <class Function>
Eigen::Vector2d simplex_minimum(const Function& f, const Eigen::Vector2d& start, const Eigen::Vector2d& edge,
                                int halvings) {
  Simplex<Function> simplex(f, start, edge);
  for (int k = 0;; ++k) {
    while (simplex.reflect()) {
    }
    if (k == halvings) return simplex.best();
    simplex.halve();
  }
}

}  // namespace search

// SPDX-License-Identifier: GPL-2.0-or-later
// Minimisation of phi = |S - d|^2 / 2 in the local coordinates of elements (power_element.h): Newton with the
// exact Hessian; where that is not positive definite, with its diagonal, reflected; backtracking, and an
// active set on the borders (Bertsekas 1982, "Projected Newton methods", SIAM J. Control Optim. 20).  A step
// may end in another element; a crease is crossed where the far side leads downhill.
#pragma once

#include <memory>

#include "nurbs/processor.h"
#include "search/patch_points.h"
#include "search/power_element.h"
#include "search/power_kernel.h"

namespace search {

/// The elements of a surface, each converted to power form when it is first used after its control points
/// moved.
class ElementStore {
 public:
  /// Looks at the control points when an element is converted.
  ElementStore(const Space<2>& space, const PatchPoints& control_points, SimdLevel level = simd_level());
  void surface_moved() { ++version_; }
  const ElementAxis& axis(int i) const { return axes_[i]; }
  const AxisElement& axis(int i, int e) const { return axes_[i][e]; }
  int count(int i) const { return axes_[i].count(); }
  const ElementKernel& kernel() const { return kernel_; }
  const PatchPoints& control_points() const { return control_points_; }
  bool rational() const { return rational_; }

  struct Element {
    const double* row;  ///< as in power_kernel.h
    Vector4 origin() const { return {row[0], row[1], row[2], 0.0}; }
    double size() const { return row[3]; }  ///< length of the half extents, roughly
  };
  /// Elements of all points of a batch, and where in them these start, from its xi.  They are being fetched.
  void locate(NewtonBatch& batch) const;
  Element element(const int (&e)[2]) const { return element(e[0], e[1]); }
  Element element(int e0, int e1) const {
    const int index = e0 + count(0) * e1;
    if (built_[index] != version_) build(e0, e1, index);
    return {row(index)};
  }
  /// Has the processor fetch an element's numbers, where it may have to go to memory for them.
  void prefetch(const Element& element) const { nurbs::prefetch(element.row, lines_to_fetch_); }
  /// Homogeneous control points (w (P - origin), w), or (P - origin, 0) of a polynomial patch.
  void homogeneous_points(const int (&e)[2], Vector4* out) const;
  ElementNet net(int e0, int e1) const {
    const int n = space_.control_point_count(0), first = axis(0, e0).first + n * axis(1, e1).first;
    const double* points = control_points_.data() + 3 * first;
    return {points, points + 3 * (kernel_.p / 2 + n * (kernel_.q / 2)),
            rational_ ? space_.weights().data() + first : nullptr, n};
  }

 private:
  struct alignas(64) Line {
    double numbers[8];
  };

  double* row(int index) const { return lines_[static_cast<size_t>(index) * lines_per_row_].numbers; }
  void build(int e0, int e1, int index) const;
  void locate(NewtonBatch& batch, int k) const;

  const Space<2>& space_;
  ElementAxis axes_[2];
  ElementKernel kernel_;
  bool rational_;
  int functions_, lines_per_row_, lines_to_fetch_;
  PatchPoints control_points_;
  unsigned version_ = 1;
  mutable std::vector<unsigned> built_;
  std::unique_ptr<Line[]> lines_;  // rows of elements never used take no memory
};

/// A point of the surface: element per direction, and where in it.
struct LocalPoint {
  int e[2];
  double s[2];
};
/// Part of one element.
struct LocalBox {
  double low[2], high[2];
};

/// What the derivatives at the end of a descent say.
enum class DescentEnd {
  minimum,     ///< a local minimum
  degenerate,  ///< stationary, no direction leads clearly downhill: a flat valley, or close beside a pole
  unknown      ///< a pole, a saddle, or the iteration limit: a point not above the start, and no more
};

struct DescentResult {
  LocalPoint at;
  Vector3 r;       ///< S - d
  bool crease[2];  ///< held on a crease, which is a kink here
  DescentEnd end;
  int iterations;
};

/// Local minimum reached from `start`, over the surface, or over `box` where given.
DescentResult descend(const ElementStore& elements, const Vector3& d, const LocalPoint& start,
                      const LocalBox* box = nullptr);

}  // namespace search

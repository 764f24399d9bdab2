// SPDX-License-Identifier: GPL-2.0-or-later
// Closest-point projection of points on a NURBS surface: exact, bounded and fast.
//
// Warm: Newton's method with the exact Hessian on the elements' power form (power_element.h,
// element_descent.h).  Cold: branch and bound over a tree of boxes (surface_tree.h), past the neighbourhood
// of a foot that is proved to be the nearest there (second_foot.h), and inside an element over Bernstein
// bounds of the squared distance (distance_polynomial.h), so that no minimum is overlooked. Where Newton's
// method ends on no minimum (on saddles, in flat valleys, beside poles) branch and bound takes over: no
// iteration has to converge for its result to be right. Source: Piegl & Tiller (1997), section 6.1; Johnson &
// Cohen (1998), "A framework for efficient minimum distance computations"; Chen et al. (2008), "Computing the
// minimum distance between a point and a NURBS curve" (the Bernstein form of the squared distance).
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "search/box.h"
#include "search/element_descent.h"
#include "search/foot.h"
#include "search/second_foot.h"
#include "search/surface_tree.h"

namespace search {

class DistancePolynomial;
struct ProductTerm;
struct Reached;
struct Search;

/// All lengths in those of the control points, which the caller keeps and moves.  Results do not depend on
/// earlier calls.  Elements and tree are brought up to date when first used, by const members too: one object
/// must not be shared by threads.
/// Tolerances are relative to the size of the surface and the round-off of its evaluation.  A search ends as
/// not_converged if lengths are not finite, and never else.  None allocates, but for the list of
/// all_minima and the first search over the tree after the surface moved.
///
/// What is promised of distances: a global minimum is longer than the least there is by 1e-10 of it at most,
/// and round-off; a warm search ends no farther than its guess, but for round-off.  Where several feet are
/// equally near within that (from the centre of a sphere), one of them is the answer, always the same for the
/// same arguments: batches give what single searches give, bit by bit.
class SurfaceProjector {
 public:
  /// Keeps references to `space` and to the control points (3 x n), which must outlive it.  Results of
  /// different instruction sets differ by round-off.  Throws std::invalid_argument unless there is one column
  /// per control point, or if `level` is not available.
  SurfaceProjector(const Space<2>& space, const PatchPoints& control_points, SimdLevel level = simd_level());
  SurfaceProjector(const SurfaceProjector&) = delete;
  SurfaceProjector& operator=(const SurfaceProjector&) = delete;
  ~SurfaceProjector();

  /// The control points have changed: whatever was worked out of them is out of date.  None is looked at
  /// here, and later those alone that a search needs.
  void surface_moved();

  /// Local minimum reached from `guess`, not above it; the global one where the descent gets stuck.
  Foot warm(const Vector3& d, const Parameter<2>& guess) const { return warm_from(d, start(guess)); }
  /// The same in two parts.  A loop that asks for the start of its next point before it searches for this one
  /// does not wait for memory: start() has the element fetched.
  struct Start {
    LocalPoint at;
    ElementStore::Element element;
  };
  Start start(const Parameter<2>& guess) const {
    const ElementAxis::Place u = elements_.axis(0).locate(guess[0]), v = elements_.axis(1).locate(guess[1]);
    const ElementStore::Element element = elements_.element(u.e, v.e);
    elements_.prefetch(element);
    return {{{u.e, v.e}, {u.s, v.s}}, element};
  }
  Foot warm_from(const Vector3& d, const Start& start) const {
    const NewtonEnd end = newton(d, start);
    Foot result;
    if (end.done)
      take_foot(end, start.at.e, result);
    else
      result = warm_beyond(d, start, end);
    return result;
  }
  /// The same for `count` points, several at a time: feet[k] goes on from its xi, on the surface moved by its
  /// image, to where warm() leads it for d[k], to the last bit.  Patch and image stay.
  void warm_batch(const Vector3* d, Foot* const* feet, int count) const;
  /// Global minimum, by the tree.
  Foot cold(const Vector3& d) const;
  /// Global minimum, warm: the tree proves that nothing is nearer than the minimum reached from `guess`.
  Foot nearest(const Vector3& d, const Parameter<2>& guess) const;
  /// Minimum over candidate elements.  The candidates must include all elements nearer than the result, as
  /// those of SurfaceTree::query do whose reach is not smaller.  Throws std::invalid_argument if there are
  /// none.
  Foot cold_on(const Vector3& d, const int* elements, int count) const;
  /// All local minima nearer than `reach`, each once, nearest first.  Of minima that are not isolated (d on
  /// the axis of a tube) there are some.
  void all_minima(const Vector3& d, double reach, std::vector<Foot>& out) const;
  /// Those of them that lie on candidate elements, as above.
  void all_minima_on(const Vector3& d, double reach, const int* elements, int count,
                     std::vector<Foot>& out) const;

  /// Derivatives of S at xi, and of |S - d|^2 / 2 where d = S + delta (`delta`: normal to the surface, if xi
  /// is d's foot).
  struct Slopes {
    Eigen::Matrix<double, 3, 2> S_i;  ///< [length]
    Eigen::Matrix2d hessian;          ///< S_i . S_j - delta . S_ij [length^2]
    Indices<2> element;               ///< that xi is in
  };
  Slopes slopes(const Parameter<2>& xi, const Vector3& delta) const {
    const Start at = start(xi);
    const DistanceJet jet = from_origin(at);
    Eigen::Vector2d scale;  // from the derivatives by local coordinates
    for (int i = 0; i < 2; ++i) scale[i] = elements_.axis(i, at.at.e[i]).per_half_width;
    Slopes slopes;
    slopes.element = {at.at.e[0], at.at.e[1]};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        slopes.hessian(i, j) =
            scale[i] * scale[j] * (jet.metric[i + j] - delta.dot(Vector3::Map(jet.S_ij[i + j])));
    for (int i = 0; i < 2; ++i) slopes.S_i.col(i) = scale[i] * Vector3::Map(jet.S_i[i]);
    return slopes;
  }
  /// A point of the surface with its derivatives by local coordinates of its element, which are the
  /// parameters' but for a factor each [length].
  struct Tangents {
    Vector3 point, along[2];
  };
  Tangents tangents(const Parameter<2>& xi) const {
    const DistanceJet at = from_origin(start(xi));
    return {Vector3::Map(at.r), {Vector3::Map(at.S_i[0]), Vector3::Map(at.S_i[1])}};
  }

  const Space<2>& space() const { return space_; }
  /// Where there is no second foot; begin_list() is up to the caller.
  SecondFoot& second_foot() { return second_foot_; }
  const SecondFoot& second_foot() const { return second_foot_; }
  Eigen::Map<const NodalVectors> control_points() const { return elements_.control_points().matrix(); }

 private:
  LocalPoint local(const Parameter<2>& xi) const {
    const ElementAxis::Place u = elements_.axis(0).locate(xi[0]), v = elements_.axis(1).locate(xi[1]);
    return {{u.e, v.e}, {u.s, v.s}};
  }
  DistanceJet from_origin(const Start& at) const {
    const ElementKernel& kernel = elements_.kernel();
    constexpr double kOrigin[3] = {0.0, 0.0, 0.0};
    DistanceJet jet;
    kernel.evaluate(kernel.p, kernel.q, at.element.row, at.at.s, kOrigin, jet);
    return jet;
  }
  // Newton's method alone.
  NewtonEnd newton(const Vector3& d, const Start& start) const {
    const ElementKernel& kernel = elements_.kernel();
    NewtonEnd end;
    kernel.newton(kernel.p, kernel.q, start.element.row, d.data(), start.at.s[0], start.at.s[1], end);
    return end;
  }
  void take_foot(const NewtonEnd& end, const int (&e)[2], Foot& out) const {
    for (int c = 0; c < 3; ++c) out.point[c] = end.foot[c];
    out.distance = end.distance;
    out.iterations = end.iterations;
    take_parameters(e, end.s, out);
  }
  // Parameters and status of a foot inside an element.
  void take_parameters(const int (&e)[2], const double (&s)[2], Foot& out) const {
    int borders = 0;
    for (int i = 0; i < 2; ++i) {
      const AxisElement& element = elements_.axis(i, e[i]);
      out.xi[i] = std::min(element.begin + element.half_width * (1.0 + s[i]), element.end);
      borders += elements_.axis(i).at_patch_end(out.xi[i]);
    }
    out.status = kByBorders[borders];
  }
  // The k-th of a batch.
  void take_foot(const NewtonBatch& batch, int k, const Vector3& d, Foot& foot) const {
    if (batch.done[k] == 0) {
      foot = placed(warm_beyond(d - foot.image, start(foot.xi), batch.newton_end(k)), foot.patch, foot.image);
      return;
    }
    for (int i = 0; i < 2; ++i) foot.xi[i] = batch.xi[i][k];
    for (int c = 0; c < 3; ++c) foot.point[c] = batch.foot[c][k] + foot.image[c];
    foot.distance = batch.distance[k];
    foot.status = kByBorders[batch.borders[k]];
    foot.iterations = static_cast<int>(batch.iterations[k]);
  }
  Foot foot_of(const Vector3& d, const DescentResult& found) const;
  bool go_on(const Vector3& d, Start& start, NewtonEnd& end) const;
  Foot warm_beyond(const Vector3& d, const Start& start, const NewtonEnd& end) const;
  bool neighbour(const LocalPoint& from, const double (&to)[2], Start& start) const;
  DescentResult descend_after(const Vector3& d, const LocalPoint& start, const NewtonEnd& end) const;
  Reached foot_from(const Vector3& d, const LocalPoint& start) const;
  Foot minimum_or_global(const Vector3& d, const DescentResult& found) const;
  Foot global(const Vector3& d, const Reached& start) const;
  LocalPoint centre(int element) const;
  template <class Examine>
  void collect(const Vector3& d, double reach, std::vector<Foot>& out, Examine examine) const;
  // surface_search.cpp:
  void search_tree(Search& search) const;
  void search_elements(const int* elements, int count, Search& search) const;
  void visit(const ElementBlock& block, Search& search) const;
  void descend_to(const ElementBlock& block, Search& search) const;
  bool settled(const ElementBlock& block, Search& search) const;
  bool has_its_only_foot(const ElementBlock& block, Search& search) const;
  bool interior_of_region(const LocalPoint& at) const;
  void examine_element(int element, Search& search) const;
  const Box& box(int element) const;
  bool beyond(int element, const Search& search) const;
  const Vector4* bezier_net(int element) const;
  void examine(const DistancePolynomial& F, Search& search) const;
  bool descend_in(const DistancePolynomial& F, Search& search) const;
  bool on_region_border(const DistancePolynomial& F, int i, bool upper) const;
  bool touches_region_border(const DistancePolynomial& F) const;
  bool holds(const DistancePolynomial& F, const Parameter<2>& xi) const;
  void start_from(const LocalPoint& start, Search& search) const;

  static constexpr FootStatus kByBorders[] = {FootStatus::interior, FootStatus::edge, FootStatus::corner};

  const Space<2>& space_;
  ElementStore elements_;
  std::vector<ProductTerm> products_;
  std::vector<double> binomials_;  // C(p, i) C(q, j)
  mutable SurfaceTree tree_;
  mutable bool tree_current_ = false;
  SecondFoot second_foot_;
  unsigned version_ = 1;  // of the control points
  mutable std::vector<unsigned> box_version_, net_version_;
  std::unique_ptr<Box[]> boxes_;       // of the elements that needed one
  mutable std::vector<Vector4> nets_;  // Bezier nets times binomials, likewise
};

}  // namespace search

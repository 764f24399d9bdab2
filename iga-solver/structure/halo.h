// SPDX-License-Identifier: GPL-2.0-or-later
// What the parts of a cut body tell each other.  A part holds the nodes of its own elements.  Nodes at a cut
// are held by several parts and owned by one; a part's own nodes come first in its arrays, the others'
// (ghosts) after them.  All calls are collective: every part makes the same, in the same order.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "nurbs/types.h"
#include "structure/exact_sum.h"
#include "structure/id.h"

namespace structure {

/// The value of a part that has none, where the largest of all parts is asked for.
constexpr double kNowhere = -std::numeric_limits<double>::infinity();

/// This one is of a body in one piece: nothing to tell.
class Halo {
 public:
  /// Sums over nodes go run by run of columns: plain sums within a run, exact ones of the runs.  Runs that do
  /// not depend on how the body is cut make sums that do not, to the last bit.  `runs`: first columns, rising
  /// from 0, of the nodes that the part owns; without them they are one run.
  explicit Halo(std::vector<Eigen::Index> runs = {}) : runs_(std::move(runs)) {}
  virtual ~Halo() = default;

  /// How many of the columns of an array are nodes that the part owns.
  virtual Eigen::Index owned(Eigen::Index columns) const { return columns; }
  virtual Id node_id(Eigen::Index column) const { return column; }
  virtual Id element_id(Eigen::Index held) const { return held; }
  /// How many of the columns of an array are nodes.  What several boxes add to a node at a cut may stand in
  /// columns of its own behind them, until it is summed: they have no mass, do not move, and feel nothing.
  virtual Eigen::Index held(Eigen::Index columns) const { return columns; }
  /// Adds to each owner's column of a nodal array what other parts have at their ghosts of it.
  void sum_to_owners(nurbs::NodalVectors& values) const {
    begin_sum(values);
    finish_sum(values);
  }
  /// The same in two steps: after the first, what is not shared may still be worked out.
  virtual void begin_sum(const nurbs::NodalVectors& /*values*/) const {}
  virtual void finish_sum(nurbs::NodalVectors& /*values*/) const {}
  /// Copies the owners' columns to all ghosts.
  virtual void owners_to_ghosts(nurbs::NodalVectors& /*values*/) const {}
  /// Each of `count` sums goes on over all parts.
  virtual void sum(ExactSum* /*sums*/, std::size_t /*count*/) const {}
  /// The largest number of all parts; not a number if one is none.
  virtual double largest(double value) const { return value; }
  /// Rows of equally many numbers from all parts in the order of their ids, some thousands at a time, so that
  /// no part needs room for all: visit(rows, numbers).
  using VisitRows = std::function<void(const double*, std::size_t)>;
  /// `ids`: of the part's rows; those of all parts are 0, 1, 2 ...  `rows`: so many `numbers` in all.
  virtual void in_slices(const std::vector<Id>& /*ids*/, const double* rows, std::size_t numbers,
                         const VisitRows& visit) const {
    visit(rows, numbers);
  }
  /// The same in one piece, complete on all parts.
  std::vector<double> in_order(const std::vector<Id>& ids, const double* rows, std::size_t numbers) const {
    std::vector<double> all;
    all.reserve(std::llround(sum(static_cast<double>(numbers))));
    in_slices(ids, rows, numbers,
              [&](const double* some, std::size_t count) { all.insert(all.end(), some, some + count); });
    return all;
  }

  /// Of what each part has added to its own.
  double total(ExactSum own) const {
    sum(&own, 1);
    return own.value();
  }
  /// Of one number from each part.
  double sum(double value) const {
    ExactSum own;
    own.add(value);
    return total(own);
  }
  /// visit(first, count) for each run of columns that the part owns, of an array's.
  template <class Visit>
  void for_each_run(Eigen::Index columns, Visit visit) const {
    const Eigen::Index end = owned(columns);
    if (runs_.empty()) return visit(Eigen::Index(0), end);
    for (std::size_t k = 0; k < runs_.size(); ++k)
      visit(runs_[k], (k + 1 < runs_.size() ? runs_[k + 1] : end) - runs_[k]);
  }
  /// Sum over all parts of what `run(first, count)` gives for each run.
  template <class Run>
  double sum_over_nodes(Eigen::Index columns, Run run) const {
    ExactSum all;
    for_each_run(columns, [&](Eigen::Index first, Eigen::Index count) { all.add(run(first, count)); });
    return total(all);
  }
  /// What is said by the part whose value is the largest of all, and whose id is the lowest if several are;
  /// on all parts.  `value` is a number, `id` not negative where it is above -infinity.
  template <class Words>
  std::string words_of_largest(double value, Id id, Words words) const {
    const bool is_largest = largest(value) == value && value > kNowhere;
    const double lowest = -largest(is_largest ? -static_cast<double>(id) : kNowhere);
    return shared(is_largest && static_cast<double>(id) == lowest ? words() : std::string());
  }
  /// Whether it is so on any part.
  bool any(bool here) const { return largest(here ? 1.0 : 0.0) > 0.0; }
  /// Columns of the nodes that the part owns: what sums over nodes go over.
  auto own(const nurbs::NodalVectors& values) const { return values.leftCols(owned(values.cols())); }
  /// Sum over the nodes of all parts of a . b.
  double dot(const nurbs::NodalVectors& a, const nurbs::NodalVectors& b) const {
    return sum_over_nodes(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
      return a.middleCols(first, count).cwiseProduct(b.middleCols(first, count)).sum();
    });
  }

 private:
  /// Words that some parts have, all of them the same, on all.
  std::string shared(const std::string& words) const {
    std::vector<Id> places(words.size());
    std::iota(places.begin(), places.end(), Id(0));
    const std::vector<double> rows(words.begin(), words.end());
    const std::vector<double> all = in_order(places, rows.data(), rows.size());
    return {all.begin(), all.begin() + static_cast<long>(largest(static_cast<double>(words.size())))};
  }

  std::vector<Eigen::Index> runs_;
};

/// Per held node the sum of what all parts give for it (masses).
inline Eigen::VectorXd whole(const Halo& halo, const Eigen::VectorXd& share) {
  nurbs::NodalVectors values = nurbs::Vector3::Ones() * share.transpose();
  halo.sum_to_owners(values);
  halo.owners_to_ghosts(values);
  const Eigen::Index held = halo.held(values.cols());
  values.rightCols(values.cols() - held).setOnes();  // a mass for columns that nothing moves
  return values.row(0);
}

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Local compliances of a body's skin: one table per element, made when it is first asked for.  The elements
// that take part are others on the two sides of a border; there tables have the mean, so that a foot that
// crosses it changes no force, and are rounded, so that it does so smoothly.  Where strain has changed the
// elements themselves, tables are made anew while nobody touches them: a few states of the body are known at
// a time, and each element belongs to one. Whoever moves the surface by what cross_compliance.h takes off has
// that of a foot's own force there already.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "structure/compliance/cross_compliance.h"
#include "structure/compliance/element_compliances.h"
#include "structure/compliance/smooth_borders.h"

namespace structure {

class ComplianceTables {
 public:
  /// As the body is undeformed; throws as ElementCompliances does.  `beside_links`: along the normal without
  /// CrossCompliance::between a foot and itself.
  ComplianceTables(ReferenceBody body, std::vector<SkinPiece> skin, bool beside_links = false);
  ComplianceTables(const ComplianceTables&) = delete;
  ComplianceTables& operator=(const ComplianceTables&) = delete;

  /// Of an element of a piece's surface.  Throws std::invalid_argument, with the place, where none can be
  /// made.
  const ComplianceTable& of(int piece, int element) {
    const ComplianceTable* const known = tables_.known[piece][element];
    return known ? *known : find(piece, element);
  }
  /// If it is known, its numbers come from memory until it is asked for.
  [[gnu::always_inline]] void prefetch(int piece, int element, const nurbs::Parameter<2>& low,
                                       const nurbs::Parameter<2>& high, const nurbs::Parameter<2>& xi) const {
    if (const ComplianceTable* const known = tables_.known[piece][element]) known->prefetch(low, high, xi);
  }
  /// The same of forces that are spread, worked out when it is first asked for.
  const SpreadTable& spread_of(int piece, int element) {
    const SpreadTable* const known = spread_tables_.known[piece][element];
    return known ? *known : find_spread(piece, element);
  }
  /// How forces are on nodes, and what they are spread by.
  const SkinNet& net() const { return *undeformed_->net(); }
  /// Of the undeformed body; null unless tables are beside them.
  const CrossCompliance* links() const { return links_.get(); }
  /// What the elements about one have at any point of it, without a table or a mean: the tensor in space, of
  /// its state.
  Matrix3 direct(int piece, int element, const nurbs::Parameter<2>& xi) const {
    return state_of_[piece][element]->direct(piece, element, xi);
  }
  /// For how many elements of the undeformed body; those that see the same share one.
  int solved() const { return undeformed_->solved_count(); }

  /// Whether strain changes anything: not under laws of small strain.
  bool follows_strain() const;
  /// Elements that are 5 % longer or shorter in one of their directions than in the state that they belong to
  /// now belong to this one, or to the undeformed body if they are back, but for those that are `touched` and
  /// their neighbours.  `places`: of all nodes, 3 x node count [length].  Whether any does.
  bool follow(const NodalVectors& places, const std::vector<SkinElement>& touched);

  /// States and which elements belong to them as numbers; none if that is the undeformed body for all.
  std::vector<double> save() const;
  /// Throws std::invalid_argument if the size does not fit.
  void load(const std::vector<double>& numbers);

 private:
  using Tensors = ElementCompliances::Tensors;
  using State = std::shared_ptr<ElementCompliances>;
  /// What a table is made of: tensors and which of them, point by point.
  using Origin = std::vector<std::pair<const Tensors*, int>>;

  /// Tables of one kind.
  template <class Table>
  struct Kind {
    /// [piece][element]; null: not asked for before.
    using Known = std::vector<std::vector<const Table*>>;
    Known known, known_plain;
    std::map<Origin, std::unique_ptr<Table>> plain;  // each as if there were no other
    // Of the plain ones of an element and those around it, and which one it is if not all are of one patch.
    std::map<std::pair<std::array<const Table*, 9>, std::pair<int, int>>, std::unique_ptr<Table>> made;
    void forget_all();
    void forget_unused();
  };

  const ComplianceTable& find(int piece, int element);
  const SpreadTable& find_spread(int piece, int element);
  const ComplianceTable* plain(int piece, int element);
  const SpreadTable* plain_spread(int piece, int element);
  template <class Table, class Plain>
  const Table& joined(Kind<Table>& tables, int piece, int element, Plain plain);
  void expect_solved(const ElementCompliances::Solved& own, int piece, int element) const;
  template <class Solved>
  Tensors means(int piece, int element, int offset, Solved solved, Origin& origin) const;
  Matrix3 tensor(const TablePoint& point, const Tensors& tensors, int index,
                 const ElementCompliances& state) const;
  template <class Function>
  void for_each_neighbour(const SkinElement& of, Function f) const;

  std::pair<std::vector<double>, int> taken_off(int piece, int element, int alike);
  std::vector<double> linked(int piece, int element) const;

  std::vector<SkinPiece> skin_;
  State undeformed_, asked_;  // asked_: last, for a table
  std::unique_ptr<CrossCompliance> links_;
  std::map<std::pair<int, int>, std::vector<double>> linked_;  // of the first of those that are alike
  std::vector<std::vector<State>> state_of_;                   // [piece][element]
  Kind<ComplianceTable> tables_;
  Kind<SpreadTable> spread_tables_;
  SmoothBorders borders_;
};

}  // namespace structure

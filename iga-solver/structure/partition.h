// SPDX-License-Identifier: GPL-2.0-or-later
// A body of patches cut into parts for ranks: whole boxes to each, every control node owned by one.  Boxes
// are ranges of knot spans on a grid that does not depend on the ranks; each adds its forces as one share,
// and shares of a node are added in the order of boxes, from zero, by whoever owns it: the sum is the same to
// the last bit on any number of ranks.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "nurbs/patch.h"
#include "structure/id.h"
#include "structure/node_numbering.h"

namespace structure {

/// Per direction the knot spans where a patch is cut into boxes, its first and its last border included.
/// Boxes have numbers as elements have, patch after patch, the first direction fastest.
using BoxCuts = std::array<std::vector<int>, 3>;

/// What a part has in common with another one: columns of the part's arrays, in an order that both know.
struct Neighbour {
  int part;
  std::vector<int> own;         ///< nodes that the part owns and the other holds
  std::vector<int> ghosts;      ///< nodes that the part holds and the other owns
  std::vector<int> shares_out;  ///< the part's shares of those ghosts
  std::vector<int> shares_in;   ///< where the other's shares of `own` go
};

/// A node that the part owns and whose shares are added at the end: columns [first, end), in the order of
/// boxes.
struct SharedNode {
  int column, first, end;
};

/// What a part has of a patch: boxes [begin, end) of its own, whose numbers count from `first_box`.  The
/// first `border` of them have ghosts and are integrated before all others: their shares may travel
/// meanwhile.
struct PatchPart {
  int begin, end, border, first_box;
};

/// Arrays of a part have a column for each node that it owns, then for its ghosts, each in the order of ids;
/// then for shares that wait to be added, zero but in forces (Halo::held).
struct Part {
  std::vector<int> boxes;          ///< patch after patch, of each those with ghosts first
  std::vector<PatchPart> patches;  ///< of all patches of the body
  /// Elements that the part holds are those of `boxes`, box after box, the first direction fastest.
  struct Elements {
    Id first;  ///< of the body
    Id begin;  ///< of the part
  };
  std::vector<Elements> elements;  ///< per box
  Id element_count = 0;
  std::vector<Id> nodes;  ///< that the part holds, per column
  int owned = 0;          ///< how many of them
  int columns = 0;        ///< of nodes and shares
  std::vector<Eigen::Index>
      runs;  ///< first columns of runs of owned nodes that no cut divides (Halo::for_each_run)
  std::vector<SharedNode> shared;
  std::vector<Neighbour> neighbours;  ///< in the order of parts
  /// Per box of `boxes`, its nodes with the first direction fastest: their columns, and those where the box
  /// adds its forces.
  std::vector<std::vector<int>> gather, scatter;

  int held() const { return static_cast<int>(nodes.size()); }
  /// Of the body, of an element that the part holds.
  Id element(Id held) const;
};

/// Adds up the shares of the nodes that the part owns, in the order of boxes; leaves zero where shares were.
void add_shares(const Part& part, nurbs::NodalVectors& forces);

/// The boxes of one patch, and which of its control points they have.
class PatchBoxes {
 public:
  /// Throws std::invalid_argument if a piece between two cuts has fewer spans than the degree.
  PatchBoxes(const nurbs::Space<3>& space, const BoxCuts& cuts);

  int count() const { return piece_count(0) * piece_count(1) * piece_count(2); }
  int piece_count(int d) const { return static_cast<int>(axes_[d].spans.size()); }
  int box(int i, int j, int k) const { return i + piece_count(0) * (j + piece_count(1) * k); }
  Id element_count(int box) const;
  int spans(int d, int piece) const { return axes_[d].spans[piece]; }
  /// Of a box, the first direction fastest.
  std::vector<int> control_points_of(int box) const;
  /// Boxes that hold a control point, rising; gives how many, eight at most.
  int boxes_of(int control_point, int* boxes) const;

 private:
  /// One direction: control points [first, end) of each piece, and for each of them the first and last piece
  /// with it.
  struct Axis {
    std::vector<int> spans, first, end, low, high;
  };
  static Axis axis(const nurbs::KnotVector& knots, const std::vector<int>& cuts);
  std::array<int, 3> pieces_of(int box) const;

  std::array<Axis, 3> axes_;
  std::array<int, 3> control_points_;  // per direction
};

class Partition {
 public:
  /// Of patches with their nodes.  Parts get equally many elements, as near as boxes allow.
  Partition(std::vector<PatchBoxes> patches, NodeNumbering nodes, int parts);
  /// Of one patch whose control points are the nodes.  Throws as PatchBoxes does.
  Partition(const nurbs::Space<3>& space, const BoxCuts& cuts, int parts);

  int box_count() const { return static_cast<int>(part_.size()); }
  int part_of(int box) const { return part_[box]; }
  int patch_count() const { return static_cast<int>(patches_.size()); }
  int patch_of(int box) const;
  /// The first box of a patch, or of one beyond.
  int first_box(int patch) const { return first_box_[patch]; }
  /// Boxes that hold a node, rising.
  class Boxes {
   public:
    const int* begin() const { return many_ ? many_->data() : few_.data(); }
    const int* end() const { return begin() + count(); }
    std::size_t count() const { return many_ ? many_->size() : count_; }
    int operator[](int i) const { return begin()[i]; }

   private:
    friend class Partition;
    std::size_t count_ = 0;
    std::array<int, 8> few_;
    const std::vector<int>* many_ = nullptr;  // of a node that is welded
  };
  Boxes boxes_of(Id node) const;
  /// A node belongs to the part of the first of its boxes.
  int owner(Id node) const { return part_[boxes_of(node)[0]]; }
  /// Of a box, the first direction fastest.
  std::vector<Id> nodes_of(int box) const;
  /// Elements are counted box after box, the first direction fastest.
  Id first_element(int box) const { return first_element_[box]; }
  Id element_count(int box) const { return first_element_[box + 1] - first_element_[box]; }
  /// Everything that part p of them knows.  Takes time and memory in proportion to what it holds.
  Part part(int p) const;

 private:
  using Range = std::array<std::array<int, 2>, 3>;
  /// Which parts a brick of boxes goes to: numbers from `begin` to `end`, the last of which may have a share.
  struct Shares {
    double begin, end;
  };
  void divide(int patch, const Range& boxes, const Shares& shares);
  void weld_boxes();
  bool has_ghosts(int box) const;

  std::vector<PatchBoxes> patches_;
  NodeNumbering nodes_;
  std::vector<int> first_box_;                  // of each patch, and of one beyond
  std::vector<Id> first_element_;               // of each box, and of one beyond
  std::vector<int> part_;                       // per box
  std::vector<std::vector<int>> welded_boxes_;  // as NodeNumbering::welded
};

}  // namespace structure

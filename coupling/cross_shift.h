// SPDX-License-Identifier: GPL-2.0-or-later
// Where contacts meet the surface of a meshed body, so that they feel each other as through the body itself:
// beside where the mesh has it, by what LocalCompliance::links() take off its displacement under their
// forces. The forces of a step are not known when its feet are sought; those of the last two steps are
// carried on by a straight line, so what is wrong is of the second order in the time step, as its own rule
// is.
#pragma once

#include <vector>

#include "coupling/contact_surface.h"
#include "coupling/local_compliance.h"

namespace coupling {

class CrossShift {
 public:
  /// `map`: of the whole structure, each control point a node.
  CrossShift(const SurfaceMap& map, const std::vector<LocalCompliance::Link>& links);

  /// Carries the forces on to a new step.
  void begin_step();
  /// Forces of this step, of these control points (out of 3 x n_control_points), rising.
  void remember(const std::vector<int>& control_points, const NodalVectors& forces);
  /// How much of a change of contact forces links bring back in the next step, if contacts on an element with
  /// this control point are together so stiff [force/length], and those around it; from 1 on forces would
  /// grow by themselves.
  double feedback(int control_point, double stiffness) const;
  /// Of a control point, expected in this step [length]: right where all forces on it and what it is linked
  /// to were remembered.
  auto at(int control_point) const { return shift_.col(node_of_[control_point]); }
  /// f(control point), one for each node that this one is linked to.
  template <class Function>
  void for_each_linked(int control_point, Function f) const {
    for (const Link& link : links_of_[node_of_[control_point]]) f(point_of_[link.node]);
  }

  /// What is expected in this step, and was in the two before, of all control points that `is_own`; 0
  /// elsewhere, so that ranks may add it up.
  std::vector<double> save(const std::vector<int>& own) const;
  std::size_t state_size() const { return 3 * static_cast<std::size_t>(expected_.values.size()); }
  /// Throws std::invalid_argument if the size does not fit.
  void load(const std::vector<double>& state);

 private:
  struct Link {
    int node;
    double give;
  };
  /// Forces on nodes, and on which, rising.
  struct Forces {
    NodalVectors values;
    std::vector<int> nodes;
    void clear();
    void find_nodes();
  };
  void shift();

  std::vector<int> node_of_;                 // of each control point, counted from 0
  std::vector<int> point_of_;                // of each node the first control point
  std::vector<std::vector<Link>> links_of_;  // of each node
  Forces expected_, last_, before_;
  NodalVectors shift_;
  std::vector<bool> is_there_;  // in a list that is being made
};

}  // namespace coupling

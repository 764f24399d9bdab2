// SPDX-License-Identifier: GPL-2.0-or-later
// Whether a solid has been strained so much that its stable step may have got shorter than the time step.
// Derivatives of positions are means of the edges of the control net (with weights >= 0, whatever the
// degree), so fibres along a mesh line are stretched no more than the edges along it; what a stretch does to
// the stiffness is asked of the law: dP/dH across a plane that is stretched along its normal, alone or in all
// directions alike.  That is an estimate: when it rings, the stable step itself has the word.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "structure/body.h"
#include "structure/halo.h"

namespace structure {

/// Largest acoustic stiffness [stress] of a law without memory at a stretch s: of waves along e_x in a
/// material that is stretched along e_x, or along all three.
double stretched_stiffness(const Material& material, double stretch);

/// Stretches within which that is at most `allowed` times what it is undeformed: 0 and infinity where it is
/// as far as anybody will stretch it.
struct StretchLimits {
  double lowest, highest;
  bool matter() const { return lowest > 0.0 || std::isfinite(highest); }
};
StretchLimits stretch_limits(const Material& material, double allowed);

bool is_stiffened_by_strain(const Body& body);

class StretchWatch {
 public:
  /// Rings beyond `allowed` times the stiffness of the undeformed law, of all laws that for which it rings
  /// first.  Keeps nothing for laws that stretch does not stiffen.
  StretchWatch(const Body& body, double allowed);

  /// Looks at an eighth of the edges, at others in the next step.  True if one of them is beyond what is
  /// allowed.
  bool look(const NodalVectors& positions);
  /// What is allowed is now `factor` times as much.
  void allow_more(double factor);

  /// What rang last.
  struct Edge {
    int node;        ///< one of its ends
    double stretch;  ///< [-]
  };
  const std::optional<Edge>& rung() const { return rung_; }

 private:
  bool set_limits();  ///< whether there are any

  struct NetEdge {
    int nodes[2];
    double per_square;  ///< 1 / squared length [1/length^2]
  };
  std::vector<const Material*> materials_;
  double allowed_;
  double lowest_ = 0.0, highest_ = 0.0;  ///< squared stretches within which nothing rings
  std::vector<NetEdge> edges_;
  std::size_t turn_ = 0;
  std::optional<Edge> rung_;
};

/// All in [time].
struct WatchedStep {
  double time, time_step, stable_at_start, stable_now;
};

/// What is wrong where the stable step has come down to the time step, in one line.  Collective: of all
/// parts, in the same words on each.
std::string describe_too_strained(const Body& body, const Halo& halo, const StretchWatch& watch,
                                  const WatchedStep& step);

}  // namespace structure

// SPDX-License-Identifier: GPL-2.0-or-later
// Displacements at rest under dead loads: f_int(u) = load factor times f_ext, by Newton's method with
// conjugate gradients, line search and load steps.  Supports that move in time are where they are at the time
// that is the load factor.
// Source: Bonet & Wood (2008), secs. 9.6-9.7; line search: Matthies & Strang (1979), Int. J. Numer. Methods
// Eng. 14, 1613-1626; how exactly a correction is solved for: Eisenstat & Walker (1996), SIAM J. Sci. Comput.
// 17, 16-32.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "structure/analysis/choose_preconditioner.h"
#include "structure/analysis/held.h"

namespace structure {

struct StaticOptions {
  int load_steps = 1;        ///< halved by itself where Newton's method fails
  double tolerance = 1e-8;   ///< of the forces out of balance, relative to loads and reactions
  int most_iterations = 25;  ///< of Newton's method in a load step
  PreconditionerKind preconditioner = PreconditionerKind::automatic;
};

/// How an iteration of Newton's method ended.
struct NewtonIteration {
  double load_factor;  ///< of the load step
  int iteration;       ///< from 1
  double residual;     ///< forces out of balance, relative
  int products;        ///< of the tangent
  double step_length;  ///< of the line search, 1: Newton's own
};

class StaticEquilibrium {
 public:
  /// f_ext [force] at displacements u, both 3 x node_count.
  using Loads = std::function<void(const NodalVectors& u, NodalVectors& f)>;
  /// What loads change with u is not in the tangent: Newton's method takes more iterations, or does not end
  /// where that is much.  All but `loads` must live on.  Throws NoEquilibrium if the supports leave the body
  /// free to move as a whole, std::invalid_argument as make_preconditioner.
  StaticEquilibrium(const Body& body, const Supports& supports, Loads loads,
                    const StaticOptions& options = {}, const Springs& springs = Tangent::no_springs());
  /// Of dead loads.
  StaticEquilibrium(const Body& body, const Supports& supports, const NodalVectors& load,
                    const StaticOptions& options = {})
      : StaticEquilibrium(
            body, supports, [load](const NodalVectors&, NodalVectors& f) { f = load; }, options) {}

  using OnIteration = std::function<void(const NewtonIteration&)>;
  /// After each load step, with its factor; displacements() are those of its equilibrium.
  using OnLoadStep = std::function<void(double load_factor)>;
  /// From the undeformed body to the full load.  Throws NoEquilibrium.
  void solve(const OnIteration& on_iteration = {}, const OnLoadStep& on_load_step = {});

  const NodalVectors& displacements() const { return u_; }
  const char* preconditioner() const { return preconditioner_->name(); }

 private:
  struct Failure {
    double residual;
    std::string what;
  };
  /// Takes supports to where they are at the load factor, and the rest along, to first order.
  std::optional<Failure> move_supports(double load_factor);
  /// Brings u_ to equilibrium at a load factor; what went wrong, if it did.
  std::optional<Failure> newton(double load_factor, bool searches, const OnIteration& on_iteration);
  /// The same from u_ as it is: by full steps, or else with line search; where both fail u_ stays.
  std::optional<Failure> load_step(double load_factor, const OnIteration& on_iteration);
  /// Sets residual_ and what it is measured by; not finite where a law is asked for what it does not know.
  void find_residual(double load_factor);
  double relative_residual() const { return residual_.norm() / reference_; }
  bool is_balanced() const;
  bool is_adrift() const;  // balanced by round-off alone, of displacements without bound
  bool is_folded() const;  // an equilibrium that is none: some volume is 0 or less
  double step_along(const NodalVectors& du, double load_factor, bool searches);
  double mean_stiffness() const;

  const Body& body_;
  const Supports& supports_;
  const Springs& springs_;
  Loads loads_;
  StaticOptions options_;
  NodalVectors u_, residual_, force_, load_;
  double reference_ = 1.0;  // loads and reactions [force]
  double stiffness_;        // of the undeformed body on random displacements [force/length]
  Tangent tangent_;
  std::unique_ptr<Preconditioner> preconditioner_;
};

}  // namespace structure

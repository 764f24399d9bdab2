// SPDX-License-Identifier: GPL-2.0-or-later
// A body in two parts, each with a solver and a thread of its own, moves as the whole does: the seam is
// enough.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "models.h"
#include "nurbs/primitives.h"
#include "standard_linear_solid.h"
#include "structure/solid/solid.h"
#include "structure/time/explicit_solver.h"

namespace {

using models::NodalVectors;
using models::Vector3;
using structure::ExplicitSolver;
using structure::Solid;
using testing::HasSubstr;

/// Where the two threads meet: each leaves numbers, and takes those of the other.
class MeetingPlace {
 public:
  std::vector<double> swap(int part, std::vector<double> mine) {
    std::unique_lock lock(mutex_);
    left_[part] = std::move(mine);
    meet(lock);
    std::vector<double> theirs = left_[1 - part];
    meet(lock);
    return theirs;
  }

 private:
  void meet(std::unique_lock<std::mutex>& lock) {
    const int round = round_;
    if (++arrived_ == 2) {
      arrived_ = 0;
      ++round_;
      both_.notify_all();
    } else {
      both_.wait(lock, [&] { return round_ != round; });
    }
  }

  std::mutex mutex_;
  std::condition_variable both_;
  std::array<std::vector<double>, 2> left_;
  int arrived_ = 0, round_ = 0;
};

constexpr int kLayer = 16, kShared = kLayer, kHalf = 4 * kLayer, kWhole = 7 * kLayer;
constexpr int kNodesBelow = kWhole - kHalf, kElementsBelow = 8;

/// Part 0 is below the cut, and its last nodes are ghosts of the first nodes of part 1.
class TwoPartHalo final : public structure::Halo {
 public:
  using Halo::sum;
  TwoPartHalo(MeetingPlace& place, int part) : place_(place), part_(part) {}

  Eigen::Index owned(Eigen::Index held) const override { return part_ == 0 ? held - kShared : held; }
  structure::Id node_id(Eigen::Index held) const override { return held + part_ * kNodesBelow; }
  structure::Id element_id(Eigen::Index held) const override { return held + part_ * kElementsBelow; }
  void finish_sum(NodalVectors& values) const override {
    const NodalVectors theirs = swapped(values);
    if (part_ == 1) values.leftCols(kShared) += theirs;
  }
  void owners_to_ghosts(NodalVectors& values) const override {
    const NodalVectors theirs = swapped(values);
    if (part_ == 0) values.rightCols(kShared) = theirs;
  }
  void sum(structure::ExactSum* sums, std::size_t count) const override {
    for (std::size_t i = 0; i < count; ++i) {
      auto& words = sums[i].words();
      const std::vector<double> theirs = place_.swap(part_, {words.begin(), words.end()});  // below 2^53
      for (std::size_t k = 0; k < words.size(); ++k) words[k] += static_cast<std::int64_t>(theirs[k]);
    }
  }
  double largest(double value) const override {
    const double theirs = place_.swap(part_, {value}).front();
    return std::isnan(value) || value > theirs ? value : theirs;
  }

  /// Those of part 0 come first.
  void in_slices(const std::vector<structure::Id>&, const double* rows, std::size_t numbers,
                 const VisitRows& visit) const override {
    const std::vector<double> mine(rows, rows + numbers), theirs = place_.swap(part_, mine);
    for (const auto* some : {part_ == 0 ? &mine : &theirs, part_ == 0 ? &theirs : &mine})
      visit(some->data(), some->size());
  }

 private:
  NodalVectors swapped(const NodalVectors& values) const {
    const NodalVectors mine = part_ == 0 ? values.rightCols(kShared) : values.leftCols(kShared);
    const std::vector<double> theirs = place_.swap(part_, {mine.data(), mine.data() + mine.size()});
    return Eigen::Map<const NodalVectors>(theirs.data(), 3, kShared);
  }

  MeetingPlace& place_;
  int part_;
};

/// A tower of two distorted cubes of 2 x 2 x 2 elements, one on the other: the basis is only continuous at
/// the cut, so that each cube is a patch of its own.  Nodes go up layer by layer.
struct Tower {
  nurbs::KnotVector fine = nurbs::KnotVector::uniform(2, 2), tall{2, {0, 0, 0, .25, .5, .5, .75, 1, 1, 1}};
  nurbs::Volume whole =
      models::distorted(nurbs::box(Vector3::Zero(), Vector3(2, 2, 4), {fine, fine, tall}), 0.1);

  structure::Integration integration = {};

  std::unique_ptr<Solid> solid(nurbs::Volume patch) const {
    return std::make_unique<Solid>(
        std::move(patch), std::make_shared<test::StandardLinearSolid>(1.0, 0.3, 1.0, 0.4, 2.0), integration);
  }
  std::unique_ptr<Solid> half(int part) const {
    return solid({nurbs::Space<3>({fine, fine, fine}), own(whole.control_points, part)});
  }
  static NodalVectors own(const NodalVectors& values, int part) {
    return part == 0 ? values.leftCols(kHalf) : values.rightCols(kHalf);
  }
};

/// What a run gives.
struct Results {
  std::vector<double> saved;  // at the end of it
  NodalVectors u, v;
  double stable, kinetic, strain, load_work;
  structure::Work work;
  Vector3 linear, angular;
  std::optional<double> blown_up_at;
  std::string words;  // of that
};

/// From random velocities v, under gravity and forces F, fixed at the foot if it has one.
Results run(ExplicitSolver solver, const NodalVectors& v, const NodalVectors& F, double dt, int steps,
            const std::vector<double>& state = {}) {
  Results r;
  solver.set_load(Vector3(0.01, 0.0, -0.02) * solver.mass().nodal_mass().transpose());
  solver.set_velocities(v);
  r.stable = solver.stable_time_step();
  solver.set_time_step(dt);
  if (!state.empty()) solver.load(state);
  try {
    solver.initialise_forces(F);
    for (int n = 0; n < steps; ++n) {
      solver.begin_step();
      solver.end_step(F);
    }
  } catch (const structure::Diverged& problem) {
    r.blown_up_at = solver.time();
    r.words = problem.what();
    return r;
  }
  r.u = solver.displacements(), r.v = solver.velocities();
  r.kinetic = solver.kinetic_energy(), r.strain = solver.strain_energy(), r.load_work = solver.load_work();
  r.work = solver.work();
  r.saved = solver.save();
  r.linear = solver.linear_momentum(), r.angular = solver.angular_momentum({1, 2, 3});
  return r;
}

structure::Supports foot(const nurbs::Space<3>& space) {
  structure::Supports supports;
  supports.fix(structure::nodes_on(space, {nurbs::Face::zeta_minus}), {true, true, false});
  return supports;
}

struct Runs {
  Results whole;
  std::array<Results, 2> parts;
};

/// From `state` instead, if there is one.
Runs run_both(double dt, int steps, const std::vector<double>& state = {},
              structure::TimeMass mass = structure::TimeMass::lumped) {
  Tower tower;
  tower.integration.mass = mass;
  const NodalVectors v = 0.1 * models::random_vectors(kWhole, 5),
                     F = 0.01 * models::random_vectors(kWhole, 6);
  Runs runs;
  runs.whole = run(ExplicitSolver(tower.solid(tower.whole), foot(tower.whole.space)), v, F, dt, steps, state);
  MeetingPlace place;
  const auto run_part = [&](int part) {
    std::unique_ptr<Solid> half = tower.half(part);
    structure::Supports supports = part == 0 ? foot(half->space()) : structure::Supports();
    runs.parts[part] =
        run(ExplicitSolver(std::move(half), std::move(supports), std::make_unique<TwoPartHalo>(place, part)),
            Tower::own(v, part), Tower::own(F, part), dt, steps, state);
  };
  std::thread lower([&] { run_part(0); });
  run_part(1);
  lower.join();
  return runs;
}

void expect_parts_to_move_as_the_whole(structure::TimeMass mass) {
  const Runs runs = run_both(0.1, 100, {}, mass);
  const Results& whole = runs.whole;
  ASSERT_EQ(whole.u.cols(), kWhole);
  for (int part = 0; part < 2; ++part) {
    SCOPED_TRACE(part);
    const Results& r = runs.parts[part];
    EXPECT_LT((r.u - Tower::own(whole.u, part)).norm(), 1e-12 * whole.u.norm());
    EXPECT_LT((r.v - Tower::own(whole.v, part)).norm(), 1e-12 * whole.v.norm());
    EXPECT_NEAR(r.stable / whole.stable, 1.0, 1e-9) << "the random start goes by ids";
    EXPECT_NEAR(r.kinetic / whole.kinetic, 1.0, 1e-12);
    EXPECT_NEAR(r.strain / whole.strain, 1.0, 1e-12);
    EXPECT_NEAR(r.load_work / whole.load_work, 1.0, 1e-12);
    EXPECT_NEAR(r.work.internal / whole.work.internal, 1.0, 1e-12);
    EXPECT_NEAR(r.work.loads / whole.work.loads, 1.0, 1e-12);
    EXPECT_NEAR(r.work.forces / whole.work.forces, 1.0, 1e-12);
    EXPECT_LT((r.linear - whole.linear).norm(), 1e-12 * whole.linear.norm());
    EXPECT_LT((r.angular - whole.angular).norm(), 1e-12 * whole.angular.norm());
  }
  EXPECT_EQ(runs.parts[0].u.rightCols(kShared), runs.parts[1].u.leftCols(kShared))
      << "ghosts move as their owners, to the last bit";
  EXPECT_EQ(runs.parts[0].kinetic, runs.parts[1].kinetic);
  EXPECT_EQ(runs.parts[0].stable, runs.parts[1].stable);
}

TEST(Halo, TwoPartsMoveAsTheWholeBodyDoes) { expect_parts_to_move_as_the_whole(structure::TimeMass::lumped); }

TEST(Halo, SoTheyDoWithCorrectedMass) { expect_parts_to_move_as_the_whole(structure::TimeMass::corrected); }

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  using Values = Eigen::Map<const Eigen::VectorXd>;
  return (Values(a.data(), a.size()) - Values(b.data(), b.size())).cwiseAbs().maxCoeff();
}

// A state is that of the whole body, in the order of ids: it does not show how the body was cut.
TEST(Halo, AStateGoesFromAWholeBodyToPartsAndBack) {
  const Runs runs = run_both(0.1, 30), further = run_both(0.1, 60);
  for (const Results& r : runs.parts) {
    ASSERT_EQ(r.saved.size(), 1u + 9 * kWhole + 16 * 27 * 18);
    EXPECT_EQ(r.saved, runs.parts[0].saved);
    EXPECT_LT(distance(r.saved, runs.whole.saved), 1e-13);
  }
  const Runs from_whole = run_both(0.1, 30, runs.whole.saved),
             from_parts = run_both(0.1, 30, runs.parts[0].saved);
  EXPECT_EQ(from_whole.whole.saved, further.whole.saved) << "to the last bit";
  EXPECT_EQ(from_parts.parts[1].saved, further.parts[1].saved) << "to the last bit";
  EXPECT_LT(distance(from_whole.parts[1].saved, further.whole.saved), 1e-13);
  EXPECT_LT(distance(from_parts.whole.saved, further.whole.saved), 1e-13);
}

TEST(Halo, BothPartsNoticeThatTheBodyBlowsUp) {
  const Runs runs = run_both(1.0, 1000);
  ASSERT_TRUE(runs.whole.blown_up_at);
  for (const Results& r : runs.parts) {
    ASSERT_TRUE(r.blown_up_at);
    EXPECT_EQ(*r.blown_up_at, *runs.whole.blown_up_at);
    EXPECT_EQ(r.words, runs.whole.words);
  }
}

/// What is said of a last step with these displacements and velocities under forces F, by the whole body and
/// by both parts.
std::array<std::string, 3> said_of(const NodalVectors& u, const NodalVectors& v, const NodalVectors& F) {
  const Tower tower;
  const NodalVectors a = NodalVectors::Zero(3, kWhole);
  const auto say = [&](const Solid& body, const structure::Halo& halo, const auto& own) {
    const structure::LumpedMass mass(structure::whole(halo, body.row_sum_mass()));
    const NodalVectors of_u = own(u), of_v = own(v), of_a = own(a), of_F = own(F);
    return structure::describe_divergence(
        {body, halo, mass, of_u, of_v, of_a, of_F, 2.0, 0.1, {}, 50.0, 3.0});
  };
  MeetingPlace place;
  const auto say_of_part = [&](int part) {
    return say(*tower.half(part), TwoPartHalo(place, part),
               [&](const NodalVectors& values) { return Tower::own(values, part); });
  };
  std::array<std::string, 3> said;
  said[0] =
      say(*tower.solid(tower.whole), structure::Halo(), [](const NodalVectors& values) { return values; });
  std::thread lower([&] { said[1] = say_of_part(0); });
  said[2] = say_of_part(1);
  lower.join();
  return said;
}

/// Each half is a patch, with spans of its own.
std::string up_to_spans(const std::string& words) { return words.substr(0, words.find("(spans")); }

TEST(Halo, BothPartsTellOfTheWorstNodeOfAll) {
  const NodalVectors none = NodalVectors::Zero(3, kWhole);
  for (const int node : {3, kNodesBelow - 1, kNodesBelow, kHalf - 1, kWhole - 1}) {
    NodalVectors one = none, lesser = none, no_number = none;
    one(1, node) = 7.0;
    lesser(2, kWhole - 1 - node) = 6.0;
    no_number(0, node) = std::nan("");
    const std::string at_node = " at control node " + std::to_string(node) + ",";
    for (const auto& [said, what] :
         {std::pair{said_of(no_number, none, none), "displacement is not finite"},
          std::pair{said_of(1e101 * one + 1e101 * lesser, none, none), "displacement is 7e+101"},
          std::pair{said_of(none, one + lesser, none), "given, most"},
          std::pair{said_of(none, one, no_number), "contact force is not finite"}}) {
      EXPECT_THAT(said[0], HasSubstr(what + at_node));
      EXPECT_EQ(up_to_spans(said[1]), up_to_spans(said[0]));
      EXPECT_EQ(said[2], said[1]);
    }
  }
}

TEST(Halo, BothPartsTellOfTheElementThatIsFoldedMost) {
  for (const int layer : {1, 5}) {  // inside of either part
    NodalVectors u = NodalVectors::Zero(3, kWhole);
    u(2, layer * kLayer + 5) = 3.0;
    u(2, (6 - layer) * kLayer + 5) = -2.5;
    const std::array<std::string, 3> said = said_of(u, u, 0.0 * u);
    EXPECT_THAT(said[0], HasSubstr("is folded"));
    EXPECT_EQ(up_to_spans(said[1]), up_to_spans(said[0]));
    EXPECT_EQ(said[2], said[1]);
  }
}

}  // namespace

// SPDX-License-Identifier: GPL-2.0-or-later
// Times the internal force of a plate and whole time steps, beside products by the assembled stiffness
// matrix, and what the machine can do at most.  Names are WHAT/METHOD/LAW/BODY/pDEGREE; one iteration is one
// evaluation.  Counters: dofs; bytes and flops of one evaluation (cost.h); `error`, the largest difference
// from the force that gauss_loop.h integrates on its own, over the largest of that.
//   benchmark_internal_force [--small] [Google Benchmark options]     --small: few elements, to check results
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "bodies.h"
#include "cost.h"
#include "cpu_seconds.h"
#include "gauss_loop.h"
#include "huge_pages.h"
#include "machine_kernels.h"
#include "nurbs/simd_level.h"
#include "volumes.h"

namespace benchmarks {
namespace {

using nurbs::NodalVectors;

struct Sizes {
  std::array<int, 3> elements = {31, 31, 8};
  std::size_t numbers_read = std::size_t(15) << 20;  // 120 MB
  std::size_t rounds = 100000;                       // of multiplications with addition
};

double material_flops(const std::string& law) {
  return law == "linear_elastic" ? MaterialFlops::kLinear
         : law == "neo_hooke"    ? MaterialFlops::kNeoHooke
                                 : MaterialFlops::kSaintVenantKirchhoff;
}

const std::vector<std::string> kLaws = {"linear_elastic", "saint_venant_kirchhoff", "neo_hooke"};

/// A body and its displacements.
struct Case {
  Case(const std::string& name, const Sizes& sizes, int degree)
      : label("/" + name + "/p" + std::to_string(degree)),
        volume(make_volume(name, sizes.elements, degree)),
        u(random_displacements(volume.space.control_point_count(), 1e-6)) {}
  int dofs() const { return static_cast<int>(u.size()); }
  /// Their forces, integrated on their own; kept.
  const NodalVectors& expected(const std::string& law, Rule rule) {
    NodalVectors& f = forces[{law, rule}];
    if (f.size() == 0) f = integrated_force(volume, rule, law, kLambda, kMu, u);
    return f;
  }

  std::string label;
  nurbs::Volume volume;
  NodalVectors u;
  std::map<std::pair<std::string, Rule>, NodalVectors> forces;
};

/// A way to the forces, and what it has to do.
struct Operator {
  std::function<void(const NodalVectors& u, NodalVectors& f)> force;
  Cost cost;
};

/// The operator is made when it is first timed, and kept.
void add_force(Case& c, const std::string& method, const std::string& law, Rule rule,
               std::function<Operator()> make) {
  auto made = std::make_shared<std::optional<Operator>>();
  const std::string name = "force/" + method + "/" + law + c.label;
  benchmark::RegisterBenchmark(name.c_str(), [=, &c](benchmark::State& state) {
    if (!*made) *made = make();
    NodalVectors f(3, c.u.cols());
    for (auto _ : state) {
      (*made)->force(c.u, f);
      benchmark::DoNotOptimize(f.data());
    }
    const NodalVectors& expected = c.expected(law, rule);
    state.counters["dofs"] = c.dofs();
    state.counters["bytes"] = (*made)->cost.bytes;
    state.counters["flops"] = (*made)->cost.flops;
    state.counters["error"] = (f - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
  })->Unit(benchmark::kMillisecond);
}

Rule rule_of(structure::Quadrature quadrature) {
  if (quadrature == structure::Quadrature::full) return Rule::full;
  return quadrature == structure::Quadrature::reduced ? Rule::reduced : Rule::zou;
}

/// Of the method that was chosen.
Cost cost_of(const structure::Integration& chosen, const nurbs::Space<3>& space, const std::string& law) {
  const double flops = material_flops(law);
  if (chosen.method == structure::IntegrationMethod::elements)
    return plain_cost(space, space.functions_per_element(), flops);
  std::array<double, 3> points = {0.0, 0.0, 0.0};
  for (int d = 0; d < 3; ++d)
    for (int span = 0; span < space.knots(d).element_count(); ++span)
      points[d] += gauss_points(rule_of(chosen.quadrature), space.knots(d), span);
  return sweep_cost(space, points, chosen.method, flops);
}

void add_solids(Case& c) {
  for (const Method& method : methods())
    for (const std::string& law : kLaws)
      add_force(c, method.name, law, rule_of(method.integration.quadrature),
                [&c, &method, law]() -> Operator {
                  const std::shared_ptr<const structure::Solid> solid = make_solid(method, c.volume, law);
                  return {[solid](const NodalVectors& u, NodalVectors& f) { solid->internal_force(u, f); },
                          cost_of(solid->integration(), c.volume.space, law)};
                });
}

/// Products by the assembled matrix: as many numbers for all bodies, so the plate's are timed.
void add_matrices(Case& c) {
  const auto add = [&c](const std::string& method, std::function<Operator()> make) {
    add_force(c, method, "linear_elastic", Rule::full, std::move(make));
  };
  const auto K = std::make_shared<const BlockMatrix>(assemble_stiffness(c.volume, kLambda, kMu));
  const Cost block = block_cost(c.volume.space, *K);
  add("csr", [&c, K]() -> Operator {
    const auto csr = std::make_shared<const CsrMatrix>(to_csr(*K));
    return {[csr](const NodalVectors& u, NodalVectors& f) {
              Eigen::Map<Eigen::VectorXd>(f.data(), f.size()).noalias() =
                  *csr * Eigen::Map<const Eigen::VectorXd>(u.data(), u.size());
            },
            csr_cost(c.volume.space, *csr)};
  });
  add("blocks", [K, block]() -> Operator {
    return {[K](const NodalVectors& u, NodalVectors& f) {
              machine_kernels().multiply(K->view(), u.data(), f.data());
            },
            block};
  });
  add("blocks_huge_pages", [K, block]() -> Operator {
    const auto columns = in_huge_pages(K->column.data(), K->column.size());
    const auto values = in_huge_pages(K->values.data(), K->values.size());
    return {[=](const NodalVectors& u, NodalVectors& f) {
              const BlockRows rows = K->view();
              machine_kernels().multiply({rows.rows, rows.begin, columns->data(), values->data()}, u.data(),
                                         f.data());
            },
            block};
  });
}

/// A step and a force alone take turns, so that whatever else the machine does hits both; the counter
/// `over_force` is the ratio of their times.
void add_step(Case& c, const Method& method, int layers) {
  auto solver = std::make_shared<std::unique_ptr<structure::ExplicitSolver>>();
  const std::string name = "step/" + method.name + "/linear_elastic" + c.label;
  benchmark::RegisterBenchmark(
      name.c_str(),
      [=, &c](benchmark::State& state) {
        const NodalVectors none = NodalVectors::Zero(3, c.u.cols());
        NodalVectors f = none;
        if (!*solver) *solver = ringing(make_solid(method, c.volume, "linear_elastic"), layers);
        double force = 0.0, step = 0.0;
        for (auto _ : state) {
          force += cpu_seconds([&] { (*solver)->body().internal_force((*solver)->displacements(), f); });
          const double once = cpu_seconds([&] { (*solver)->begin_step(), (*solver)->end_step(none); });
          state.SetIterationTime(once);
          step += once;
        }
        state.counters["dofs"] = c.dofs();
        state.counters["over_force"] = step / force;
      })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime();
}

template <class Numbers>
void add_read(const std::string& name, std::size_t count) {
  auto numbers = std::make_shared<Numbers>();
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    numbers->resize(count, 1.0);
    for (auto _ : state) benchmark::DoNotOptimize(machine_kernels().read(numbers->data(), count));
    state.counters["bytes"] = 8.0 * static_cast<double>(count);
  })->Unit(benchmark::kMillisecond);
}

void add_probes(const Sizes& sizes) {
  add_read<std::vector<double>>("probe/read", sizes.numbers_read);
  add_read<LongVector<double>>("probe/read_huge_pages", sizes.numbers_read);
  benchmark::RegisterBenchmark("probe/multiply_add", [sizes](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(machine_kernels().multiply_add(sizes.rounds, 0.5, 1.0));
    state.counters["flops"] = machine_kernels().flops_per_round * static_cast<double>(sizes.rounds);
  })->Unit(benchmark::kMillisecond);
}

/// Whether `--small` is given; takes it from the arguments.
bool take_small(int& argc, char** argv) {
  char** const end =
      std::remove_if(argv + 1, argv + argc, [](char* word) { return !std::strcmp(word, "--small"); });
  const bool found = end != argv + argc;
  argc = static_cast<int>(end - argv);
  return found;
}

}  // namespace
}  // namespace benchmarks

int main(int argc, char** argv) {
  using namespace benchmarks;
  Sizes sizes;
  if (take_small(argc, argv)) sizes = {{5, 4, 3}, std::size_t(1) << 16, 100};
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("dispatched_to", nurbs::name(nurbs::simd_level()));
  add_probes(sizes);
  std::vector<std::unique_ptr<Case>> cases;
  for (int degree : {2, 3})
    for (const char* name : {"plate", "distorted", "rational"}) {
      Case& c = *cases.emplace_back(std::make_unique<Case>(name, sizes, degree));
      add_solids(c);
      if (c.label.find("plate") != std::string::npos) {
        add_matrices(c);
        for (const Method& method : methods()) add_step(c, method, sizes.elements[2]);
      }
    }
  benchmark::RunSpecifiedBenchmarks();
}

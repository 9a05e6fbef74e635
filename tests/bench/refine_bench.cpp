// SPDX-License-Identifier: BSD-3-Clause
// How fast skins are refined, and which share of that is projection, on one core:
//   refine_bench [--benchmark_filter=REGEX]
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "tessera/mesh/complex.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "support/flat_model.hpp"

#include "subject.hpp"

namespace tessera {
namespace {

constexpr int kLevels = 4;

double num_points(const mesh::Complex& skin)
{
  const LocalIndex n = mesh::lattice::intervals(kLevels);
  return static_cast<double>(skin.num_vertices())
         + static_cast<double>(skin.num_edges()) * mesh::lattice::num_inner_edge_points(n)
         + static_cast<double>(skin.num_triangles()) * mesh::lattice::num_inner_triangle_points(n);
}

void refine_skin(benchmark::State& state, const testing::Subject& subject,
                 const model::Model& model)
{
  const mesh::Complex skin = mesh::skin_complex(subject.skeleton, 0);
  const mesh::ProjectionLimiter no_limits;
  const refine::RefineContext context{subject.coarse, subject.skeleton, model, no_limits, kLevels};
  for (auto _ : state) {
    benchmark::DoNotOptimize(refine::refine_lattice(skin, context));
  }
  state.counters["points/s"] = benchmark::Counter(
      num_points(skin) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

}  // namespace
}  // namespace tessera

// Usage: refine_bench [benchmark options] MODEL=MAX_SIZE...
// Each model is refined as it is and with projection left out: the difference is projection.
int main(int argc, char** argv)
{
  using namespace tessera;
  benchmark::Initialize(&argc, argv);
  const testing::FlatModel flat;
  std::vector<std::unique_ptr<testing::Subject>> subjects;
  for (int i = 1; i < argc; ++i) {
    subjects.push_back(std::make_unique<testing::Subject>(argv[i]));
    const testing::Subject& subject = *subjects.back();
    benchmark::RegisterBenchmark((subject.file + "/projected").c_str(), [&](benchmark::State& s) {
      refine_skin(s, subject, *subject.model);
    });
    benchmark::RegisterBenchmark((subject.file + "/flat").c_str(),
                                 [&](benchmark::State& s) { refine_skin(s, subject, flat); });
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

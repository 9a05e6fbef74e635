// SPDX-License-Identifier: BSD-3-Clause
// How many tets a second subdivision makes in memory, projection included, on one core.
//
//   subdivide_bench [benchmark options] MODEL=MAX_SIZE...
//
// Each model on 3, 4 and 5 levels, in batches of coarse tets that make about 500 k tets, as the
// jobs of a run do.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "tessera/fill/subdivide.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "subject.hpp"

namespace tessera {
namespace {

using testing::Subject;

constexpr GlobalIndex kBatchTets = 500'000;

// Consecutive coarse tets that make one batch.
std::vector<std::vector<LocalIndex>> batches_of(const Subject& subject, int levels)
{
  const auto batch_size = static_cast<std::size_t>(
      std::max<GlobalIndex>(1, kBatchTets / (GlobalIndex{1} << (3 * levels))));
  std::vector<std::vector<LocalIndex>> batches;
  for (LocalIndex t = 0; t < subject.coarse.num_tets(); ++t) {
    if (batches.empty() || batches.back().size() == batch_size) batches.emplace_back();
    batches.back().push_back(t);
  }
  return batches;
}

void subdivide(benchmark::State& state, const Subject& subject, int levels)
{
  const mesh::ProjectionLimiter no_limits;
  const refine::RefineContext context{subject.coarse, subject.skeleton, *subject.model, no_limits,
                                      levels};
  const auto batches = batches_of(subject, levels);
  std::size_t next = 0;
  GlobalIndex num_tets = 0;
  for (auto _ : state) {
    const mesh::TetComplex complex =
        mesh::tet_complex(subject.coarse, subject.skeleton, batches[next]);
    const fill::FillOutput tets =
        fill::subdivide(complex, refine::refine_lattice(complex.faces, context));
    num_tets += static_cast<GlobalIndex>(tets.tet_vertices.size() / 4);
    next = (next + 1) % batches.size();
  }
  state.counters["tets/s"] =
      benchmark::Counter(static_cast<double>(num_tets), benchmark::Counter::kIsRate);
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  using namespace tessera;
  benchmark::Initialize(&argc, argv);
  std::vector<std::unique_ptr<Subject>> subjects;
  for (int i = 1; i < argc; ++i) {
    subjects.push_back(std::make_unique<Subject>(argv[i]));
    const Subject& subject = *subjects.back();
    for (const int levels : {3, 4, 5}) {
      const std::string name = subject.file + "/levels:" + std::to_string(levels);
      benchmark::RegisterBenchmark(name.c_str(), [&subject, levels](benchmark::State& state) {
        subdivide(state, subject, levels);
      });
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

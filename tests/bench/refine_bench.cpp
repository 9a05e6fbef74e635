// SPDX-License-Identifier: BSD-3-Clause
// How fast skins are refined, and which share of that is projection, on one core.
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <string>

#include <benchmark/benchmark.h>

#include "tessera/mesh/complex.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "support/decompositions.hpp"
#include "support/flat_model.hpp"

namespace tessera {
namespace {

constexpr int kLevels = 4;

// A loaded model with its coarse mesh as one subdomain.
struct Subject {
  std::unique_ptr<model::Model> model;
  mesh::CoarseMesh coarse;
  mesh::Skeleton skeleton;
  mesh::Complex skin;

  Subject(const std::string& file, double max_size)
      : model(netgen::load_model(netgen::import_model(file, {}))),
        coarse(netgen::make_coarse_mesher(*model)->generate({.max_size = max_size})),
        skeleton(mesh::build_skeleton(coarse, testing::one_subdomain_a_material(coarse))),
        skin(mesh::skin_complex(skeleton, 0))
  {
  }
};

double num_points(const mesh::Complex& skin)
{
  const LocalIndex n = mesh::lattice::intervals(kLevels);
  return static_cast<double>(skin.num_vertices())
         + static_cast<double>(skin.num_edges()) * mesh::lattice::num_inner_edge_points(n)
         + static_cast<double>(skin.num_triangles()) * mesh::lattice::num_inner_triangle_points(n);
}

void refine_skin(benchmark::State& state, const Subject& subject, const model::Model& model)
{
  const mesh::Damping no_damping;
  const refine::RefineContext context{subject.coarse, subject.skeleton, model, no_damping, kLevels};
  for (auto _ : state) {
    benchmark::DoNotOptimize(refine::refine_lattice(subject.skin, context));
  }
  state.counters["points/s"] =
      benchmark::Counter(num_points(subject.skin) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
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
  std::vector<std::unique_ptr<Subject>> subjects;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t equals = argument.rfind('=');
    if (equals == std::string::npos) {
      std::fprintf(stderr, "%s: expected MODEL=MAX_SIZE\n", argv[i]);
      return 64;
    }
    const std::string file = argument.substr(0, equals);
    subjects.push_back(std::make_unique<Subject>(file, std::stod(argument.substr(equals + 1))));
    const Subject& subject = *subjects.back();
    benchmark::RegisterBenchmark((file + "/projected").c_str(), [&](benchmark::State& s) {
      refine_skin(s, subject, *subject.model);
    });
    benchmark::RegisterBenchmark((file + "/flat").c_str(),
                                 [&](benchmark::State& s) { refine_skin(s, subject, flat); });
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

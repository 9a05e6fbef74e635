// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/decompose_stage.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/share_on_node.hpp"
#include "tessera/decompose/graph_partitioner.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"
#include "tessera/fill/fallbacks.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

// A job that subdivides so many takes half a second and about 100 MB.
constexpr double kAutoSubdividedTets = 5e5;

// A job that splits so many takes one to two seconds and about 450 MB.
constexpr double kMostSplitTets = 2e6;

// What "auto" means for the kernels. Subdivision wants jobs that fit in memory, the others few
// seams.
decompose::DecomposeOptions options_of(const RunResult& run,
                                       const std::vector<fill::KernelKind>& kernels)
{
  decompose::DecomposeOptions options = run.resolved.decompose;
  options.parts = run.resolved.output.parts;
  if (are_counts_known(kernels)) options.tets_a_subdomain = kAutoSubdividedTets;
  if (run.splits > 0) {
    options.tets_a_subdomain =
        std::min(std::ldexp(options.tets_a_subdomain, 3 * run.splits), kMostSplitTets);
  }
  return options;
}

// Fine tets in place of each coarse one.
std::vector<double> weights_of(const RunResult& run)
{
  std::vector<double> weights =
      decompose::predicted_fine_tets(run.coarse.mesh, run.levels.shifted(-run.splits));
  for (double& weight : weights) weight = std::ldexp(weight, 3 * run.splits);
  return weights;
}

std::unique_ptr<decompose::GraphPartitioner> partitioner_of(decompose::Method method)
{
  return method == decompose::Method::octree ? decompose::make_octree_partitioner()
                                             : decompose::make_metis_partitioner();
}

decompose::DecomposeResult cut(const RunResult& run)
{
  const mesh::CoarseMesh& coarse = run.coarse.mesh;
  const std::vector<fill::KernelKind> kernels =
      fill::kernels_of(run.resolved.fill, coarse.material_names, coarse.tet_material);
  const std::vector<double> weights = weights_of(run);
  const auto partitioner = partitioner_of(run.resolved.decompose.method);
  decompose::DecomposeResult result = decompose::decompose(
      coarse, options_of(run, kernels), weights, *partitioner, run.coarse.tet_part);
  decompose::validate(coarse, result.decomposition);
  return result;
}

}  // namespace

std::optional<std::string> too_many_subdomains(const config::Case& run_case,
                                               const mesh::CoarseMesh& coarse)
{
  if (run_case.decompose.subdomains <= coarse.num_tets()) return std::nullopt;
  return fmt::format(
      "decompose.subdomains is {}, but the coarse mesh has only {} tets: that is the most "
      "subdomains there can be; a smaller coarse.max_size allows more",
      run_case.decompose.subdomains, coarse.num_tets());
}

decompose::DecomposeResult run_decompose_stage(const RunResult& run, RunContext& context)
{
  StageScope stage(context, Stage::decompose);
  if (const auto warning = too_many_subdomains(run.resolved, run.coarse.mesh)) {
    context.log.warn(*warning);
  }
  decompose::DecomposeResult result = on_root_of_nodes(
      context.comm, [&] { return with_file_context(run.resolved, [&] { return cut(run); }); });
  stage.work_is_done();
  stage.finish(fmt::format("{} subdomains", result.report.num_subdomains));
  return result;
}

}  // namespace tessera::pipeline

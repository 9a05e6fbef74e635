// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/levels_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"
#include "tessera/fill/fallbacks.hpp"
#include "tessera/mesh/coarse_edges.hpp"
#include "tessera/refine/choose_levels.hpp"
#include "tessera/sizing/coarse_sizes.hpp"
#include "tessera/subdomain/read_size_field.hpp"

#include "pipeline/estimate/run_outline.hpp"
#include "pipeline/runtime/with_file_context.hpp"

namespace tessera::pipeline {
namespace {

// Largest size of a coarse mesh in wanted ones where nothing else tells. As of size.target,
// NETGEN's edges come out longer: four parts of each are as long as is wanted. On a bar with a box
// of 0.1 to 0.4, 95 % of the edges had at most 1.34 wanted ones with 3.3, 1.45 with 4 and 1.47
// with 2.5.
constexpr double kUsualLength = 3.3;

// In wanted lengths. Where the size is the same along an edge, its parts have at most 1.4.
constexpr double kLongestPart = 1.5;

double usual_length(const config::Case& resolved)
{
  if (resolved.size.target == 0.0) return kUsualLength;
  return std::max(kUsualLength, resolved.coarse.max_size / resolved.size.target);
}

// How many wanted lengths each edge is long.
std::vector<double> num_wanted(const sizing::SizeOptions& options, const mesh::CoarseMesh& coarse,
                               const sizing::SizeField& sizes, const std::vector<LocalIndex>& edges)
{
  std::vector<double> wanted = sizing::edge_size_integrals(coarse, edges, sizes);
  if (options.curvature == 0.0) return wanted;
  const std::vector<double> radii = sizing::lengths_in_radii(coarse, edges);
  for (std::size_t e = 0; e < wanted.size(); ++e) {
    wanted[e] = std::max(wanted[e], options.curvature * radii[e]);
  }
  return wanted;
}

mesh::EdgeLevels wanted_levels(const config::Case& resolved, const mesh::CoarseMesh& coarse,
                               const sizing::SizeField& sizes)
{
  std::vector<LocalIndex> edges = mesh::coarse_edges(coarse);
  const std::vector<double> wanted = num_wanted(resolved.size, coarse, sizes, edges);
  return refine::choose_levels(coarse, std::move(edges), wanted,
                               refine::levels_of(resolved.refine, true));
}

mesh::SizePoints points_of_smaller_sizes(const config::Case& resolved,
                                         const mesh::CoarseMesh& coarse)
{
  const sizing::SizeField sizes = subdomain::read_size_field(resolved.size, coarse);
  return sizing::coarse_size_points(coarse, wanted_levels(resolved, coarse, sizes), sizes,
                                    {usual_length(resolved), kLongestPart});
}

// A split is of all tets, those as well that were cut beside a finer edge. It must not make the
// mesh much finer than is wanted: then there are fewer splits, and the fills have more levels.
int splits_of(const config::Case& resolved, const mesh::CoarseMesh& coarse,
              const mesh::EdgeLevels& wanted)
{
  constexpr double kMostMoreTets = 1.1;
  const auto kernels = fill::kernels_of(resolved.fill, coarse.material_names, coarse.tet_material);
  int splits = splits_after_fill(resolved.fill, kernels, wanted.largest());
  if (splits == 0 || wanted.is_uniform()) return splits;
  const auto num_tets = [&](int num_splits) {
    const auto filled = wanted.raised(num_splits).shifted(-num_splits);
    const auto of_tets = decompose::predicted_fine_tets(coarse, filled);
    return std::ldexp(std::accumulate(of_tets.begin(), of_tets.end(), 0.0), 3 * num_splits);
  };
  const double most = kMostMoreTets * num_tets(0);
  while (splits > 0 && num_tets(splits) > most) --splits;
  return splits;
}

LevelChoice split_choice(const config::Case& resolved, const mesh::CoarseMesh& coarse,
                         const mesh::EdgeLevels& wanted)
{
  const int splits =
      with_file_context(resolved, [&] { return splits_of(resolved, coarse, wanted); });
  return {.levels = wanted.raised(splits), .splits = splits};
}

}  // namespace

LevelChoice uniform_levels(const config::Case& resolved, const mesh::CoarseMesh& coarse)
{
  return split_choice(resolved, coarse, refine::levels_of(resolved.refine, false));
}

LevelChoice run_levels_stage(const config::Case& resolved, const mesh::CoarseMesh& coarse,
                             RunContext& context)
{
  StageScope stage(context, Stage::levels);
  const mesh::EdgeLevels wanted = comm::on_root(context.comm, [&] {
    return with_file_context(resolved, [&] {
      return wanted_levels(resolved, coarse, subdomain::read_size_field(resolved.size, coarse));
    });
  });
  LevelChoice choice = split_choice(resolved, coarse, wanted);
  const mesh::EdgeLevels& levels = choice.levels;
  stage.work_is_done();
  stage.finish(levels.is_uniform() ? fmt::format("{} for all edges", levels.largest())
                                   : fmt::format("up to {}", levels.largest()));
  return choice;
}

sizing::PartInSizes longest_edge_in_sizes(const RunResult& run, RunContext& context)
{
  return comm::on_root(context.comm, [&] {
    return with_file_context(run.resolved, [&] {
      const mesh::CoarseMesh& coarse = run.coarse.mesh;
      return sizing::longest_part_in_sizes(coarse, run.levels,
                                           subdomain::read_size_field(run.resolved.size, coarse),
                                           usual_length(run.resolved));
    });
  });
}

bool may_want_a_finer_mesh(const config::Case& resolved)
{
  return sizing::is_graded(resolved.size) && !model::is_mesh_name(resolved.geometry.file)
         && resolved.coarse.mesher != surface::Mesher::gmsh;
}

mesh::SizePoints sizes_for_a_finer_mesh(const RunResult& run, RunContext& context)
{
  StageScope stage(context, Stage::levels);
  mesh::SizePoints points = comm::on_root(context.comm, [&] {
    return with_file_context(
        run.resolved, [&] { return points_of_smaller_sizes(run.resolved, run.coarse.mesh); });
  });
  stage.work_is_done();
  stage.finish(points.size.empty() ? "the coarse mesh is fine enough"
                                   : "a finer coarse mesh is needed");
  return points;
}

}  // namespace tessera::pipeline

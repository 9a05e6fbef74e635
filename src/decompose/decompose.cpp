// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/decompose/decompose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "decompose/numbering.hpp"
#include "decompose/partition/initial_partition.hpp"
#include "decompose/repair/merge_small.hpp"
#include "decompose/repair/repair.hpp"
#include "decompose/repair/seam_angles.hpp"

namespace tessera::decompose {
namespace {

void check_arguments(const mesh::CoarseMesh& mesh, const DecomposeOptions& options,
                     std::span<const double> tet_weight, std::span<const LocalIndex> tet_part)
{
  if (options.subdomains < 0) {
    throw ConfigError(fmt::format("decompose.subdomains is {}; it must be at least 1, or \"auto\"",
                                  options.subdomains));
  }
  if (mesh.num_tets() == 0) throw MeshError("decompose: the coarse mesh has no tets");
  if (tet_weight.size() != static_cast<std::size_t>(mesh.num_tets())) {
    throw MeshError(
        fmt::format("decompose: {} weights for {} tets", tet_weight.size(), mesh.num_tets()));
  }
  if (!tet_part.empty() && tet_part.size() != tet_weight.size()) {
    throw MeshError(
        fmt::format("decompose: parts of {} tets for {}", tet_part.size(), mesh.num_tets()));
  }
}

LocalIndex automatic_number(const mesh::CoarseMesh& mesh, std::span<const double> tet_weight,
                            const DecomposeOptions& options)
{
  const double fine_tets = std::accumulate(tet_weight.begin(), tet_weight.end(), 0.0);
  const double by_tets = std::ceil(fine_tets / options.tets_a_subdomain);
  const auto most = static_cast<double>(mesh.num_tets());
  const LocalIndex least = std::max(options.least, kAutoSubdomainsAPart * options.parts);
  return std::clamp(std::max(static_cast<LocalIndex>(std::min(by_tets, most)), least), 1,
                    mesh.num_tets());
}

void measure(const TetGraph& graph, const mesh::Decomposition& decomposition,
             DecomposeReport& report)
{
  const auto& weight = decomposition.subdomain_weight;
  report.num_subdomains = decomposition.num_subdomains();
  report.max_weight = *std::max_element(weight.begin(), weight.end());
  report.mean_weight =
      std::accumulate(weight.begin(), weight.end(), 0.0) / static_cast<double>(weight.size());
  for (const mesh::TriangleTets& triangle : graph.triangles) {
    if (!is_seam(graph, decomposition, triangle)) continue;
    report.seam_area += triangle_area(*graph.mesh, triangle);
  }
  report.min_seam_dihedral_deg = min_seam_dihedral_deg(graph, decomposition);
}

}  // namespace

DecomposeResult decompose(const mesh::CoarseMesh& mesh, const DecomposeOptions& options,
                          std::span<const double> tet_weight, const GraphPartitioner& partitioner,
                          std::span<const LocalIndex> tet_part)
{
  check_arguments(mesh, options, tet_weight, tet_part);
  const TetGraph graph = make_tet_graph(mesh, tet_weight);
  const auto pieces = connected_pieces(graph, tet_part);

  DecomposeResult result;
  DecomposeReport& report = result.report;
  const LocalIndex number = options.subdomains > 0
                                ? std::min<LocalIndex>(options.subdomains, mesh.num_tets())
                                : automatic_number(mesh, tet_weight, options);
  report.num_wanted = std::max(number, static_cast<LocalIndex>(pieces.size()));

  TetPartition partition = partition_pieces(graph, pieces, report.num_wanted, partitioner);
  const RepairCounts repairs = repair(graph, partition);
  report.num_moves = repairs.num_moves;
  report.num_splits = repairs.num_splits;
  report.num_merges = merge_small(graph, partition, report.num_wanted);

  result.decomposition = number_subdomains(graph, partition, options.parts, partitioner);
  measure(graph, result.decomposition, report);
  return result;
}

}  // namespace tessera::decompose

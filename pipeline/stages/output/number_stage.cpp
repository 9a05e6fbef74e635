// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/output/number_stage.hpp"

#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/subdomain/count_pieces.hpp"
#include "tessera/subdomain/piece_surface.hpp"

#include "pipeline/store/improved_pieces.hpp"

namespace tessera::pipeline {
namespace {

number::IdLayout ids_of(const RunResult& run, const subdomain::PartitionedMesh& cut,
                        const RunOutline& outline)
{
  if (run.filled.improvement.pieces || run.filled.are_refined) {
    return number::IdLayout::by_owner(subdomain::counts_of(run.filled.pieces));
  }
  return number::IdLayout::by_host(
      mesh::HostLayout(cut.skeleton), mesh::lattice_levels(cut.skeleton, cut.levels),
      outline.are_counts_exact ? outline.pieces : subdomain::counts_of(run.filled.pieces));
}

std::function<std::vector<subdomain::VertexPlace>(const mesh::Piece&)> places_of_vertices(
    const RunResult& run, const subdomain::PartitionedMesh& cut)
{
  if (run.filled.are_refined) {
    return [hosts = mesh::HostLayout(cut.skeleton),
            counts = subdomain::counts_of(run.filled.pieces)](const mesh::Piece& piece) {
      return subdomain::places_of_split_piece(piece, hosts, counts[at(piece.subdomain)]);
    };
  }
  if (!run.filled.improvement.pieces) return {};
  return [pieces = run.filled.improvement.pieces](const mesh::Piece& piece) {
    return pieces->places_of(piece);
  };
}

std::function<std::vector<subdomain::VertexPlace>(std::span<const mesh::HostPoint>)>
places_of_names(const RunResult& run, const subdomain::PartitionedMesh& cut)
{
  if (run.filled.are_refined) {
    return [hosts = mesh::HostLayout(cut.skeleton)](std::span<const mesh::HostPoint> names) {
      return subdomain::places_of_split_names(names, hosts);
    };
  }
  if (!run.filled.improvement.pieces) return {};
  return [pieces = run.filled.improvement.pieces](std::span<const mesh::HostPoint> names) {
    return pieces->places_of_names(names);
  };
}

}  // namespace

NumberedMesh run_number_stage(const RunResult& run, const subdomain::PartitionedMesh& cut,
                              const RunOutline& outline)
{
  return {.ids = ids_of(run, cut, outline),
          .places_of = places_of_vertices(run, cut),
          .places_of_names = places_of_names(run, cut),
          .layers = subdomain::layer_tables(cut, run.filled.are_refined ? run.splits : 0)};
}

subdomain::WriteContext write_context(const NumberedMesh& numbered,
                                      const subdomain::PartitionedMesh& cut,
                                      const std::string& length_unit)
{
  return {.coarse = cut.coarse,
          .skeleton = cut.skeleton,
          .ids = numbered.ids,
          .length_unit = length_unit,
          .places_of = numbered.places_of,
          .places_of_names = numbered.places_of_names,
          .layers = numbered.layers ? &*numbered.layers : nullptr};
}

}  // namespace tessera::pipeline

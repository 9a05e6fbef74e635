// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/verify_stage.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/verify/euler.hpp"
#include "tessera/verify/seams.hpp"

namespace tessera::pipeline {
namespace {

std::optional<std::string> first_missing_piece(const std::vector<subdomain::SubdomainRange>& ranges,
                                               const std::vector<subdomain::PieceSummary>& pieces)
{
  auto piece = pieces.begin();
  for (const subdomain::SubdomainRange& range : ranges) {
    for (LocalIndex s = range.first; s < range.last; ++s, ++piece) {
      if (piece == pieces.end() || piece->subdomain != s) {
        return fmt::format("piece {} is missing", s);
      }
    }
  }
  return piece == pieces.end() ? std::nullopt
                               : std::optional<std::string>("there are extra pieces");
}

// After an exchange of tets between subdomains: the faces of all tets cancel but for the outside,
// which is what it was, and so is the volume.
std::optional<std::string> first_defect_of_improvement(const FilledPieces& filled)
{
  if (filled.improvement.generation == 0) return std::nullopt;
  constexpr double kTolerance = 1e-9;
  Hash128 open;
  double volume = 0.0;
  for (const subdomain::PieceSummary& piece : filled.pieces) {
    open += piece.surface;
    open -= piece.outside;
    volume += piece.volume;
  }
  if (open != Hash128{}) return "pieces do not meet after the improvement of their seams";
  const double before = filled.improvement.volume_before;
  if (std::abs(volume - before) <= kTolerance * before) return std::nullopt;
  return fmt::format("the improvement of seams has changed the volume from {:.12g} to {:.12g}",
                     before, volume);
}

std::optional<std::string> first_defect(const subdomain::PartitionedMesh& cut,
                                        const std::vector<subdomain::SubdomainRange>& ranges,
                                        const FilledPieces& filled)
{
  if (auto missing = first_missing_piece(ranges, filled.pieces)) return missing;
  const std::vector<GlobalIndex> expected =
      verify::euler_characteristics(cut.coarse.tet_vertices, cut.decomposition.tet_subdomain);
  std::vector<char> is_made(at(cut.num_subdomains()), 0);
  for (const subdomain::PieceSummary& piece : filled.pieces) {
    is_made[at(piece.subdomain)] = 1;
    const GlobalIndex wanted = expected[at(piece.subdomain)];
    if (piece.euler_characteristic == wanted) continue;
    return fmt::format("piece {} has Euler characteristic {}, its coarse subdomain {}",
                       piece.subdomain, piece.euler_characteristic, wanted);
  }
  if (auto open = verify::first_open_seam(filled.seam_sums, cut.skeleton, is_made)) return open;
  return first_defect_of_improvement(filled);
}

}  // namespace

void run_verify_stage(const subdomain::PartitionedMesh& cut,
                      const std::vector<subdomain::SubdomainRange>& ranges,
                      const FilledPieces& filled, RunContext& context)
{
  StageScope stage(context, "verify");
  context.comm.throw_if_any<MeshError>(first_defect(cut, ranges, filled));
  stage.work_is_done();
  stage.finish("all seams close");
}

}  // namespace tessera::pipeline

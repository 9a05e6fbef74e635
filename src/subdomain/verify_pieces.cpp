// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/verify_pieces.hpp"

#include <cmath>

#include <fmt/format.h>

#include "tessera/verify/euler.hpp"
#include "tessera/verify/seams.hpp"

namespace tessera::subdomain {
namespace {

using Defect = std::optional<std::string>;

std::string name_of(LocalIndex subdomain) { return fmt::format("piece {}", subdomain); }

Defect first_missing_or_extra(const std::vector<SubdomainRange>& ranges,
                              const std::vector<PieceSummary>& pieces)
{
  auto piece = pieces.begin();
  const auto extra = [&] { return name_of(piece->subdomain) + " is one too many"; };
  for (const SubdomainRange& range : ranges) {
    for (LocalIndex s = range.first; s < range.last; ++s, ++piece) {
      if (piece != pieces.end() && piece->subdomain < s) return extra();
      if (piece == pieces.end() || piece->subdomain != s) return name_of(s) + " is missing";
    }
  }
  return piece == pieces.end() ? Defect() : extra();
}

Defect first_broken(const PartitionedMesh& cut, const std::vector<PieceSummary>& pieces)
{
  const std::vector<GlobalIndex> expected =
      verify::euler_characteristics(cut.coarse.tet_vertices, cut.decomposition.tet_subdomain);
  for (const PieceSummary& piece : pieces) {
    const GlobalIndex wanted = expected[at(piece.subdomain)];
    if (piece.euler_characteristic != wanted) {
      return fmt::format("{} has Euler characteristic {}, its coarse subdomain {}",
                         name_of(piece.subdomain), piece.euler_characteristic, wanted);
    }
    if (!(piece.tets.min_mean_ratio > 0.0)) {
      return fmt::format("{} has a flat or inverted tet, of mean ratio {:.6f}",
                         name_of(piece.subdomain), piece.tets.min_mean_ratio);
    }
  }
  return std::nullopt;
}

Defect first_open_seam(const PartitionedMesh& cut, const PieceFacts& facts)
{
  std::vector<char> is_made(at(cut.num_subdomains()), 0);
  for (const PieceSummary& piece : facts.pieces) is_made[at(piece.subdomain)] = 1;
  return verify::first_open_seam(facts.seam_sums, cut.skeleton, is_made);
}

Defect first_open_face(const std::vector<PieceSummary>& pieces)
{
  Hash128 open;
  for (const PieceSummary& piece : pieces) {
    open += piece.surface;
    open -= piece.outside;
  }
  if (open == Hash128{}) return std::nullopt;
  return "pieces do not meet: the faces of their tets do not cancel";
}

Defect first_of_exchange(const std::vector<PieceSummary>& pieces, double volume_before)
{
  constexpr double kTolerance = 1e-9;
  double volume = 0.0;
  for (const PieceSummary& piece : pieces) volume += piece.volume;
  if (std::abs(volume - volume_before) <= kTolerance * volume_before) return std::nullopt;
  return fmt::format("the improvement of seams has changed the volume from {:.12g} to {:.12g}",
                     volume_before, volume);
}

}  // namespace

std::optional<std::string> verify_pieces(const PartitionedMesh& cut,
                                         const std::vector<SubdomainRange>& ranges,
                                         const PieceFacts& facts)
{
  if (auto defect = first_missing_or_extra(ranges, facts.pieces)) return defect;
  if (auto defect = first_broken(cut, facts.pieces)) return defect;
  if (auto defect = first_open_seam(cut, facts)) return defect;
  if (facts.have_surfaces) {
    if (auto defect = first_open_face(facts.pieces)) return defect;
  }
  return facts.volume_before ? first_of_exchange(facts.pieces, *facts.volume_before) : std::nullopt;
}

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/region_records.hpp"

#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/store/improved_pieces.hpp"

namespace tessera::pipeline {

std::string region_name(LocalIndex region) { return fmt::format("region_{:06}", region); }

std::vector<mesh::Piece> pieces_around(const ImproveContext& context, LocalIndex region)
{
  std::vector<mesh::Piece> pieces;
  for (const LocalIndex s : context.regions.subdomains_of(region)) {
    pieces.push_back(stored_piece(context.store, s, context.generation));
  }
  return pieces;
}

mesh::Piece merge_regions(const ImproveContext& context, LocalIndex subdomain, int phase)
{
  mesh::Piece piece = stored_piece(context.store, subdomain, context.generation);
  std::vector<improve::RegionUpdate> updates;
  for (const LocalIndex region : context.regions.regions_of(subdomain, phase)) {
    const std::string name = region_name(region);
    if (!context.store.contains(name)) continue;  // A region that is not to be improved.
    auto record = from_bytes<subdomain::RegionRecord>(context.store.get(name));
    if (record.is_improved) updates.push_back(std::move(record.update));
  }
  if (updates.empty()) return piece;
  const auto labels = improve::label_tets(piece, context.regions, phase, improve::kDefaultLayers);
  return improve::apply_updates(piece, labels, updates);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/improved_pieces.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/improve/phase_bands.hpp"

#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

LocalIndex row_in(std::span<const LocalIndex> ascending, LocalIndex value)
{
  return static_cast<LocalIndex>(std::ranges::lower_bound(ascending, value) - ascending.begin());
}

}  // namespace

ImprovedPieces::ImprovedPieces(const std::filesystem::path& output, const mesh::Skeleton& skeleton,
                               std::shared_ptr<const improve::SeamRegions> regions,
                               const comm::Communicator& comm)
    : filled_(store_folder(output)),
      regions_(std::move(regions)),
      neighbours_(mesh::neighbours_by_vertex(skeleton)),
      records_(store_folder(output), comm)
{
}

mesh::Piece ImprovedPieces::piece(LocalIndex subdomain) const
{
  return whole_part(subdomain, improve::kNumPhases - 1).piece;
}

ImprovedPieces::Outer ImprovedPieces::outer(LocalIndex subdomain) const
{
  const int last_phase = improve::kNumPhases - 1;
  const auto first_phase = phase_of_core(subdomain, last_phase);
  if (!first_phase) return {.part = whole_part(subdomain, last_phase), .core = {}};
  return {.part = outer_part(subdomain, *first_phase, last_phase),
          .core = from_bytes<subdomain::CoreFigures>(
              band_segment(subdomain, *first_phase, BandSegment::core))};
}

improve::PiecePart ImprovedPieces::whole_part(LocalIndex subdomain, int last_phase) const
{
  improve::PiecePart part = improve::whole_piece(from_bytes<mesh::Piece>(
      filled_.segment(record_name(subdomain), static_cast<LocalIndex>(PieceSegment::piece))));
  const auto all = exchanges(subdomain, 0, last_phase);
  return all.empty() ? part : improve::apply_updates(part, all);
}

improve::PiecePart ImprovedPieces::outer_part(LocalIndex subdomain, int first_phase,
                                              int last_phase) const
{
  improve::PhaseBands kept{.tet_tags = tet_tags(subdomain, first_phase),
                           .rim = find_rim(subdomain, first_phase)};
  for (LocalIndex row = 0; row < kept.tet_tags.num_lists(); ++row) {
    kept.bands.push_back(from_bytes<improve::Band>(band(subdomain, first_phase, row)));
  }
  return improve::apply_updates(improve::outer_part(kept),
                                exchanges(subdomain, first_phase, last_phase));
}

std::optional<int> ImprovedPieces::phase_of_core(LocalIndex subdomain, int last_phase) const
{
  for (int phase = 0; phase <= last_phase; ++phase) {
    if (!has_bands_of_phase(subdomain, phase)) continue;
    if (!band_segment(subdomain, phase, BandSegment::core).empty()) return phase;
  }
  return std::nullopt;
}

std::vector<improve::RegionExchange> ImprovedPieces::exchanges(LocalIndex subdomain,
                                                               int first_phase,
                                                               int last_phase) const
{
  std::vector<improve::RegionExchange> exchanges;
  for (int phase = first_phase; phase <= last_phase; ++phase) {
    const auto regions = regions_->regions_of(subdomain, phase);
    IndexLists tags;
    for (std::size_t i = 0; i < regions.size(); ++i) {
      if (records_.num_segments(SeamRecord::region, regions[i]) < 2) continue;  // Not improved.
      if (tags.num_lists() == 0) tags = tet_tags(subdomain, phase);
      const LocalIndex owner = row_in(regions_->subdomains_of(regions[i]), subdomain);
      const auto old_tets = tags[static_cast<LocalIndex>(i)];
      exchanges.push_back({{old_tets.begin(), old_tets.end()},
                           from_bytes<improve::PieceUpdate>(
                               records_.get(SeamRecord::region, regions[i], 1 + owner))});
    }
  }
  return exchanges;
}

bool ImprovedPieces::has_bands_of_phase(LocalIndex subdomain, int phase) const
{
  if (phase > 0) return has_bands(subdomain, phase);
  return filled_.num_segments(record_name(subdomain))
         > static_cast<LocalIndex>(PieceSegment::bands);
}

Bytes ImprovedPieces::band_segment(LocalIndex subdomain, int phase, LocalIndex number) const
{
  if (phase > 0) return records_.get(bands_of_phase(phase), subdomain, number);
  return filled_.segment(record_name(subdomain),
                         static_cast<LocalIndex>(PieceSegment::bands) + number);
}

IndexLists ImprovedPieces::tet_tags(LocalIndex subdomain, int phase) const
{
  return from_bytes<IndexLists>(band_segment(subdomain, phase, BandSegment::tet_tags));
}

std::optional<improve::PiecePart> ImprovedPieces::find_rim(LocalIndex subdomain, int phase) const
{
  const Bytes rim = band_segment(subdomain, phase, BandSegment::rim);
  if (rim.empty()) return std::nullopt;
  return from_bytes<improve::PiecePart>(rim);
}

improve::PiecePart ImprovedPieces::part_after(LocalIndex subdomain, int phase) const
{
  if (const auto rim = find_rim(subdomain, phase)) {
    return improve::apply_updates(*rim, exchanges(subdomain, phase, phase));
  }
  const auto first_phase = phase_of_core(subdomain, phase);
  return first_phase ? outer_part(subdomain, *first_phase, phase) : whole_part(subdomain, phase);
}

void ImprovedPieces::keep_bands(LocalIndex subdomain, int phase_before, int phase,
                                GlobalIndex most_of_rim)
{
  records_.put(bands_of_phase(phase), subdomain,
               band_segments(part_after(subdomain, phase_before), *regions_, phase, most_of_rim));
}

std::vector<Bytes> ImprovedPieces::bands_of(LocalIndex region) const
{
  const int phase = regions_->phase_of(region);
  std::vector<Bytes> bands;
  for (const LocalIndex s : regions_->subdomains_of(region)) {
    bands.push_back(band(s, phase, row_in(regions_->regions_of(s, phase), region)));
  }
  return bands;
}

void ImprovedPieces::keep_region(LocalIndex region, const subdomain::RegionRecord& record)
{
  subdomain::RegionRecord head = record;
  head.updates.clear();
  std::vector<Bytes> segments{to_bytes(head)};
  for (const improve::PieceUpdate& update : record.updates) segments.push_back(to_bytes(update));
  records_.put(SeamRecord::region, region, segments);
}

subdomain::RegionRecord ImprovedPieces::find_region(LocalIndex region) const
{
  return from_bytes<subdomain::RegionRecord>(records_.get(SeamRecord::region, region, 0));
}

void ImprovedPieces::keep_list(const Outer& outer)
{
  const mesh::Piece& piece = outer.part.piece;
  const number::VertexList all{piece.subdomain, piece.material,
                               subdomain::shared_vertices(outer.core, piece)};
  std::vector<Bytes> segments{to_bytes(all)};
  for (const number::VertexList& list : lists_for_neighbours(all)) {
    segments.push_back(to_bytes(list));
  }
  records_.put(SeamRecord::list, piece.subdomain, segments);
}

std::vector<number::VertexList> ImprovedPieces::lists_for_neighbours(
    const number::VertexList& all) const
{
  const auto& neighbours = neighbours_[at(all.subdomain)];
  std::vector<number::VertexList> lists(neighbours.size(),
                                        {.subdomain = all.subdomain, .material = all.material});
  for (const mesh::HostPoint& name : all.vertices) {
    for (const LocalIndex holder : regions_->holders_of(name.host)) {
      if (holder == all.subdomain) continue;
      lists[at(row_in(neighbours, holder))].vertices.push_back(name);
    }
  }
  return lists;
}

std::vector<char> ImprovedPieces::Comparison::seams_of(const mesh::Piece& part) const
{
  std::vector<char> on_seam;
  for (LocalIndex v = 0; v < part.num_skin_vertices(); ++v) {
    const auto found = std::ranges::lower_bound(vertices, part.skin_point(v));
    on_seam.push_back(shared.on_seam[static_cast<std::size_t>(found - vertices.begin())]);
  }
  return on_seam;
}

number::VertexList ImprovedPieces::list_for(LocalIndex subdomain, LocalIndex other) const
{
  const LocalIndex segment = subdomain == other ? 0 : 1 + row_in(neighbours_[at(other)], subdomain);
  return from_bytes<number::VertexList>(records_.get(SeamRecord::list, other, segment));
}

ImprovedPieces::Comparison ImprovedPieces::own_vertices(LocalIndex subdomain)
{
  std::vector<number::VertexList> lists;
  for (const LocalIndex other : neighbours_[at(subdomain)])
    lists.push_back(list_for(subdomain, other));
  number::VertexList own = list_for(subdomain, subdomain);
  Comparison found{.shared = number::compare_lists(own, lists),
                   .vertices = std::move(own.vertices)};
  const auto is_expected = [&](const mesh::HostPoint& name, char on_seam) {
    return regions_->may_be_on_seam(name.host) == (on_seam != 0);
  };
  found.is_as_expected = std::ranges::equal(found.vertices, found.shared.on_seam, is_expected);
  records_.put(SeamRecord::owned, subdomain, {{to_bytes(found.shared.owned)}});
  return found;
}

std::vector<mesh::HostPoint> ImprovedPieces::owned_by(LocalIndex subdomain) const
{
  return from_bytes<std::vector<mesh::HostPoint>>(records_.get(SeamRecord::owned, subdomain, 0));
}

std::vector<subdomain::VertexPlace> ImprovedPieces::places_of(const mesh::Piece& piece) const
{
  std::vector<subdomain::VertexPlace> places(at(piece.num_vertices()));
  const auto find_places = [&](LocalIndex owner, const std::vector<mesh::HostPoint>& owned) {
    for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
      const mesh::HostPoint name = piece.skin_point(v);
      const auto found = std::ranges::lower_bound(owned, name);
      if (found == owned.end() || *found != name) continue;
      places[at(v)] = {owner, static_cast<LocalIndex>(found - owned.begin())};
    }
  };
  const std::vector<mesh::HostPoint> owned = owned_by(piece.subdomain);
  find_places(piece.subdomain, owned);
  for (const LocalIndex other : neighbours_[at(piece.subdomain)]) {
    if (other < piece.subdomain) find_places(other, owned_by(other));
  }
  auto next = static_cast<LocalIndex>(owned.size());
  for (LocalIndex v = 0; v < piece.num_vertices(); ++v) {
    subdomain::VertexPlace& place = places[at(v)];
    if (v >= piece.num_skin_vertices()) place = {piece.subdomain, next++};
    if (place.owner != kNoIndex) continue;
    throw MeshError(fmt::format("nobody owns vertex {} of piece {}", v, piece.subdomain));
  }
  return places;
}

std::vector<subdomain::VertexPlace> ImprovedPieces::places_of_names(
    std::span<const mesh::HostPoint> names) const
{
  std::map<LocalIndex, std::vector<mesh::HostPoint>> owned;  // By subdomain, of those asked.
  const auto find_place = [&](const mesh::HostPoint& name) -> subdomain::VertexPlace {
    for (const LocalIndex holder : regions_->holders_of(name.host)) {
      auto list = owned.find(holder);
      if (list == owned.end()) list = owned.emplace(holder, owned_by(holder)).first;
      const auto found = std::ranges::lower_bound(list->second, name);
      if (found == list->second.end() || *found != name) continue;
      return {holder, static_cast<LocalIndex>(found - list->second.begin())};
    }
    throw MeshError(fmt::format("nobody owns vertex {} of host {}", name.index, name.host));
  };
  std::vector<subdomain::VertexPlace> places;
  places.reserve(names.size());
  for (const mesh::HostPoint& name : names) places.push_back(find_place(name));
  return places;
}

}  // namespace tessera::pipeline

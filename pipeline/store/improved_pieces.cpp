// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/improved_pieces.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

// Segments of a bands record behind the bands themselves.
LocalIndex tags_segment(const improve::SeamRegions& regions, LocalIndex subdomain, int phase)
{
  return static_cast<LocalIndex>(regions.regions_of(subdomain, phase).size());
}

LocalIndex row_in(std::span<const LocalIndex> ascending, LocalIndex value)
{
  return static_cast<LocalIndex>(std::ranges::lower_bound(ascending, value) - ascending.begin());
}

}  // namespace

mesh::Piece filled_piece(const io::RecordStore& store, LocalIndex subdomain)
{
  return from_bytes<mesh::Piece>(from_bytes<FillRecord>(store.get(record_name(subdomain))).piece);
}

ImprovedPieces::ImprovedPieces(const std::filesystem::path& output, const mesh::Skeleton& skeleton,
                               std::shared_ptr<const improve::SeamRegions> regions,
                               const comm::Communicator& comm)
    : store_(store_folder(output)),
      regions_(std::move(regions)),
      neighbours_(mesh::neighbours_by_vertex(skeleton)),
      records_(store_folder(output), comm)
{
}

mesh::Piece ImprovedPieces::piece(LocalIndex subdomain) const
{
  return whole_part(subdomain, improve::kNumPhases - 1).piece;
}

improve::PiecePart ImprovedPieces::whole_part(LocalIndex subdomain, int last_phase) const
{
  std::vector<improve::RegionExchange> all;
  for (int phase = 0; phase <= last_phase; ++phase) {
    std::ranges::move(exchanges(subdomain, phase), std::back_inserter(all));
  }
  improve::PiecePart part = improve::whole_piece(filled_piece(store_, subdomain));
  return all.empty() ? part : improve::apply_updates(part, all);
}

std::vector<improve::RegionExchange> ImprovedPieces::exchanges(LocalIndex subdomain,
                                                               int phase) const
{
  std::vector<improve::RegionExchange> exchanges;
  const auto regions = regions_->regions_of(subdomain, phase);
  IndexLists tags;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (records_.num_segments(SeamRecord::region, regions[i]) < 2) continue;  // Not improved.
    if (tags.num_lists() == 0) {
      tags = from_bytes<IndexLists>(records_.get(bands_of_phase(phase), subdomain,
                                                 tags_segment(*regions_, subdomain, phase)));
    }
    const LocalIndex owner = row_in(regions_->subdomains_of(regions[i]), subdomain);
    const auto old_tets = tags[static_cast<LocalIndex>(i)];
    exchanges.push_back({{old_tets.begin(), old_tets.end()},
                         from_bytes<improve::PieceUpdate>(
                             records_.get(SeamRecord::region, regions[i], 1 + owner))});
  }
  return exchanges;
}

improve::PiecePart ImprovedPieces::part_after(LocalIndex subdomain, int phase) const
{
  if (phase == kNoPhase) return whole_part(subdomain, phase);
  const SeamRecord bands = bands_of_phase(phase);
  const LocalIndex rim_segment = 1 + tags_segment(*regions_, subdomain, phase);
  if (rim_segment >= records_.num_segments(bands, subdomain)) return whole_part(subdomain, phase);
  const auto rim = from_bytes<improve::PiecePart>(records_.get(bands, subdomain, rim_segment));
  return improve::apply_updates(rim, exchanges(subdomain, phase));
}

void ImprovedPieces::keep_bands(LocalIndex subdomain, int phase_before, int phase,
                                GlobalIndex most_of_rim)
{
  const improve::PiecePart part = part_after(subdomain, phase_before);
  const auto labels = improve::label_tets(part.piece, *regions_, phase, improve::kDefaultLayers);
  std::vector<Bytes> segments;
  for (const improve::Band& band : improve::make_bands(part, labels, *regions_, phase)) {
    segments.push_back(to_bytes(band));
  }
  segments.push_back(to_bytes(improve::tets_of_bands(part, labels, *regions_, phase)));
  if (most_of_rim > 0) {
    const improve::PiecePart rim = improve::rim_of(part, *regions_, phase);
    if (rim.piece.num_tets() <= most_of_rim) segments.push_back(to_bytes(rim));
  }
  records_.put(bands_of_phase(phase), subdomain, segments);
}

std::vector<Bytes> ImprovedPieces::bands_of(LocalIndex region) const
{
  const int phase = regions_->phase_of(region);
  std::vector<Bytes> bands;
  for (const LocalIndex s : regions_->subdomains_of(region)) {
    bands.push_back(
        records_.get(bands_of_phase(phase), s, row_in(regions_->regions_of(s, phase), region)));
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

void ImprovedPieces::keep_list(const mesh::Piece& piece)
{
  const number::VertexList list{piece.subdomain, piece.material, number::shared_vertices(piece)};
  records_.put(SeamRecord::list, piece.subdomain, {{to_bytes(list)}});
}

std::vector<char> ImprovedPieces::may_be_on_seam(const std::vector<mesh::HostPoint>& names) const
{
  std::vector<char> may_be;
  may_be.reserve(names.size());
  for (const mesh::HostPoint& name : names) {
    may_be.push_back(regions_->may_be_on_seam(name.host) ? 1 : 0);
  }
  return may_be;
}

number::SharedBy ImprovedPieces::expected_seams(const mesh::Piece& piece) const
{
  return {.on_seam = may_be_on_seam(number::shared_vertices(piece))};
}

number::VertexList ImprovedPieces::list_of(LocalIndex subdomain) const
{
  return from_bytes<number::VertexList>(records_.get(SeamRecord::list, subdomain, 0));
}

ImprovedPieces::Comparison ImprovedPieces::own_vertices(LocalIndex subdomain)
{
  std::vector<number::VertexList> lists;
  for (const LocalIndex other : neighbours_[at(subdomain)]) lists.push_back(list_of(other));
  const number::VertexList own = list_of(subdomain);
  Comparison found{.shared = number::compare_lists(own, lists)};
  found.is_as_expected = found.shared.on_seam == may_be_on_seam(own.vertices);
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

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/improved_pieces.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/improve/phase_bands.hpp"

#include "pipeline/store/band_segments.hpp"

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
  Outer outer{.part = outer_part(subdomain, improve::kNumPhases - 1)};
  if (has_core(subdomain)) {
    outer.core = from_bytes<subdomain::CoreFigures>(filled_segment(subdomain, PieceSegment::core));
  }
  return outer;
}

Bytes ImprovedPieces::filled_segment(LocalIndex subdomain, PieceSegment segment) const
{
  return filled_.segment(record_name(subdomain), static_cast<LocalIndex>(segment));
}

bool ImprovedPieces::has_core(LocalIndex subdomain) const
{
  const auto core = static_cast<LocalIndex>(PieceSegment::core);
  return filled_.num_segments(record_name(subdomain)) > core
         && !filled_segment(subdomain, PieceSegment::core).empty();
}

improve::PiecePart ImprovedPieces::whole_part(LocalIndex subdomain, int last_phase) const
{
  improve::PiecePart part =
      improve::whole_piece(from_bytes<mesh::Piece>(filled_segment(subdomain, PieceSegment::piece)));
  const auto all = exchanges_until(subdomain, last_phase);
  return all.empty() ? part : improve::apply_updates(part, all);
}

improve::PiecePart ImprovedPieces::outer_part(LocalIndex subdomain, int last_phase) const
{
  if (!has_core(subdomain)) return whole_part(subdomain, last_phase);
  improve::PhaseBands kept{.tet_tags = tet_tags(subdomain, 0), .rim = find_rim(subdomain, 0)};
  for (LocalIndex i = 0; i < num_bands(subdomain, 0); ++i) {
    kept.bands.push_back(from_bytes<improve::Band>(band_segment(subdomain, 0, i)));
  }
  return improve::apply_updates(improve::outer_part(kept), exchanges_until(subdomain, last_phase));
}

std::vector<improve::RegionExchange> ImprovedPieces::exchanges_until(LocalIndex subdomain,
                                                                     int last_phase) const
{
  std::vector<improve::RegionExchange> all;
  for (int phase = 0; phase <= last_phase; ++phase) {
    std::ranges::move(exchanges(subdomain, phase), std::back_inserter(all));
  }
  return all;
}

std::vector<improve::RegionExchange> ImprovedPieces::exchanges(LocalIndex subdomain,
                                                               int phase) const
{
  std::vector<improve::RegionExchange> exchanges;
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
  return exchanges;
}

Bytes ImprovedPieces::band_segment(LocalIndex subdomain, int phase, LocalIndex number) const
{
  if (phase > 0) return records_.get(bands_of_phase(phase), subdomain, number);
  return filled_.segment(record_name(subdomain),
                         static_cast<LocalIndex>(PieceSegment::bands) + number);
}

IndexLists ImprovedPieces::tet_tags(LocalIndex subdomain, int phase) const
{
  return from_bytes<IndexLists>(band_segment(subdomain, phase, num_bands(subdomain, phase)));
}

std::optional<improve::PiecePart> ImprovedPieces::find_rim(LocalIndex subdomain, int phase) const
{
  const Bytes rim = band_segment(subdomain, phase, num_bands(subdomain, phase) + 1);
  if (rim.empty()) return std::nullopt;
  return from_bytes<improve::PiecePart>(rim);
}

improve::PiecePart ImprovedPieces::part_after(LocalIndex subdomain, int phase) const
{
  const auto rim = find_rim(subdomain, phase);
  if (!rim) return outer_part(subdomain, phase);
  return improve::apply_updates(*rim, exchanges(subdomain, phase));
}

void ImprovedPieces::keep_bands(LocalIndex subdomain, int phase_before, int phase,
                                GlobalIndex most_of_rim)
{
  const improve::PiecePart part = part_after(subdomain, phase_before);
  records_.put(bands_of_phase(phase), subdomain,
               band_segments(improve::make_phase_bands(part, *regions_, phase, most_of_rim)));
}

std::vector<Bytes> ImprovedPieces::bands_of(LocalIndex region) const
{
  const int phase = regions_->phase_of(region);
  std::vector<Bytes> bands;
  for (const LocalIndex s : regions_->subdomains_of(region)) {
    bands.push_back(band_segment(s, phase, row_in(regions_->regions_of(s, phase), region)));
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
  number::VertexList list{.subdomain = piece.subdomain, .material = piece.material};
  std::ranges::merge(number::shared_vertices(piece), outer.core.shared_vertices,
                     std::back_inserter(list.vertices));
  records_.put(SeamRecord::list, piece.subdomain, {{to_bytes(list)}});
}

std::vector<char> ImprovedPieces::expected_seams(const mesh::Piece& piece) const
{
  std::vector<char> expected;
  expected.reserve(piece.skin_host.size());
  for (const mesh::HostEntity host : piece.skin_host) {
    expected.push_back(regions_->may_be_on_seam(host) ? 1 : 0);
  }
  return expected;
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

number::VertexList ImprovedPieces::list_of(LocalIndex subdomain) const
{
  return from_bytes<number::VertexList>(records_.get(SeamRecord::list, subdomain, 0));
}

ImprovedPieces::Comparison ImprovedPieces::own_vertices(LocalIndex subdomain)
{
  std::vector<number::VertexList> lists;
  for (const LocalIndex other : neighbours_[at(subdomain)]) lists.push_back(list_of(other));
  number::VertexList own = list_of(subdomain);
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

}  // namespace tessera::pipeline

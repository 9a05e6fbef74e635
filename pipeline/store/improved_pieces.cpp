// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/improved_pieces.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

std::string list_name(LocalIndex subdomain) { return fmt::format("shared_{:06}", subdomain); }
std::string owned_name(LocalIndex subdomain) { return fmt::format("owned_{:06}", subdomain); }

}  // namespace

std::string improved_name(LocalIndex subdomain, int generation)
{
  return fmt::format("improved_{}_{:06}", generation, subdomain);
}

mesh::Piece stored_piece(const io::RecordStore& store, LocalIndex subdomain, int generation)
{
  if (generation > 0)
    return from_bytes<mesh::Piece>(store.get(improved_name(subdomain, generation)));
  return from_bytes<mesh::Piece>(from_bytes<FillRecord>(store.get(record_name(subdomain))).piece);
}

mesh::Piece refined_piece(const io::RecordStore& store, LocalIndex subdomain)
{
  return from_bytes<mesh::Piece>(from_bytes<FillRecord>(store.get(refined_name(subdomain))).piece);
}

ImprovedPieces::ImprovedPieces(const std::filesystem::path& output, const mesh::Skeleton& skeleton,
                               int generation)
    : store_(store_folder(output)),
      neighbours_(mesh::neighbours_by_vertex(skeleton)),
      generation_(generation)
{
}

void ImprovedPieces::keep_list(const mesh::Piece& piece) const
{
  const number::VertexList list{piece.subdomain, piece.material, number::shared_vertices(piece)};
  store_.put(list_name(piece.subdomain), to_bytes(list));
}

number::VertexList ImprovedPieces::list_of(LocalIndex subdomain) const
{
  return from_bytes<number::VertexList>(store_.get(list_name(subdomain)));
}

number::SharedBy ImprovedPieces::own_vertices(LocalIndex subdomain) const
{
  std::vector<number::VertexList> lists;
  for (const LocalIndex other : neighbours_[at(subdomain)]) lists.push_back(list_of(other));
  number::SharedBy shared = number::compare_lists(list_of(subdomain), lists);
  store_.put(owned_name(subdomain), to_bytes(shared.owned));
  return shared;
}

std::vector<mesh::HostPoint> ImprovedPieces::owned_by(LocalIndex subdomain) const
{
  return from_bytes<std::vector<mesh::HostPoint>>(store_.get(owned_name(subdomain)));
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

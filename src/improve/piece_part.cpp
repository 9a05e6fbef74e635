// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/piece_part.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tessera::improve {
namespace {

std::vector<LocalIndex> first_tags(LocalIndex count)
{
  std::vector<LocalIndex> tags(at(count));
  std::iota(tags.begin(), tags.end(), 0);
  return tags;
}

std::vector<char> vertices_of_later_phases(const mesh::Piece& piece, const SeamRegions& regions,
                                           int phase)
{
  std::vector<char> is_reached(at(piece.num_vertices()), 0);
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    const LocalIndex region = regions.region_of(piece.skin_host[at(v)], piece.material);
    if (region >= regions.first_of_phase(phase + 1)) is_reached[at(v)] = 1;
  }
  return is_reached;
}

// The tets within some layers of the vertices, which become those of these tets.
std::vector<char> tets_around(const mesh::Piece& piece, std::vector<char>& is_reached, int layers)
{
  std::vector<char> is_taken(at(piece.num_tets()), 0);
  std::vector<LocalIndex> new_tets;
  for (int layer = 0; layer < layers; ++layer) {
    new_tets.clear();
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      if (is_taken[at(t)] != 0) continue;
      const LocalIndex* v = &piece.tet_vertices[4 * at(t)];
      if (std::any_of(v, v + 4, [&](LocalIndex corner) { return is_reached[at(corner)] != 0; })) {
        new_tets.push_back(t);
      }
    }
    for (const LocalIndex t : new_tets) {
      is_taken[at(t)] = 1;
      for (std::size_t c = 0; c < 4; ++c) is_reached[at(piece.tet_vertices[4 * at(t) + c])] = 1;
    }
  }
  return is_taken;
}

}  // namespace

PiecePart whole_piece(mesh::Piece piece)
{
  PiecePart part;
  part.vertex_tag = first_tags(piece.num_vertices());
  part.tet_tag = first_tags(piece.num_tets());
  part.num_vertex_tags = piece.num_vertices();
  part.num_tet_tags = piece.num_tets();
  part.is_complete = true;
  part.is_whole = true;
  part.piece = std::move(piece);
  return part;
}

PiecePart rim_of(const PiecePart& part, const SeamRegions& regions, int phase, int layers)
{
  const mesh::Piece& from = part.piece;
  std::vector<char> is_used = vertices_of_later_phases(from, regions, phase);
  const std::vector<char> is_taken = tets_around(from, is_used, layers);
  PiecePart rim;
  rim.piece.subdomain = from.subdomain;
  rim.piece.material = from.material;
  rim.num_vertex_tags = part.num_vertex_tags;
  rim.num_tet_tags = part.num_tet_tags;
  std::vector<LocalIndex> number(at(from.num_vertices()), kNoIndex);
  for (LocalIndex v = 0; v < from.num_vertices(); ++v) {
    if (is_used[at(v)] == 0) continue;
    number[at(v)] = rim.piece.num_vertices();
    const double* xyz = &from.vertex_xyz[3 * at(v)];
    rim.piece.vertex_xyz.insert(rim.piece.vertex_xyz.end(), xyz, xyz + 3);
    rim.vertex_tag.push_back(part.vertex_tag[at(v)]);
    if (v >= from.num_skin_vertices()) continue;
    rim.piece.skin_host.push_back(from.skin_host[at(v)]);
    rim.piece.skin_index.push_back(from.skin_index[at(v)]);
  }
  for (LocalIndex t = 0; t < from.num_tets(); ++t) {
    if (is_taken[at(t)] == 0) continue;
    rim.tet_tag.push_back(part.tet_tag[at(t)]);
    for (std::size_t c = 0; c < 4; ++c) {
      rim.piece.tet_vertices.push_back(number[at(from.tet_vertices[4 * at(t) + c])]);
    }
  }
  return rim;
}

}  // namespace tessera::improve

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/phase_bands.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace tessera::improve {
namespace {

// Puts bands and a rim together by the tags of their vertices and tets.
class PartJoiner {
 public:
  explicit PartJoiner(const PiecePart& rim) : vertices_(at(rim.num_vertex_tags))
  {
    joined_.piece.subdomain = rim.piece.subdomain;
    joined_.piece.material = rim.piece.material;
    joined_.num_vertex_tags = rim.num_vertex_tags;
    joined_.num_tet_tags = rim.num_tet_tags;
    joined_.is_complete = true;
    add(rim.piece, rim.vertex_tag, rim.tet_tag);
  }

  // @param[in] some A Band or a mesh::Piece.
  void add(const auto& some, std::span<const LocalIndex> vertex_tag,
           std::span<const LocalIndex> tet_tag)
  {
    for (LocalIndex v = 0; v < some.num_vertices(); ++v) {
      KnownVertex& vertex = vertices_[at(vertex_tag[at(v)])];
      vertex.xyz = &some.vertex_xyz[3 * at(v)];
      if (v < some.num_skin_vertices()) vertex.name = some.skin_point(v);
    }
    for (std::size_t t = 0; t < tet_tag.size(); ++t) {
      TaggedTet tet{.tag = tet_tag[t]};
      for (std::size_t c = 0; c < 4; ++c) {
        tet.vertex_tags[c] = vertex_tag[at(some.tet_vertices[4 * t + c])];
      }
      tets_.push_back(tet);
    }
  }

  PiecePart finish() &&
  {
    std::ranges::sort(tets_, {}, &TaggedTet::tag);
    const auto is_again = [](const TaggedTet& a, const TaggedTet& b) { return a.tag == b.tag; };
    tets_.erase(std::unique(tets_.begin(), tets_.end(), is_again), tets_.end());
    for (const bool is_on_skin : {true, false}) number_vertices(is_on_skin);
    for (const TaggedTet& tet : tets_) {
      joined_.tet_tag.push_back(tet.tag);
      for (const LocalIndex v : tet.vertex_tags) {
        joined_.piece.tet_vertices.push_back(vertices_[at(v)].number);
      }
    }
    return std::move(joined_);
  }

 private:
  struct KnownVertex {
    const double* xyz = nullptr;  // Unknown.
    std::optional<mesh::HostPoint> name{};
    LocalIndex number = kNoIndex;  // In the joined part.
  };

  struct TaggedTet {
    LocalIndex tag = kNoIndex;
    std::array<LocalIndex, 4> vertex_tags{};
  };

  void number_vertices(bool is_on_skin)
  {
    mesh::Piece& piece = joined_.piece;
    for (std::size_t tag = 0; tag < vertices_.size(); ++tag) {
      KnownVertex& vertex = vertices_[tag];
      if (vertex.xyz == nullptr || vertex.name.has_value() != is_on_skin) continue;
      vertex.number = piece.num_vertices();
      piece.vertex_xyz.insert(piece.vertex_xyz.end(), vertex.xyz, vertex.xyz + 3);
      joined_.vertex_tag.push_back(static_cast<LocalIndex>(tag));
      if (!is_on_skin) continue;
      piece.skin_host.push_back(vertex.name->host);
      piece.skin_index.push_back(vertex.name->index);
    }
  }

  PiecePart joined_{};
  std::vector<KnownVertex> vertices_;  // By tag.
  std::vector<TaggedTet> tets_{};
};

}  // namespace

PhaseBands make_phase_bands(const PiecePart& part, const SeamRegions& regions, int phase,
                            GlobalIndex most_of_rim)
{
  const auto labels = label_tets(part.piece, regions, phase, kDefaultLayers);
  PhaseBands made{.bands = make_bands(part, labels, regions, phase),
                  .tet_tags = tets_of_bands(part, labels, regions, phase)};
  PiecePart rim = rim_of(part, regions, phase);
  if (rim.piece.num_tets() <= most_of_rim) made.rim = std::move(rim);
  return made;
}

PiecePart outer_part(const PhaseBands& kept)
{
  PartJoiner joiner(*kept.rim);
  for (std::size_t i = 0; i < kept.bands.size(); ++i) {
    const Band& band = kept.bands[i];
    joiner.add(band, band.vertex_tag, kept.tet_tags[static_cast<LocalIndex>(i)]);
  }
  return std::move(joiner).finish();
}

}  // namespace tessera::improve

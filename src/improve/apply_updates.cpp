// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/improve/region_update.hpp"
#include "tessera/mesh/surface_match.hpp"

namespace tessera::improve {
namespace {

// Builds the new part in *rows* that have room for everything: the old vertices, then the updates'
// new ones; unused vertices are dropped at the end.
class Updater {
 public:
  explicit Updater(const PiecePart& part)
      : part_(part),
        piece_(part.piece),
        num_tet_tags_(part.num_tet_tags),
        vertex_xyz_(part.piece.vertex_xyz),
        vertex_tag_(part.vertex_tag),
        tet_vertices_(part.piece.tet_vertices),
        tet_tag_(part.tet_tag)
  {
  }

  void add(const RegionExchange& exchange)
  {
    const PieceUpdate& update = exchange.update;
    old_tets_.insert(old_tets_.end(), exchange.old_tets.begin(), exchange.old_tets.end());
    const auto first_row = static_cast<LocalIndex>(vertex_tag_.size());
    for (LocalIndex i = 0; i < update.num_new_vertices(); ++i) {
      const bool is_shared = i < update.num_shared();
      new_hosts_.push_back(is_shared ? update.host : kNoIndex);
      new_indices_.push_back(is_shared ? update.shared_index[at(i)] : kNoIndex);
      vertex_tag_.push_back(part_.num_vertex_tags + static_cast<LocalIndex>(new_hosts_.size()) - 1);
    }
    vertex_xyz_.insert(vertex_xyz_.end(), update.vertex_xyz.begin(), update.vertex_xyz.end());
    for (LocalIndex t = 0; t < update.num_tets(); ++t) {
      add_tet(&update.tet_vertices[4 * at(t)], first_row, update);
    }
  }

  PiecePart finish() &&
  {
    drop_old_tets();
    number_vertices();
    for (const LocalIndex row : tet_vertices_) {
      new_.piece.tet_vertices.push_back(new_number_[at(row)]);
    }
    new_.tet_tag = std::move(tet_tag_);
    new_.piece.subdomain = piece_.subdomain;
    new_.piece.material = piece_.material;
    new_.num_vertex_tags = part_.num_vertex_tags + static_cast<LocalIndex>(new_hosts_.size());
    new_.num_tet_tags = num_tet_tags_;
    new_.is_complete = part_.is_complete;
    new_.is_whole = part_.is_whole;
    if (part_.is_whole) add_boundary();
    return std::move(new_);
  }

 private:
  void add_tet(const LocalIndex* vertices, LocalIndex first_row, const PieceUpdate& update)
  {
    const LocalIndex tag = num_tet_tags_++;
    std::array<LocalIndex, 4> rows;
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex v = vertices[c];
      if (-1 - v >= update.num_new_vertices()) refuse(update);
      rows[c] = v < 0 ? first_row - 1 - v : row_of_tag(v, first_row);
    }
    if (std::ranges::find(rows, kNoIndex) != rows.end()) {
      if (part_.is_complete) refuse(update);
      return;
    }
    tet_vertices_.insert(tet_vertices_.end(), rows.begin(), rows.end());
    tet_tag_.push_back(tag);
  }

  // kNoIndex if the part has no such vertex below that row.
  [[nodiscard]] LocalIndex row_of_tag(LocalIndex tag, LocalIndex end_row) const
  {
    if (tag >= part_.num_vertex_tags) {
      const LocalIndex row = piece_.num_vertices() + (tag - part_.num_vertex_tags);
      return row < end_row ? row : kNoIndex;
    }
    const std::span<const LocalIndex> tags(part_.vertex_tag);
    const auto num_skin = at(piece_.num_skin_vertices());
    for (const auto some : {tags.first(num_skin), tags.subspan(num_skin)}) {
      const auto found = std::ranges::lower_bound(some, tag);
      if (found != some.end() && *found == tag) {
        return static_cast<LocalIndex>(&*found - tags.data());
      }
    }
    return kNoIndex;
  }

  [[noreturn]] void refuse(const PieceUpdate& update) const
  {
    throw MeshError(
        fmt::format("the update of region {} names a vertex that subdomain {} has not got",
                    update.region, piece_.subdomain));
  }

  // Tags ascend, so one walk finds them.
  void drop_old_tets()
  {
    std::ranges::sort(old_tets_);
    auto next = old_tets_.begin();
    std::size_t num_kept = 0;
    for (std::size_t t = 0; t < tet_tag_.size(); ++t) {
      next =
          std::find_if(next, old_tets_.end(), [&](LocalIndex tag) { return tag >= tet_tag_[t]; });
      if (next != old_tets_.end() && *next == tet_tag_[t]) continue;
      std::copy_n(&tet_vertices_[4 * t], 4, &tet_vertices_[4 * num_kept]);
      tet_tag_[num_kept++] = tet_tag_[t];
    }
    tet_vertices_.resize(4 * num_kept);
    tet_tag_.resize(num_kept);
  }

  // Host of a vertex, kNoIndex if it is interior.
  [[nodiscard]] mesh::HostEntity host_of(LocalIndex row) const
  {
    if (row < piece_.num_skin_vertices()) return piece_.skin_host[at(row)];
    return row < piece_.num_vertices() ? kNoIndex : new_hosts_[at(row - piece_.num_vertices())];
  }

  [[nodiscard]] LocalIndex index_of(LocalIndex row) const
  {
    return row < piece_.num_skin_vertices() ? piece_.skin_index[at(row)]
                                            : new_indices_[at(row - piece_.num_vertices())];
  }

  void number_vertices()
  {
    const auto num_rows = static_cast<LocalIndex>(vertex_tag_.size());
    std::vector<char> is_used(at(num_rows), 0);
    for (const LocalIndex row : tet_vertices_) is_used[at(row)] = 1;
    new_number_.assign(at(num_rows), kNoIndex);
    mesh::Piece& piece = new_.piece;
    for (const bool wants_shared : {true, false}) {
      for (LocalIndex row = 0; row < num_rows; ++row) {
        const mesh::HostEntity host = host_of(row);
        if (is_used[at(row)] == 0 || (host != kNoIndex) != wants_shared) continue;
        new_number_[at(row)] = piece.num_vertices();
        const double* xyz = &vertex_xyz_[3 * at(row)];
        piece.vertex_xyz.insert(piece.vertex_xyz.end(), xyz, xyz + 3);
        new_.vertex_tag.push_back(vertex_tag_[at(row)]);
        if (host == kNoIndex) continue;
        piece.skin_host.push_back(host);
        piece.skin_index.push_back(index_of(row));
      }
    }
  }

  void add_boundary()
  {
    mesh::Piece& piece = new_.piece;
    for (const LocalIndex v : piece_.boundary_vertices) {
      piece.boundary_vertices.push_back(new_number_[at(v)]);
    }
    piece.boundary_patch = piece_.boundary_patch;
    for (const LocalIndex v : piece_.line_vertices)
      piece.line_vertices.push_back(new_number_[at(v)]);
    piece.line = piece_.line;
    if (std::ranges::find(piece.line_vertices, kNoIndex) != piece.line_vertices.end()) {
      throw MeshError(fmt::format(
          "updates took a point on a line inside of solids from subdomain {}", piece.subdomain));
    }
    piece.columns = piece_.columns;
    piece.boundary_tet =
        mesh::match_surface(piece.boundary_vertices, piece.num_skin_vertices(), piece.tet_vertices)
            .triangle_tet;
    const auto bare = std::ranges::find(piece.boundary_tet, kNoIndex);
    if (bare != piece.boundary_tet.end()) {
      throw MeshError(
          fmt::format("updates took the tet behind triangle {} on the geometry from subdomain {}",
                      bare - piece.boundary_tet.begin(), piece.subdomain));
    }
  }

  const PiecePart& part_;
  const mesh::Piece& piece_;
  LocalIndex num_tet_tags_;
  std::vector<double> vertex_xyz_;             // By row.
  std::vector<LocalIndex> vertex_tag_;         // By row.
  std::vector<LocalIndex> tet_vertices_;       // Rows.
  std::vector<LocalIndex> tet_tag_;            // Ascending.
  std::vector<LocalIndex> old_tets_{};         // Tags.
  std::vector<mesh::HostEntity> new_hosts_{};  // Of the updates' vertices; kNoIndex: interior.
  std::vector<LocalIndex> new_indices_{};      // In that host.
  std::vector<LocalIndex> new_number_{};       // By row.
  PiecePart new_{};
};

}  // namespace

PiecePart apply_updates(const PiecePart& part, std::span<const RegionExchange> exchanges)
{
  Updater updater(part);
  for (const RegionExchange& exchange : exchanges) updater.add(exchange);
  return std::move(updater).finish();
}

}  // namespace tessera::improve

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/improve/region_update.hpp"
#include "tessera/mesh/surface_match.hpp"

namespace tessera::improve {
namespace {

// Builds the new piece in numbers that have room for everything: the old vertices, then the
// updates' new ones; unused vertices are dropped at the end.
class Updater {
 public:
  explicit Updater(const mesh::Piece& piece)
      : piece_(piece), next_vertex_(piece.num_vertices()), vertex_xyz_(piece.vertex_xyz)
  {
    new_.subdomain = piece.subdomain;
    new_.material = piece.material;
  }

  void keep_tets(std::span<const LocalIndex> labels, std::span<const RegionUpdate> updates)
  {
    for (LocalIndex t = 0; t < piece_.num_tets(); ++t) {
      const auto update = std::lower_bound(updates.begin(), updates.end(), labels[at(t)],
                                           [](const RegionUpdate& candidate, LocalIndex region) {
                                             return candidate.region < region;
                                           });
      if (update != updates.end() && update->region == labels[at(t)]) continue;
      const LocalIndex* v = &piece_.tet_vertices[4 * at(t)];
      tet_vertices_.insert(tet_vertices_.end(), v, v + 4);
    }
  }

  void add(const RegionUpdate& update)
  {
    const auto subdomain =
        std::find(update.subdomains.begin(), update.subdomains.end(), piece_.subdomain);
    if (subdomain == update.subdomains.end()) {
      throw MeshError(fmt::format("the update of region {} is not for subdomain {}", update.region,
                                  piece_.subdomain));
    }
    const auto owner = static_cast<std::size_t>(subdomain - update.subdomains.begin());
    for (LocalIndex i = 0; i < update.num_new_vertices(); ++i) {
      const bool is_shared = i < update.num_shared;
      new_hosts_.push_back(is_shared ? update.host : kNoIndex);
      new_indices_.push_back(i);
    }
    vertex_xyz_.insert(vertex_xyz_.end(), update.vertex_xyz.begin(), update.vertex_xyz.end());
    for (std::size_t i = 4 * at(update.tet_offsets[owner]);
         i < 4 * at(update.tet_offsets[owner + 1]); ++i) {
      tet_vertices_.push_back(vertex_of(update, update.tet_vertices[i]));
    }
    next_vertex_ += update.num_new_vertices();
  }

  mesh::Piece finish() &&
  {
    number_vertices();
    for (const LocalIndex v : tet_vertices_) new_.tet_vertices.push_back(new_number_[at(v)]);
    add_boundary();
    return std::move(new_);
  }

 private:
  [[nodiscard]] LocalIndex vertex_of(const RegionUpdate& update, LocalIndex v) const
  {
    if (v >= piece_.num_vertices() || -1 - v >= update.num_new_vertices()) {
      throw MeshError(
          fmt::format("the update of region {} names a vertex that subdomain {} has not got",
                      update.region, piece_.subdomain));
    }
    return v >= 0 ? v : next_vertex_ - 1 - v;
  }

  // Host of a vertex, kNoIndex if it is interior.
  [[nodiscard]] mesh::HostEntity host_of(LocalIndex v) const
  {
    if (v < piece_.num_skin_vertices()) return piece_.skin_host[at(v)];
    return v < piece_.num_vertices() ? kNoIndex : new_hosts_[at(v - piece_.num_vertices())];
  }

  [[nodiscard]] LocalIndex index_of(LocalIndex v) const
  {
    return v < piece_.num_skin_vertices() ? piece_.skin_index[at(v)]
                                          : new_indices_[at(v - piece_.num_vertices())];
  }

  void number_vertices()
  {
    std::vector<char> is_used(at(next_vertex_), 0);
    for (const LocalIndex v : tet_vertices_) is_used[at(v)] = 1;
    new_number_.assign(at(next_vertex_), kNoIndex);
    for (const bool wants_shared : {true, false}) {
      for (LocalIndex v = 0; v < next_vertex_; ++v) {
        const mesh::HostEntity host = host_of(v);
        if (is_used[at(v)] == 0 || (host != kNoIndex) != wants_shared) continue;
        new_number_[at(v)] = new_.num_vertices();
        const double* xyz = &vertex_xyz_[3 * at(v)];
        new_.vertex_xyz.insert(new_.vertex_xyz.end(), xyz, xyz + 3);
        if (host == kNoIndex) continue;
        new_.skin_host.push_back(host);
        new_.skin_index.push_back(index_of(v));
      }
    }
  }

  void add_boundary()
  {
    for (const LocalIndex v : piece_.boundary_vertices) {
      new_.boundary_vertices.push_back(new_number_[at(v)]);
    }
    new_.boundary_patch = piece_.boundary_patch;
    new_.boundary_tet =
        mesh::match_surface(new_.boundary_vertices, new_.num_skin_vertices(), new_.tet_vertices)
            .triangle_tet;
    const auto bare = std::find(new_.boundary_tet.begin(), new_.boundary_tet.end(), kNoIndex);
    if (bare != new_.boundary_tet.end()) {
      throw MeshError(
          fmt::format("patches took the tet behind triangle {} on the geometry from subdomain {}",
                      bare - new_.boundary_tet.begin(), piece_.subdomain));
    }
  }

  const mesh::Piece& piece_;
  LocalIndex next_vertex_;
  std::vector<double> vertex_xyz_;
  std::vector<LocalIndex> tet_vertices_{};
  std::vector<mesh::HostEntity> new_hosts_{};  // Of the updates' vertices; kNoIndex: interior.
  std::vector<LocalIndex> new_indices_{};      // In that host.
  std::vector<LocalIndex> new_number_{};
  mesh::Piece new_{};
};

}  // namespace

mesh::Piece apply_updates(const mesh::Piece& piece, std::span<const LocalIndex> labels,
                          std::span<const RegionUpdate> updates)
{
  Updater updater(piece);
  updater.keep_tets(labels, updates);
  for (const RegionUpdate& update : updates) updater.add(update);
  return std::move(updater).finish();
}

}  // namespace tessera::improve

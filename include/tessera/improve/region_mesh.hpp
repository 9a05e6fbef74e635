// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/improve/region_band.hpp"
#include "tessera/improve/seam_regions.hpp"

namespace tessera::improve {

/// @brief A vertex as one of the region's pieces knows it.
struct PieceVertex {
  LocalIndex owner = kNoIndex;   ///< Row of RegionMesh::subdomains.
  LocalIndex vertex = kNoIndex;  ///< Tag of a vertex of that piece.

  friend bool operator==(const PieceVertex&, const PieceVertex&) = default;
};

/// @brief The tets of one region, glued together over its pieces.
///
/// A vertex on the region's boundary is *fixed*: it keeps position and identity. The others are
/// *free*: all tets around them are here. Fixed vertices are numbered first. *Owners* are rows of
/// `subdomains`.
struct RegionMesh {
  LocalIndex region = kNoIndex;
  mesh::HostEntity host = 0;               ///< SeamRegions::host_of() it.
  std::vector<LocalIndex> subdomains{};    ///< Shape (num_owners), ascending.
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.
  std::vector<LocalIndex> tet_owner{};     ///< Shape (num_tets).
  Lists<PieceVertex> fixed_places{};       ///< Where each fixed vertex is; ascending by owner.
  std::vector<LocalIndex>
      triangle_vertices{};                     ///< Shape (num_triangles, 3): the boundary; outward.
  std::vector<LocalIndex> triangle_owner{};    ///< Owner of the tet behind each, inside.
  std::vector<LocalIndex> triangle_outside{};  ///< Owner of the tet in front of it that is not of
                                               ///< the region; kNoIndex: none of these pieces.

  [[nodiscard]] LocalIndex num_vertices() const { return count(vertex_xyz.size(), 3); }
  [[nodiscard]] LocalIndex num_fixed() const { return fixed_places.num_lists(); }
  [[nodiscard]] LocalIndex num_tets() const { return count(tet_owner.size(), 1); }
  [[nodiscard]] LocalIndex num_triangles() const { return count(triangle_owner.size(), 1); }
  [[nodiscard]] LocalIndex num_owners() const { return count(subdomains.size(), 1); }

  /// @brief Where fixed vertex `v` is.
  [[nodiscard]] std::span<const PieceVertex> places_of(LocalIndex v) const
  {
    return fixed_places[v];
  }

 private:
  static LocalIndex count(std::size_t size, std::size_t width)
  {
    return static_cast<LocalIndex>(size / width);
  }
};

/// @brief Glues a region's tets together.
/// @param[in] bands Of regions.subdomains_of(region), in that order.
/// @note Local; O(n log n) in the bands.
/// @throws MeshError if a triangle would belong to three tets, or if more than 64 subdomains meet.
[[nodiscard]] RegionMesh extract_region(std::span<const Band> bands, const SeamRegions& regions,
                                        LocalIndex region);

}  // namespace tessera::improve

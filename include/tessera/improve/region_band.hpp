// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/improve/piece_part.hpp"
#include "tessera/improve/seam_regions.hpp"
#include "tessera/mesh/host_layout.hpp"

namespace tessera::improve {

/// @brief What a region's job needs of one piece.
///
/// These are the tets with the region's label, and what may face them: vertices that other pieces
/// of the region may hold too, and triangles of tets without the label. A job that knows less of
/// them gives fewer tets to this piece; the mesh is sound in any case.
struct Band {
  std::vector<double> vertex_xyz{};             ///< Shape (num_vertices, 3); skin vertices first.
  std::vector<LocalIndex> vertex_tag{};         ///< Shape (num_vertices).
  std::vector<mesh::HostEntity> skin_host{};    ///< Shape (num_skin_vertices).
  std::vector<LocalIndex> skin_index{};         ///< Shape (num_skin_vertices).
  std::vector<LocalIndex> tet_vertices{};       ///< Shape (num_tets, 4); positive, VTK's order.
  std::vector<LocalIndex> outside_triangles{};  ///< Shape (num_triangles, 3): faces of tets that
                                                ///< have not the region's label.

  static auto fields(auto& self)
  {
    return std::tie(self.vertex_xyz, self.vertex_tag, self.skin_host, self.skin_index,
                    self.tet_vertices, self.outside_triangles);
  }

  [[nodiscard]] LocalIndex num_vertices() const
  {
    return static_cast<LocalIndex>(vertex_tag.size());
  }
  [[nodiscard]] LocalIndex num_skin_vertices() const
  {
    return static_cast<LocalIndex>(skin_host.size());
  }
  [[nodiscard]] LocalIndex num_tets() const
  {
    return static_cast<LocalIndex>(tet_vertices.size() / 4);
  }
  [[nodiscard]] mesh::HostPoint skin_point(LocalIndex v) const
  {
    return {skin_host[at(v)], skin_index[at(v)]};
  }
};

/// @brief How far from a region, in layers of tets, a band has the vertices that other pieces may
/// hold: the tets of these pieces that use them are within kDefaultLayers on the other side.
inline constexpr int kSharedLayers = 4;

/// @brief The bands of a piece, one for each of the regions that it takes part in in a phase, in
/// the order of regions.regions_of().
/// @param[in] part The piece or a part of it.
/// @param[in] labels label_tets() of the part.
/// @note Local; linear in the part for every 64 regions.
[[nodiscard]] std::vector<Band> make_bands(const PiecePart& part,
                                           std::span<const LocalIndex> labels,
                                           const SeamRegions& regions, int phase);

/// @brief Tags of the tets of each of these regions, ascending: what an accepted update exchanges.
/// Local; linear.
[[nodiscard]] IndexLists tets_of_bands(const PiecePart& part, std::span<const LocalIndex> labels,
                                       const SeamRegions& regions, int phase);

}  // namespace tessera::improve

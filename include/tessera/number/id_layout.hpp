// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/skin.hpp"

namespace tessera::number {

/// @brief What numbering needs to know of a piece.
struct PieceCounts {
  GlobalIndex interior_vertices = 0;
  GlobalIndex tets = 0;
  GlobalIndex boundary_triangles = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.interior_vertices, self.tets, self.boundary_triangles);
  }
};

/// @brief Dense 64-bit ids 0…N-1 of vertices, tets and boundary triangles.
///
/// Vertices are counted host by host: skeleton vertices, edges, triangles (closed forms, 1, n - 1
/// and (n - 1)(n - 2)/2 points each), then the interiors of the pieces (a prefix sum). Tets and
/// boundary triangles are counted piece by piece. The same for every number of ranks.
class IdLayout {
 public:
  /// @param[in] pieces Counts of all subdomains, in their order. @param[in] n Intervals of an edge.
  IdLayout(const mesh::HostLayout& hosts, LocalIndex n, const std::vector<PieceCounts>& pieces);

  /// @brief The layout where `interior_vertices` counts all vertices that a piece owns, and no host
  /// of the skeleton has any of its own.
  [[nodiscard]] static IdLayout by_owner(const std::vector<PieceCounts>& pieces)
  {
    return IdLayout(mesh::HostLayout(mesh::Skeleton{}), 1, pieces);
  }

  [[nodiscard]] GlobalIndex vertex_id(mesh::HostEntity host, LocalIndex index) const;
  [[nodiscard]] GlobalIndex interior_vertex_id(LocalIndex subdomain, LocalIndex index) const
  {
    return interior_offset_[static_cast<std::size_t>(subdomain)] + index;
  }
  [[nodiscard]] GlobalIndex first_tet(LocalIndex subdomain) const
  {
    return tet_offset_[static_cast<std::size_t>(subdomain)];
  }
  [[nodiscard]] GlobalIndex first_boundary_triangle(LocalIndex subdomain) const
  {
    return boundary_offset_[static_cast<std::size_t>(subdomain)];
  }

  [[nodiscard]] GlobalIndex num_vertices() const { return interior_offset_.back(); }
  [[nodiscard]] GlobalIndex num_tets() const { return tet_offset_.back(); }
  [[nodiscard]] GlobalIndex num_boundary_triangles() const { return boundary_offset_.back(); }

 private:
  mesh::HostLayout hosts_;
  GlobalIndex edge_points_;
  GlobalIndex triangle_points_;
  GlobalIndex first_triangle_id_;
  std::vector<GlobalIndex> interior_offset_{};  ///< Shape (num_subdomains + 1).
  std::vector<GlobalIndex> tet_offset_{};       ///< Shape (num_subdomains + 1).
  std::vector<GlobalIndex> boundary_offset_{};  ///< Shape (num_subdomains + 1).
};

}  // namespace tessera::number

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/lattice_levels.hpp"

namespace tessera::number {

/// @brief What numbering needs to know of a piece.
struct PieceCounts {
  GlobalIndex interior_vertices = 0;  ///< Of the piece's own host; no other piece has them.
  GlobalIndex tets = 0;
  GlobalIndex boundary_triangles = 0;
  GlobalIndex line_edges = 0;
  GlobalIndex owned_vertices = 0;  ///< Interior ones and those that no lower piece shares; 0 if
                                   ///< nobody needs it.

  static auto fields(auto& self)
  {
    return std::tie(self.interior_vertices, self.tets, self.boundary_triangles, self.line_edges,
                    self.owned_vertices);
  }

  friend bool operator==(const PieceCounts&, const PieceCounts&) = default;
};

/// @brief Dense 64-bit ids 0…N-1 of vertices, tets, boundary triangles and edges on lines; the same
/// for every number of ranks.
///
/// Tets, boundary triangles and edges on lines are counted piece by piece. Vertices are counted in
/// one of two ways:
///
/// - by host: the vertices of the skeleton's vertices, edges and triangles (a closed form of their
///   levels each), then those inside the pieces (a prefix sum). Works before there are pieces.
/// - by owner: piece by piece, each counts the vertices it owns. Needed once pieces have exchanged
///   tets, for then the skeleton's closed forms do not hold.
class IdLayout {
 public:
  /// @param[in] levels Of the skeleton. @param[in] pieces Counts of all subdomains, in their order.
  [[nodiscard]] static IdLayout by_host(const mesh::HostLayout& hosts,
                                        const mesh::LatticeLevels& levels,
                                        const std::vector<PieceCounts>& pieces);

  /// @param[in] pieces Counts of all subdomains, in their order.
  [[nodiscard]] static IdLayout by_owner(const std::vector<PieceCounts>& pieces);

  [[nodiscard]] bool is_by_host() const { return skeleton_.has_value(); }

  /// @brief Id of a vertex of the skeleton or inside a piece. @pre is_by_host().
  [[nodiscard]] GlobalIndex vertex_id(const mesh::HostPoint& vertex) const;

  /// @brief Id of vertex `index` inside a piece. @pre is_by_host().
  [[nodiscard]] GlobalIndex interior_vertex_id(LocalIndex subdomain, LocalIndex index) const
  {
    return first_vertex_[at(subdomain)] + index;
  }

  /// @brief Id of vertex `index` of those that a piece owns. @pre !is_by_host().
  [[nodiscard]] GlobalIndex owned_vertex_id(LocalIndex subdomain, LocalIndex index) const
  {
    return first_vertex_[at(subdomain)] + index;
  }

  [[nodiscard]] GlobalIndex first_tet(LocalIndex subdomain) const
  {
    return first_tet_[at(subdomain)];
  }
  [[nodiscard]] GlobalIndex first_boundary_triangle(LocalIndex subdomain) const
  {
    return first_boundary_triangle_[at(subdomain)];
  }
  [[nodiscard]] GlobalIndex first_line_edge(LocalIndex subdomain) const
  {
    return first_line_edge_[at(subdomain)];
  }

  [[nodiscard]] GlobalIndex num_vertices() const { return first_vertex_.back(); }
  [[nodiscard]] GlobalIndex num_tets() const { return first_tet_.back(); }
  [[nodiscard]] GlobalIndex num_boundary_triangles() const
  {
    return first_boundary_triangle_.back();
  }

 private:
  /// Where the ids of the skeleton's hosts begin.
  struct SkeletonIds {
    mesh::HostLayout hosts;
    std::vector<GlobalIndex> first{};  ///< Shape (num_on_skeleton).
  };

  IdLayout(GlobalIndex num_skeleton_vertices, const std::vector<PieceCounts>& pieces,
           GlobalIndex PieceCounts::*num_vertices);

  std::optional<SkeletonIds> skeleton_{};                ///< If vertices are counted by host.
  std::vector<GlobalIndex> first_vertex_{};              ///< Shape (num_subdomains + 1).
  std::vector<GlobalIndex> first_tet_{0};                ///< Shape (num_subdomains + 1).
  std::vector<GlobalIndex> first_boundary_triangle_{0};  ///< Shape (num_subdomains + 1).
  std::vector<GlobalIndex> first_line_edge_{0};          ///< Shape (num_subdomains + 1).
};

}  // namespace tessera::number

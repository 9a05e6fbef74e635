// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::migrate {

/// @brief Some tets of a distributed mesh with all that belongs to them.
///
/// Vertices, tets and boundary triangles are each in ascending order of their global ids. Every
/// vertex is on a tet, and every boundary triangle is a face of one.
struct MeshBlock {
  std::vector<GlobalIndex> vertex_ids{};  ///< Shape (num_vertices).
  std::vector<double> vertex_xyz{};       ///< Shape (num_vertices, 3).

  std::vector<GlobalIndex> tet_ids{};        ///< Shape (num_tets).
  std::vector<LocalIndex> tet_vertices{};    ///< Shape (num_tets, 4); positive, VTK's order.
  std::vector<std::int32_t> tet_material{};  ///< Shape (num_tets).
  std::vector<LocalIndex> tet_part{};        ///< Shape (num_tets); the part that each tet is in.
  /// Shape (num_columns, num_tets); 64 bits a tet that go with it, whatever they mean.
  std::vector<std::vector<std::uint64_t>> tet_columns{};

  std::vector<GlobalIndex> boundary_ids{};     ///< Shape (num_boundary).
  std::vector<LocalIndex> boundary_tet{};      ///< Shape (num_boundary); tet behind the triangle.
  std::vector<LocalIndex> boundary_corner{};   ///< Shape (num_boundary); its corner opposite to the
                                               ///< triangle, which is that face, seen from outside.
  std::vector<std::int32_t> boundary_patch{};  ///< Shape (num_boundary).

  static auto fields(auto& self)
  {
    return std::tie(self.vertex_ids, self.vertex_xyz, self.tet_ids, self.tet_vertices,
                    self.tet_material, self.tet_part, self.tet_columns, self.boundary_ids,
                    self.boundary_tet, self.boundary_corner, self.boundary_patch);
  }

  friend bool operator==(const MeshBlock&, const MeshBlock&) = default;

  [[nodiscard]] LocalIndex num_vertices() const
  {
    return static_cast<LocalIndex>(vertex_ids.size());
  }
  [[nodiscard]] LocalIndex num_tets() const { return static_cast<LocalIndex>(tet_ids.size()); }
  [[nodiscard]] LocalIndex num_boundary() const
  {
    return static_cast<LocalIndex>(boundary_ids.size());
  }

  /// @brief Vertices of tet `t`.
  [[nodiscard]] std::span<const LocalIndex, 4> tet(LocalIndex t) const
  {
    return std::span<const LocalIndex, 4>(tet_vertices.data() + 4 * at(t), 4);
  }

  /// @brief Position of vertex `v`.
  [[nodiscard]] Vec3 position(LocalIndex v) const { return point_at(std::span(vertex_xyz), v); }
};

/// @brief This rank's share of a tet mesh whose every tet is on one rank.
///
/// A vertex on tets of several ranks stands on each of them. Its *sharers* are these ranks, its
/// *owner* is the lowest of them.
struct DistributedMesh : MeshBlock {
  static auto fields(auto& self) = delete;  ///< It goes to bytes as blocks.

  /// Shape (num_vertices, …): the sharers, this rank among them, ascending; none if there is only
  /// this rank.
  IndexLists vertex_sharers{};

  friend bool operator==(const DistributedMesh&, const DistributedMesh&) = default;

  /// @brief Lowest rank that has vertex `v`. @param[in] rank this rank.
  [[nodiscard]] Rank owner(LocalIndex v, Rank rank) const
  {
    const auto sharers = vertex_sharers[v];
    return sharers.empty() ? rank : sharers.front();
  }
};

/// @brief Values of tets, gathered at the vertices that these have: of each vertex the different
/// values of its tets, ascending. Local; linear in time if the lists are short.
/// @param[in] tet_values Shape (num_tets).
[[nodiscard]] IndexLists values_around_vertices(const MeshBlock& block,
                                                std::span<const LocalIndex> tet_values);

/// @brief Sum over the tets of a hash of positions (bits) and material: equal for two meshes that
/// have the same tets, whatever their ids, order and place. Local: add over ranks.
[[nodiscard]] Hash128 digest_of_tets(const MeshBlock& block);

}  // namespace tessera::migrate

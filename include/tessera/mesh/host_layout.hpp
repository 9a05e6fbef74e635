// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <tuple>

#include "tessera/base/types.hpp"
#include "tessera/mesh/skeleton.hpp"

namespace tessera::mesh {

/// @brief What a fine vertex is counted under: an entity of the skeleton, the inside of one piece,
/// or one seam region. HostLayout says which.
using HostEntity = LocalIndex;

/// @brief Kinds of hosts, in the order of their numbers.
enum class HostKind : std::uint8_t { vertex, edge, triangle, piece, seam_region };

/// @brief Names a fine vertex the same way in every piece that holds it.
struct HostPoint {
  HostEntity host = 0;
  LocalIndex index = 0;  ///< Place within its host.

  static auto fields(auto& self) { return std::tie(self.host, self.index); }

  friend auto operator<=>(const HostPoint&, const HostPoint&) = default;
};

/// @brief The numbers of the hosts: skeleton vertices, then edges, triangles, pieces and seam
/// regions. Nothing else knows this order.
class HostLayout {
 public:
  explicit HostLayout(const Skeleton& skeleton);
  HostLayout(LocalIndex num_vertices, LocalIndex num_edges, LocalIndex num_triangles,
             LocalIndex num_pieces);

  [[nodiscard]] HostEntity vertex(LocalIndex v) const { return v; }
  [[nodiscard]] HostEntity edge(LocalIndex e) const { return first(HostKind::edge) + e; }
  [[nodiscard]] HostEntity triangle(LocalIndex t) const { return first(HostKind::triangle) + t; }
  /// @brief Host of the vertices inside the piece of a subdomain.
  [[nodiscard]] HostEntity piece(LocalIndex subdomain) const
  {
    return first(HostKind::piece) + subdomain;
  }
  /// @brief Host of the vertices that the improvement of a seam region makes and several pieces
  /// share.
  [[nodiscard]] HostEntity seam_region(LocalIndex region) const
  {
    return first(HostKind::seam_region) + region;
  }

  [[nodiscard]] HostKind kind_of(HostEntity host) const;

  /// @brief Skeleton vertex, edge or triangle, subdomain, or seam region.
  [[nodiscard]] LocalIndex row_of(HostEntity host) const { return host - first(kind_of(host)); }

  /// @brief How many hosts of a kind there are. @pre kind is not seam_region.
  [[nodiscard]] LocalIndex num_of(HostKind kind) const;

  /// @brief Vertices, edges and triangles: the hosts below this number are the skeleton's.
  [[nodiscard]] LocalIndex num_on_skeleton() const { return first(HostKind::piece); }

 private:
  static constexpr std::size_t kNumKinds = 5;

  [[nodiscard]] HostEntity first(HostKind kind) const
  {
    return first_[static_cast<std::size_t>(kind)];
  }

  std::array<HostEntity, kNumKinds> first_;  ///< By kind.
};

/// @brief Fine vertices that one host of the skeleton has: a closed form of its kind.
/// @param[in] n Intervals of an edge. @pre kind is vertex, edge or triangle.
[[nodiscard]] LocalIndex num_points_of_host(HostKind kind, LocalIndex n);

/// @brief Lowest subdomain that holds a host of the skeleton. @pre hosts is the skeleton's.
[[nodiscard]] LocalIndex owner_of_host(const Skeleton& skeleton, const HostLayout& hosts,
                                       HostEntity host);

}  // namespace tessera::mesh

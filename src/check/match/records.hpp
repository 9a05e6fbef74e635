// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <tuple>

#include "tessera/base/entity_key.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::check {

inline constexpr GlobalIndex kNoId = std::numeric_limits<GlobalIndex>::min();
inline constexpr LocalIndex kNoPiece = -1;
inline constexpr std::int32_t kNoSubdomain = std::numeric_limits<std::int32_t>::min();

/// @brief One side of a triangle that did not cancel inside its piece: what decides about it.
struct TriangleSide {
  TriangleKey key{};
  LocalIndex piece = 0;
  LocalIndex row = kNoIndex;   ///< Among the triangles of its PieceSurface, or none.
  LocalIndex component = 0;    ///< Of its piece.
  std::int32_t attribute = 0;  ///< Material of the tet.
  std::int32_t subdomain = 0;  ///< Of the tet.
  bool is_odd = false;         ///< Whether the outward order is an odd permutation of the key.

  static auto fields(auto& self)
  {
    return std::tie(self.key, self.piece, self.row, self.component, self.attribute, self.subdomain,
                    self.is_odd);
  }
};

/// @brief A side of a triangle, or a triangle of the boundary file, with all that is said of it.
struct TriangleRecord {
  TriangleKey key{};
  GlobalIndex cell_id = kNoId;      ///< Of the tet; in the boundary file: of the tet named there.
  std::array<float, 3> centroid{};  ///< For messages only.
  LocalIndex piece = 0;
  LocalIndex cell = 0;        ///< Row in its piece.
  LocalIndex row = kNoIndex;  ///< As of TriangleSide; tets only, as the next two.
  LocalIndex component = 0;
  std::int32_t attribute = 0;
  std::int32_t subdomain = 0;  ///< Of the tet; in the boundary file: named there, or kNoSubdomain.
  bool is_odd = false;
  bool is_listed = false;  ///< From the boundary file.
  bool is_inside = false;  ///< On a patch with one material on both sides; boundary file only.

  static auto fields(auto& self)
  {
    return std::tie(self.key, self.cell_id, self.centroid, self.piece, self.cell, self.row,
                    self.component, self.attribute, self.subdomain, self.is_odd, self.is_listed,
                    self.is_inside);
  }
};

/// @brief What a triangle turned out to be.
/// open_seam: on one tet, not in the boundary file of a mesh of which only some pieces were made.
/// unknown: there is no verdict yet.
enum class TriangleRole : std::uint8_t {
  unknown,
  inner,
  outside,
  open_seam,
  seam,
  interface,
  faulty
};
[[nodiscard]] constexpr TriangleRole last_value(TriangleRole /*type*/)
{
  return TriangleRole::faulty;
}

/// @brief Whether only one tet has the triangle.
[[nodiscard]] constexpr bool is_open(TriangleRole role)
{
  return role == TriangleRole::outside || role == TriangleRole::open_seam;
}

/// @brief A point of a piece that may be in other pieces as well.
struct VertexRecord {
  Vec3 position{};
  GlobalIndex id = kNoId;
  LocalIndex piece = 0;
  LocalIndex point = 0;          ///< Row in its piece.
  bool is_used = false;          ///< By a tet.
  bool is_inner = false;         ///< On no open triangle of its piece: no other piece may have it.
  bool is_on_seam = false;       ///< On a seam triangle of its piece.
  bool is_listed = false;        ///< From the boundary file.
  bool is_shared = false;        ///< Several pieces of tets have it.
  bool is_contradicted = false;  ///< And not at one position.
  bool is_on_plus = false;       ///< On a patch of a split, on the one side; boundary file only.
  bool is_on_minus = false;      ///< On the other side.

  static auto fields(auto& self)
  {
    return std::tie(self.position, self.id, self.piece, self.point, self.is_used, self.is_inner,
                    self.is_on_seam, self.is_listed, self.is_shared, self.is_contradicted,
                    self.is_on_plus, self.is_on_minus);
  }
};

/// @brief An edge on the surface of a piece; once per boundary triangle on it, or once if none is.
struct EdgeRecord {
  EdgeKey key{};
  std::array<float, 3> inward{};  ///< Unit vector from the edge into the triangle, normal to it.
  std::array<float, 3> middle{};  ///< For messages only.
  LocalIndex piece = 0;
  LocalIndex cell = 0;                ///< Tet of the triangle.
  LocalIndex boundary_component = 0;  ///< Of its piece.
  LocalIndex twin = kNoPiece;         ///< A piece that may have counted half of the edge.
  bool is_on_boundary = false;
  bool is_on_split = false;  ///< The triangle's third vertex is on a patch of a split.

  static auto fields(auto& self)
  {
    return std::tie(self.key, self.inward, self.middle, self.piece, self.cell,
                    self.boundary_component, self.twin, self.is_on_boundary, self.is_on_split);
  }
};

}  // namespace tessera::check

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/coarse/own_mesh.hpp"

namespace tessera::coarse {

/// @brief What a file says of a triangle.
struct FaceTag {
  std::int32_t group = 0;
  std::int32_t entity = 0;

  friend auto operator<=>(const FaceTag&, const FaceTag&) = default;
};

/// @brief A triangle of a tet that is outside or between two materials.
struct BoundaryFace {
  std::array<LocalIndex, 3> vertices{};   ///< Seen from outside of the first material.
  std::array<LocalIndex, 2> materials{};  ///< Ascending, from 1; the second is 0: outside.
  std::optional<FaceTag> tag{};           ///< None: it is not in the file.
};

/// @brief Puts faces and their patches into a mesh that has none, and the patches' entities. Local.
void add_patches(const std::vector<BoundaryFace>& faces,
                 const std::map<std::int32_t, std::string>& group_names, double feature_angle_deg,
                 OwnMesh& own);

/// @brief The edges of triangles, each with the triangles around it, in ascending order. Local.
[[nodiscard]] std::map<std::array<LocalIndex, 2>, std::vector<LocalIndex>> faces_of_edges(
    std::span<const LocalIndex> face_vertices);

}  // namespace tessera::coarse

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/coarse/coarse_surface.hpp"
#include "tessera/cut/cut_tree.hpp"

namespace tessera::coarse {

/// @brief Closed paths of edges of a skin along a plane. They part its triangles in two.
struct MembraneBorder {
  cut::Plane plane{};
  std::vector<char> is_above{};  ///< Shape (num_triangles) of the skin: its side of the paths.
  /// Rows of the skin's vertices. Seen from above the plane, what they enclose is to the left.
  std::vector<std::array<LocalIndex, 2>> edges{};
};

/// @brief Triangles inside of such paths: what divides a domain in two.
struct Membrane {
  std::vector<double> vertex_xyz{};             ///< Shape (n, 3): vertices off the skin.
  std::vector<LocalIndex> triangle_vertices{};  ///< Shape (num_triangles, 3); normals point up.
                                                ///< Rows of the skin's vertices, then the others.
};

/// @brief Makes the triangles inside of a border.
using MembraneMesher = std::function<Membrane(const DomainSkin&, const MembraneBorder&)>;

/// @brief The paths along a plane, if there are some that meet no vertex twice. Local.
///
/// Triangles belong to the side where their centroids are, but for those that would make the paths
/// jagged.
[[nodiscard]] std::optional<MembraneBorder> membrane_border(const DomainSkin& skin,
                                                            const cut::Plane& plane);

/// @brief Whether a membrane fills its border and makes two sound skins: its triangles all look
/// up, share edges with each other and the border only, and cut no triangle of the skin. Local.
[[nodiscard]] bool is_sound(const Membrane& membrane, const DomainSkin& skin,
                            const MembraneBorder& border);

}  // namespace tessera::coarse

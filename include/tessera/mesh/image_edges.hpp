// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/orbits.hpp"

namespace tessera::mesh {

/// @brief A coarse edge on a side of SideImages, and the edge whose image it is. Partners stand at
/// the same end; ends ascend.
struct ImageEdge {
  std::array<LocalIndex, 2> from{};
  std::array<LocalIndex, 2> to{};
  LocalIndex transform = 0;  ///< Row of SideImages::transforms.
};

/// @brief Which images are meant. Periodic ones are neither at joints nor at splits.
enum class ImageKind : std::uint8_t { all, joints, without_joints, periodic };

/// @brief The sides of all faces that are images, in the order of these; some stand twice. Local.
[[nodiscard]] std::vector<ImageEdge> image_edges(const CoarseMesh& mesh,
                                                 ImageKind kind = ImageKind::all);

/// @brief Coarse vertices that are images of each other.
struct VertexOrbits {
  OrbitTable vertices{};
  std::vector<Affine> images{};  ///< As Orbits::images.
};

/// @brief Those that such edges make. Local; O(n log n).
[[nodiscard]] VertexOrbits find_vertex_orbits(const CoarseMesh& mesh,
                                              ImageKind kind = ImageKind::all);

}  // namespace tessera::mesh

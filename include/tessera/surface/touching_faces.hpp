// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::surface {

/// @brief Two outer triangles of a tet mesh that lie on each other in part.
struct TouchingFaces {
  std::size_t first = 0;
  std::size_t second = 0;
  Vec3 place{};
};

/// @brief The first place where outer triangles touch without sharing what they touch with: a
/// corner or the middle of one lies on another one. So tets meet there whose faces do not match.
/// Local; O(n log n) for triangles that are much smaller than the mesh.
/// @param[in] tolerance What counts as on it.
[[nodiscard]] std::optional<TouchingFaces> find_touching_faces(
    std::span<const double> vertex_xyz, const std::vector<std::array<LocalIndex, 3>>& triangles,
    double tolerance);

}  // namespace tessera::surface

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera {

/// @brief Where the vertices of a tet or triangle are: row `row` of a flat array of such. Local.
/// @param[in] xyz Shape (num_vertices, 3). @param[in] vertices Shape (num_rows, N).
template <std::size_t N, class Index>
[[nodiscard]] constexpr std::array<Vec3, N> corners_at(std::span<const double> xyz,
                                                       std::span<const LocalIndex> vertices,
                                                       Index row) noexcept
{
  std::array<Vec3, N> corners{};
  const std::size_t first = N * static_cast<std::size_t>(row);
  for (std::size_t c = 0; c < N; ++c) corners[c] = point_at(xyz, vertices[first + c]);
  return corners;
}

/// @brief Signed volume; positive in VTK's vertex order.
[[nodiscard]] constexpr double tet_volume(const std::array<Vec3, 4>& p) noexcept
{
  return tet_volume(p[0], p[1], p[2], p[3]);
}

/// @brief Mean of the corners.
[[nodiscard]] constexpr Vec3 tet_centroid(const std::array<Vec3, 4>& p) noexcept
{
  Vec3 sum{};
  for (const Vec3& corner : p) sum = sum + corner;
  return 0.25 * sum;
}

}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"
#include "tessera/mesh/projection_limiter.hpp"

namespace tessera::mesh {

/// @brief Which rows of one kind are images of each other.
struct OrbitTable {
  FlatArray<LocalIndex> base{};   ///< Shape (num_rows), or empty: the lowest row of the orbit.
  FlatArray<LocalIndex> image{};  ///< Shape (num_rows), or empty: row of Orbits::images.

  static auto fields(auto& self) { return std::tie(self.base, self.image); }

  [[nodiscard]] LocalIndex base_of(LocalIndex row) const
  {
    return base.empty() ? row : base[at(row)];
  }
  [[nodiscard]] LocalIndex image_of(LocalIndex row) const
  {
    return image.empty() ? 0 : image[at(row)];
  }
  /// @brief The row that this one is computed as: the base if that is somewhere else. What is at
  /// the same place has the same bits by itself.
  [[nodiscard]] LocalIndex origin_of(LocalIndex row) const
  {
    return image_of(row) == 0 ? row : base_of(row);
  }
};

/// @brief *Orbits* of a skeleton: its vertices, edges and triangles that are images of each other,
/// as a corner of a block that is periodic in three directions and its seven images. All points of
/// an orbit are those of its lowest member under one transform. Empty without SideImages.
struct Orbits {
  std::vector<Affine> images{};  ///< From the lowest member to another. The first: the identity.
  OrbitTable edges{};
  OrbitTable triangles{};
  // By periodic sides alone: both sides of a split or a joint have columns of their own.
  OrbitTable vertex_columns{};
  OrbitTable edge_columns{};

  static auto fields(auto& self)
  {
    return std::tie(self.images, self.edges, self.triangles, self.vertex_columns,
                    self.edge_columns);
  }

  [[nodiscard]] bool are_none() const { return images.empty(); }

  /// @brief A point of a base as one of its orbit.
  [[nodiscard]] Vec3 image(LocalIndex image, const Vec3& point) const
  {
    return image == 0 ? point : images[at(image)](point);
  }
};

/// @brief One row is the image of another.
struct ImageLink {
  LocalIndex from = kNoIndex;
  LocalIndex to = kNoIndex;
  LocalIndex transform = 0;
};

/// @brief Follows links both ways. Local; O(n log n).
/// @param[in,out] images Products of the transforms; gets those that are new. @pre The first is the
/// identity.
[[nodiscard]] OrbitTable find_orbits(LocalIndex num_rows, std::span<const ImageLink> links,
                                     std::span<const Affine> transforms,
                                     std::vector<Affine>& images);

/// @brief Adds the same limits for all that is in one orbit with what is limited: so sides and
/// their images stay alike. Local; does nothing without orbits.
[[nodiscard]] std::vector<PointLimit> on_whole_orbits(std::vector<PointLimit> limits,
                                                      const Orbits& orbits);

}  // namespace tessera::mesh

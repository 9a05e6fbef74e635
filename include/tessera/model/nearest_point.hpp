// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <span>
#include <vector>

#include "tessera/base/search_tree.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::model {

/// @brief The nearest point of a set of triangles, segments or tets.
struct NearestPoint {
  Vec3 xyz{};
  LocalIndex simplex = kNoIndex;  ///< Number of the triangle, segment or tet, in the order given.
  double squared_distance = 0.0;
};

/// @brief Nearest point of a triangle @cite ericson2004 or segment: never off it by more than
/// rounding, and one of its corners exactly where a corner is nearest.
[[nodiscard]] Vec3 nearest_point_of(const std::array<Vec3, 3>& triangle,
                                    const Vec3& point) noexcept;
[[nodiscard]] Vec3 nearest_point_of(const std::array<Vec3, 2>& segment, const Vec3& point) noexcept;

/// @brief Nearest point of a tet, of either orientation or flat: the point itself if it is inside.
[[nodiscard]] Vec3 nearest_point_of(const std::array<Vec3, 4>& tet, const Vec3& point) noexcept;

template <class Simplex>
concept IsTet = std::same_as<Simplex, std::array<Vec3, 4>>;

/// @brief Search for the nearest point of many triangles, segments or tets (`Simplex`: array
/// of corners).
///
/// A pure function of its argument: of equally near simplices, the lowest number wins. That rule
/// needs control over the walk, and exact distances. Of the libraries at hand, Boost's R-tree
/// orders by box distance only and CGAL's tree is GPL. So the tree is our own.
template <class Simplex>
class NearestPointSearch {
 public:
  /// @pre simplices is not empty.
  explicit NearestPointSearch(std::span<const Simplex> simplices);

  /// @note Local; touches no state, so calls may run side by side.
  [[nodiscard]] NearestPoint nearest(const Vec3& point) const;

 private:
  /// The lowest tet that holds the point, or kNoIndex.
  [[nodiscard]] LocalIndex lowest_holding(const Vec3& point) const requires IsTet<Simplex>;

  SearchTree tree_;
  std::vector<Simplex> simplices_{};  // In the order of the leaves: beside each other in memory.
};

using TriangleSearch = NearestPointSearch<std::array<Vec3, 3>>;
using SegmentSearch = NearestPointSearch<std::array<Vec3, 2>>;
using TetSearch = NearestPointSearch<std::array<Vec3, 4>>;
extern template class NearestPointSearch<std::array<Vec3, 3>>;
extern template class NearestPointSearch<std::array<Vec3, 2>>;
extern template class NearestPointSearch<std::array<Vec3, 4>>;

}  // namespace tessera::model

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/search_tree.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/surface/options.hpp"

namespace tessera::surface {

/// @brief A place that wants short edges: a triangle, a segment (two corners are one) or a point.
struct SizeSource {
  std::array<Vec3, 3> corners{};
  double size = 0.0;  ///< Wanted edge length there.
};

/// @brief The edge length that is wanted at each place: the largest one, but less near sources,
/// from which it grows with the distance. Local; a pure function of what was given to it.
///
/// The distance is that in space. So a size does not depend on how a surface is divided, and what
/// is small on one side of a wall is small on the other.
class SizeFunction {
 public:
  /// @brief With the points of the options as sources.
  explicit SizeFunction(const CoarseOptions& options);

  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] double operator()(const Vec3& place) const;

  /// @brief Whether less than `limit` is wanted at any of these places. Faster than to ask for the
  /// sizes, if the places lie together and most answers are no.
  [[nodiscard]] bool is_below(double limit, std::span<const Vec3> places) const;

  /// @brief Gives it more sources.
  void limit(const std::vector<SizeSource>& sources);

 private:
  void build();
  [[nodiscard]] double size_beside(const SizeSource& source, const Vec3& place) const;

  double largest_;
  double growth_;
  SearchTree tree_{};
  std::vector<SizeSource> sources_{};  // In the order of the leaves.
  std::vector<double> least_{};        // Of each node: the smallest size of its sources.
};

}  // namespace tessera::surface

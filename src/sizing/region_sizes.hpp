// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <variant>

#include "tessera/base/box.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/sizing/options.hpp"

namespace tessera::sizing {

/// @brief Sizes that one region wants.
class RegionSizes {
 public:
  /// @param[in] grading Growth of a region without one of its own.
  /// @throws ConfigError as SizeField, without the number of the region.
  RegionSizes(const SizeRegion& region, double grading, const mesh::CoarseMesh& coarse);

  /// @brief Lowers the sizes at points where the region wants less.
  /// @param[in] xyz Shape (num_points, 3). @param[in,out] sizes Shape (num_points).
  void lower(std::span<const double> xyz, std::span<double> sizes) const;

  [[nodiscard]] double growth() const noexcept { return growth_; }

 private:
  // A search in parts of the coarse mesh, and the box around them.
  template <class Search>
  struct Found {
    Search search;
    tessera::Box box;
  };
  using Triangles = Found<model::TriangleSearch>;
  using Tets = Found<model::TetSearch>;
  using Segments = Found<model::SegmentSearch>;
  using Where = std::variant<Box, Ball, Cylinder, HalfSpace, Triangles, Tets, Segments>;

  template <class Solid>
  static Where find(const Solid& solid, const mesh::CoarseMesh& coarse);
  static Where find(const PatchPattern& patch, const mesh::CoarseMesh& coarse);
  static Where find(const MaterialPattern& material, const mesh::CoarseMesh& coarse);
  static Where find(const CurvePattern& curve, const mesh::CoarseMesh& coarse);

  double size_;
  double growth_;
  Where where_;
};

}  // namespace tessera::sizing

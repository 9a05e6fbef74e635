// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/model/description.hpp"

namespace tessera::testing {

/// @brief Makes a description. Each face has points of its own, as those of CAD files have.
class ModelBuilder {
 public:
  /// @param solids That the face bounds, from 1. @return Its row.
  LocalIndex add_face(std::vector<LocalIndex> solids = {1});
  void add_triangle(LocalIndex face, const Vec3& a, const Vec3& b, const Vec3& c);
  /// @brief Two triangles; the corners in order.
  void add_quad(LocalIndex face, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

  /// @brief A model of one solid, with the volume that the triangles enclose.
  model::ModelDescription finish();
  /// @param volumes Of the solids.
  model::ModelDescription finish(const std::vector<double>& volumes);

 private:
  model::ModelDescription model_{};
  std::map<std::pair<LocalIndex, Vec3>, LocalIndex> points_{};
};

[[nodiscard]] double enclosed_volume(const model::ModelDescription& model);

using Point2 = std::array<double, 2>;

/// @brief A polygon from z = 0 to `height`: a face below, one above, one a side.
/// @param triangles Rows of corners, that cover the polygon. All counter-clockwise.
model::ModelDescription prism(const std::vector<Point2>& corners,
                              const std::vector<std::array<std::size_t, 3>>& triangles,
                              double height);

model::ModelDescription box(double x, double y, double z);

/// @brief An L of side 2, with legs of width 1 and height 1. Volume 3.
model::ModelDescription l_shape();

/// @brief Along z from z = 0, with one round face of n flat sides.
model::ModelDescription cylinder(double radius, double height, int n);

/// @brief Around the z axis, all one face of 2n by n quads.
model::ModelDescription torus(double major, double minor, int n);

/// @brief A rectangle with a round hole; both begin at (0, 0).
struct Cell {
  double side_x = 1.0;
  double side_y = 1.0;
  Point2 hole{0.5, 0.5};
  double radius = 0.25;
};

/// @brief Equal cells beside each other: one face below, one above, one a side, one a hole.
model::ModelDescription plate(int num_x, int num_y, const Cell& cell, double height);

/// @brief Two unit cubes beside each other along x, with a face between them. Sides of both in one
/// plane are one face, as NETGEN describes them.
model::ModelDescription two_cubes();

}  // namespace tessera::testing

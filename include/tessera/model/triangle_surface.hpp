// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/stl_file.hpp"

namespace tessera::model {

/// @brief Closed triangulated surface of one or more bodies: every edge has two triangles, normals
/// point out of the material.
struct TriangleSurface {
  std::vector<double> vertex_xyz{};             ///< Shape (num_vertices, 3), file length unit.
  std::vector<LocalIndex> triangle_vertices{};  ///< Shape (num_triangles, 3).
  std::vector<LocalIndex> triangle_solid{};     ///< Shape (num_triangles); row of solid_names.
  std::vector<LocalIndex> triangle_material{};  ///< Shape (num_triangles); from 1.
  std::vector<std::string> solid_names{};       ///< `solid`s of the file; empty where unnamed.
  std::vector<std::string> material_names{};    ///< Entry m-1 names material m.

  static auto fields(auto& self)
  {
    return std::tie(self.vertex_xyz, self.triangle_vertices, self.triangle_solid,
                    self.triangle_material, self.solid_names, self.material_names);
  }

  /// @throws InputError if the sizes do not match or an index is out of range.
  void require_sound() const;

  [[nodiscard]] LocalIndex num_vertices() const
  {
    return static_cast<LocalIndex>(vertex_xyz.size() / 3);
  }
  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangle_vertices.size() / 3);
  }
  [[nodiscard]] Vec3 position(LocalIndex vertex) const
  {
    return point_at(std::span(vertex_xyz), vertex);
  }
  /// @brief Corners of triangle `t`.
  [[nodiscard]] std::array<Vec3, 3> corners(LocalIndex t) const
  {
    const auto at = 3 * static_cast<std::size_t>(t);
    return {position(triangle_vertices[at]), position(triangle_vertices[at + 1]),
            position(triangle_vertices[at + 2])};
  }
};

/// @brief A surface that passed the checks, and what had to be changed for it, one line each.
struct CheckedSurface {
  TriangleSurface surface{};
  std::vector<std::string> repairs{};
  RepairCounts counted_repairs{};  ///< The same by kind; nothing of it is noted.
};

/// @brief Makes a closed surface of loose triangles.
///
/// - Corners with the same bits become one vertex.
/// - Where that leaves edges open, their vertices are joined if they are within 1e-6 of the box
///   diagonal. Single precision and six printed digits leave equal points that far apart.
/// - Repeated triangles, and those without two different edges, are dropped.
/// - Triangles are turned to agree with their neighbours.
/// - Triangles flatter than 1e-6 of the box diagonal, and folds that enclose nothing, are taken
///   out, where the surface stays closed. A body that is thinner goes with its triangles; the
///   record says where it was.
/// - A shell with its inside out is turned: outermost shells point outwards, shells inside them
///   bound cavities, and so on.
///
/// Each of these is recorded. Nothing is invented: a hole stays an error.
///
/// Outer shells of one `solid` are one material. Local.
/// @param name  What messages call the file.
/// @throws GeometryError naming how many edges have one triangle, or more than two, with the
/// coordinates of the first; also if a shell is one-sided or encloses nothing.
[[nodiscard]] CheckedSurface check_surface(const TriangleSoup& soup, const std::string& name);

/// @brief What check_surface() has before it asks whether edges have two triangles: corners joined,
/// triangles without two different edges and repeated ones dropped, nothing turned. Local.
[[nodiscard]] TriangleSurface welded_surface(const TriangleSoup& soup);

/// @brief Length of the diagonal of the bounding box. Local.
[[nodiscard]] double box_diagonal(const TriangleSurface& surface);

}  // namespace tessera::model

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/cut/cut_tree.hpp"

namespace tessera::cut {

/// Triangle of a face of the model.
struct SurfaceTriangle {
  std::array<LocalIndex, 3> vertices{};  ///< The normal points out of the part.
  LocalIndex face = kNoIndex;            ///< Row of the model's faces.
  LocalIndex neighbour = kNoIndex;       ///< Solid on the other side, from 0; kNoIndex: none.
};

/// Piece of a line along which two faces, a face and a cap, or two caps meet.
struct FeatureEdge {
  std::array<LocalIndex, 2> vertices{};
  std::array<LocalIndex, 2> faces{};  ///< Rows of faces, or labels of caps; the lower one first.
  double size = 0.0;                  ///< What counts as near it: a coarse size, or less.
  /// Node of the plane that draws it from the other side of `faces[0]`; else kNoIndex.
  LocalIndex foreign = kNoIndex;
};

/// Where a plane has cut a solid. It has no triangles: a fan from any point of it to its border,
/// with signs, integrates as its triangles would.
struct Cap {
  Vec3 normal{};                ///< Of the plane, either way.
  LocalIndex label = kNoIndex;  ///< Behind the rows of faces; both sides of a cut have the same.
  bool is_upper = false;        ///< The part is above the plane.
  std::vector<std::array<LocalIndex, 2>> border{};  ///< Closed; to the left of it is the cap.
};

/// Surface of a solid, or of a part of it.
struct PartSurface {
  std::vector<Vec3> points{};
  std::vector<SurfaceTriangle> triangles{};
  std::vector<FeatureEdge> edges{};
  std::vector<Cap> caps{};

  [[nodiscard]] std::vector<double> heights(const Plane& plane) const
  {
    std::vector<double> result(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) result[v] = plane.height(points[v]);
    return result;
  }

  /// @brief Calls visit(a, b, c) for the triangles of the faces, and those of fans of the caps.
  template <class Visit>
  void for_each_triangle(const Visit& visit) const
  {
    for (const SurfaceTriangle& triangle : triangles) {
      visit(triangle.vertices[0], triangle.vertices[1], triangle.vertices[2]);
    }
    for (const Cap& cap : caps) {
      for (const auto& [a, b] : cap.border) visit(cap.border.front()[0], a, b);
    }
  }
};

/// A piece of the line along which a plane meets a cap, or a face between two solids. Who is on the
/// other side of that has it as a line on a border of its own.
struct Trace {
  std::array<Vec3, 2> ends{};
  LocalIndex face = kNoIndex;       ///< Label of the cap, or row of the face.
  bool is_upper = false;            ///< Of a cap: Cap::is_upper of the part that was cut.
  LocalIndex neighbour = kNoIndex;  ///< Of a face: the solid on the other side.
};

/// The two sides of a cut, and its lines on what others share with the part.
struct CutSides {
  PartSurface below{};
  PartSurface above{};
  std::vector<Trace> traces{};
};

/// @brief Cuts a part. @param label Of the new cap. @param size FeatureEdge::size of its border.
[[nodiscard]] CutSides cut_part(const PartSurface& part, const Plane& plane, LocalIndex label,
                                double size);

}  // namespace tessera::cut

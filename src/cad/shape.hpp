// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include <TopAbs_ShapeEnum.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

#include "tessera/base/vec3.hpp"

namespace tessera::cad {

[[nodiscard]] inline gp_Pnt to_occ(const Vec3& p) { return {p[0], p[1], p[2]}; }
[[nodiscard]] inline Vec3 from_occ(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

/// @brief The different parts of a kind, in the order of TopExp::MapShapes: the numbering of
/// surfaces (faces) and curves (edges).
[[nodiscard]] std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind);

/// @brief How many different parts of a kind there are.
[[nodiscard]] int count_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind);

/// @brief Diagonal of the bounding box, from the geometry alone: a triangulation that a mesher left
/// on the shape does not change it.
[[nodiscard]] double box_diagonal_of(const TopoDS_Shape& shape);

/// @brief Of what its faces enclose; negative if they look inwards.
[[nodiscard]] double volume_of(const TopoDS_Shape& shape);

/// @brief Volume and area of triangles, which are kept for the next who asks.
struct RoughFigures {
  double volume = 0.0;  ///< Negative if faces look inwards.
  double area = 0.0;
  double deflection = 0.0;  ///< How far the triangles may be off the faces.

  static auto fields(auto& self) { return std::tie(self.volume, self.area, self.deflection); }
};

/// @brief Takes a fraction of the time that integrals over free-form faces take. A face that gets
/// no triangles has its integral.
/// @param[in] diagonal  What triangles are fine for: of the box of the model.
[[nodiscard]] RoughFigures rough_figures_of(const TopoDS_Shape& shape, double diagonal);

/// @brief Whether pieces of a solid have its volume, to a ten thousandth. Local.
[[nodiscard]] bool have_volume_of(const std::vector<TopoDS_Shape>& pieces,
                                  const TopoDS_Shape& solid);

/// @brief Of an edge.
[[nodiscard]] double length_of(const TopoDS_Shape& edge);

/// @brief Of all its faces.
[[nodiscard]] double area_of(const TopoDS_Shape& shape);

/// @brief Whether it has shells, and each is closed, but those of faces inside of it.
[[nodiscard]] bool is_closed(const TopoDS_Shape& solid);

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/cut/cut_tree.hpp"

namespace tessera::cad {

/// @brief The parts of a shape. Faces between two of them are shared.
struct CutShape {
  TopoDS_Shape shape{};             ///< A compound of solids, part by part.
  std::vector<LocalIndex> solid{};  ///< By solid of TopExp_Explorer: that of the uncut shape.
  std::vector<LocalIndex> part{};   ///< By solid; several may be of one part.
  /// Faces and edges that are of one of the uncut shape: its number there, from 0. Others are new.
  TopTools_DataMapOfShapeInteger faces{};
  TopTools_DataMapOfShapeInteger edges{};

  /// @brief Number of the uncut face or edge; kNoIndex for a new one. Local.
  [[nodiscard]] static LocalIndex number_in(const TopTools_DataMapOfShapeInteger& map,
                                            const TopoDS_Shape& shape);
};

/// @brief Cuts the solids of a shape; the shape stays as it was.
/// @throws NetgenError if OpenCASCADE fails, or what it made is not valid or has lost volume.
[[nodiscard]] CutShape cut_shape(const TopoDS_Shape& uncut, const cut::CutTree& tree);

/// @brief The same with faces as tools, those of each solid; all pieces are of part 0.
[[nodiscard]] CutShape cut_at_faces(const TopoDS_Shape& uncut,
                                    std::vector<TopTools_ListOfShape> tools);

/// @brief A plane where it crosses the box of a shape, and a little more. `normal`: of length 1.
[[nodiscard]] TopoDS_Face plane_face(const Vec3& point, const Vec3& normal,
                                     const TopoDS_Shape& through);

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tessera/model/triangle_surface.hpp"

namespace tessera::cad {

/// @brief A face as one of a cell's; turned if the face's triangles look into the cell.
struct CellSide {
  std::size_t face = 0;
  bool is_turned = false;
};

/// @brief Bounded parts of space, and the plane faces between them and around them.
struct Cells {
  std::vector<std::vector<std::array<Vec3, 3>>> face_triangles{};
  std::vector<std::vector<CellSide>> sides{};  ///< Of each cell.
};

/// @brief A face's triangles as they look out of the cell.
[[nodiscard]] std::vector<std::array<Vec3, 3>> triangles_of(const Cells& cells,
                                                            const CellSide& side);

/// @brief All triangles of a cell, looking out of it.
[[nodiscard]] std::vector<std::array<Vec3, 3>> skin_of(const Cells& cells, std::size_t cell);

/// @brief What a surface parts space into, by OpenCASCADE: the surface may touch and cut itself,
/// and what is nearer than `tolerance` is one. Triangles in one plane become one face before, as
/// narrow ones that lie on each other are more than OpenCASCADE can do. Local.
/// @return No cells if that fails.
/// @throws Standard_Failure as OpenCASCADE does.
[[nodiscard]] Cells cells_of(const model::TriangleSurface& surface, double tolerance);

}  // namespace tessera::cad

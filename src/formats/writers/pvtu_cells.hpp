// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "formats/writer.hpp"

namespace tessera::formats {

/// @brief cells.pvtu and cells/piece_000000.vtu, …: the pieces with the triangles on the geometry
/// as cells among the tets, as GEOS wants them. "attribute" is the material of a tet; of a triangle
/// it is its patch, counted on behind the materials. Points have the numbers of the other formats.
[[nodiscard]] std::unique_ptr<Writer> make_pvtu_cells_writer(const WriterTarget& target);

}  // namespace tessera::formats

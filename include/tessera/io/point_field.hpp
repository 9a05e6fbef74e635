// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "tessera/mesh/point_field.hpp"

namespace tessera::io {

/// @brief Reads one point array of a .vtu, .pvtu or .vti of any tool, and where its values are.
/// Local. A build without VTK cannot read compressed arrays.
///
/// - .vtu, .pvtu: cells with a volume become tets between their corners; of cells of higher order
///   only the corners count. Sides of two cells with the same points are cut alike. Other cells are
///   left out. Pieces have points of their own.
/// - .vti: all pieces of the file together. The grid may be turned.
///
/// Values are as they stand in the file: they may be anything, also NaN.
/// @throws InputError naming the file and what is wrong: missing, of another kind, cut off,
/// corrupt, without a cell that has a volume, without that array (with those that there are).
[[nodiscard]] mesh::PointField read_point_field(const std::filesystem::path& path,
                                                const std::string& array);

}  // namespace tessera::io

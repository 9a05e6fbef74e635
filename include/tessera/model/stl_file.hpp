// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::model {

/// @brief What an STL file says: loose triangles, each with its three corners. Nothing is checked
/// but that the coordinates are finite; the normals of the file are not kept, they are often wrong.
struct TriangleSoup {
  std::vector<double> corner_xyz{};          ///< Shape (num_triangles, 3, 3), file length unit.
  std::vector<LocalIndex> triangle_solid{};  ///< Shape (num_triangles); row of solid_names.
  std::vector<std::string> solid_names{};    ///< One per `solid`; empty if the file gives no name.

  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangle_solid.size());
  }
};

/// @brief Reads an ASCII or a binary STL file. Local.
///
/// The size that the binary header promises tells which of the two it is. The word `solid` does
/// not: many binary files begin with it as well. No number in the file is trusted for an
/// allocation. The reader is our own, because NETGEN's dies of inconsistent triangles.
/// @throws InputError naming the file and the line (ASCII) or offset (binary): missing, empty,
/// truncated, not an STL file, a coordinate that is not a finite number.
[[nodiscard]] TriangleSoup read_stl(const std::filesystem::path& file);

}  // namespace tessera::model

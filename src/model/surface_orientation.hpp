// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tessera/model/triangle_surface.hpp"

namespace tessera::model {

/// @brief A connected closed part of a surface, as a shell of material or around a cavity.
struct Shell {
  std::vector<LocalIndex> triangles{};  ///< Ascending.
  LocalIndex depth = 0;                 ///< How many other shells it lies in; odd: a cavity.
  LocalIndex parent = kNoIndex;         ///< The innermost of those; the last in file order of them.
};

struct Orientation {
  std::vector<Shell> shells{};       ///< In the order of their first triangles.
  LocalIndex num_turned = 0;         ///< Single triangles turned to agree with their neighbours.
  LocalIndex num_turned_shells = 0;  ///< Shells turned as a whole.
};

/// @brief Turns triangles so that normals point out of the material, and tells the shells.
/// @param opposite  Of opposite_half_edges(), for the surface as it comes in.
/// @throws GeometryError if a shell is one-sided or encloses no volume; `name` begins the message.
Orientation orient(TriangleSurface& surface, std::span<const LocalIndex> opposite,
                   const std::string& name);

}  // namespace tessera::model

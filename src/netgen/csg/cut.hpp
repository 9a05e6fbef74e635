// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <csg.hpp>
#include <meshing.hpp>

#include "tessera/base/types.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {

/// @brief What the top-level objects of a cut geometry were before. Rows of both arrays are
/// top-level objects, domains less 1.
struct CutObjects {
  std::vector<LocalIndex> solid{};  ///< Top-level object of the uncut geometry, from 0.
  std::vector<LocalIndex> part{};   ///< Of the tree; kNoIndex: a surface.
  LocalIndex num_surfaces = 0;      ///< Of the uncut geometry; planes of cuts come after them.
};

struct CutGeometry {
  std::unique_ptr<::netgen::CSGeometry> geometry{};
  CutObjects objects{};
};

/// @brief Geometry of a file whose solids to be meshed are replaced by their parts. Planes come
/// after all surfaces, so surfaces keep their numbers. Local.
/// @param[in] uncut Geometry of the text.
/// @throws NetgenError if the geometry identifies faces or has singular ones: these are told by
/// the numbers of its solids.
[[nodiscard]] CutGeometry cut_geometry(const ::netgen::CSGeometry& uncut, const std::string& text,
                                       const std::string& file_name, const cut::CutTree& tree);

}  // namespace tessera::netgen

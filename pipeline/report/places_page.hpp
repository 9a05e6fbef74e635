// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/surface/places.hpp"

#include "pipeline/drawing/png.hpp"

/// For people: where the triangles of an STL file bound no body. All functions are Local.
namespace tessera::pipeline {

/// @brief "edges with one triangle: 3, edges with …: 1"; empty if there is no place.
[[nodiscard]] std::string places_text(const surface::SurfacePlaces& places);

/// @brief The triangles of the file, with cell arrays `open_edges`, `crowded_edges` and
/// `crossings`: how many of them are at each.
[[nodiscard]] mesh::MeshArrays places_arrays(const surface::SurfacePlaces& places);

/// @brief The file from two opposite sides; triangles at places have another colour than the
/// others, and marks stand at some hundred places. Numbers are those of the page's legend.
[[nodiscard]] Picture places_picture(const surface::SurfacePlaces& places);

/// @brief A page with that picture, a view to turn with marks, and the first places with their
/// coordinates.
/// @param[in] message Why the file is refused.
[[nodiscard]] std::string places_page(const std::filesystem::path& file, const std::string& message,
                                      const surface::SurfacePlaces& places);

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/types.hpp"
#include "tessera/coarse/coarse_surface.hpp"
#include "tessera/model/model.hpp"

namespace tessera::netgen {

/// @brief Corners of one of NETGEN's tets, as indices into it, in positive VTK order.
///
/// NETGEN numbers a tet with negative determinant. This is the one place that says how to turn it.
inline constexpr std::array<int, 4> kNetgenTetOrder{0, 1, 3, 2};

/// @brief What a format knows of the entities of a NETGEN mesh of it. Empty functions: no such
/// data.
struct GeometryNumbers {
  /// Model's surface number of a face descriptor. Required.
  std::function<LocalIndex(const ::netgen::FaceDescriptor&)> surface{};
  /// Name of a patch in the file; empty text: none, "patch_N" is used, N from 1.
  std::function<std::string(const ::netgen::FaceDescriptor&)> patch_name{};
  /// Model's curve number of a segment, kNoIndex to leave the segment out. Without it: no segments.
  std::function<LocalIndex(const ::netgen::Segment&)> curve{};
  /// Name of a domain (from 1) in the file; empty text: none, "material_N" is used.
  std::function<std::string(int)> material_name{};
  /// Largest edge that the file wants in a domain (from 1), file length unit.
  std::function<double(int)> max_size{};
  /// Parameters of corner 0…2 of a surface element; it has the surface number given.
  std::function<model::SurfaceParameters(const ::netgen::Element2d&, int corner)> uv{};
  /// Parameter of end 0 or 1 of a segment.
  std::function<double(const ::netgen::Segment&, int end)> t{};
};

/// @brief NETGEN's surface mesh as a coarse surface: from 0, all vertices, one patch a face
/// descriptor that has triangles.
/// @param[in] what     Put before an error: which mesh.
/// @param[in] max_size Largest edge in domains for which the file wants no smaller one.
/// @throws NetgenError if it has other elements than triangles, or encloses nothing.
[[nodiscard]] coarse::CoarseSurface to_coarse_surface(const ::netgen::Mesh& from,
                                                      const GeometryNumbers& numbers,
                                                      double max_size, const std::string& what);

/// @brief The name of a patch, from the file's; empty: "patch_N", N from 1. Local.
[[nodiscard]] std::string patch_name(const std::string& name_in_file, LocalIndex number);

/// @brief Adds the materials that the patches' domains ask for. Local.
/// @param[in] name May be empty, and give empty texts: "material_N".
void add_materials(coarse::CoarseSurface& surface, double max_size,
                   const std::function<std::string(LocalIndex)>& name);

/// @brief Adds tets of ours, corners as rows of vertices, all of one domain. Local.
void add_tets(::netgen::Mesh& mesh, const std::vector<LocalIndex>& tet_vertices, int domain = 1);

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/types.hpp"
#include "tessera/coarse/fit_to_cad.hpp"
#include "tessera/model/model.hpp"
#include "tessera/surface/coarse_surface.hpp"

namespace tessera::netgen {

/// @brief Corners of one of NETGEN's tets, as indices into it, in positive VTK order.
///
/// NETGEN numbers a tet with negative determinant. This is the one place that says how to turn it.
inline constexpr std::array<int, 4> kNetgenTetOrder{0, 1, 3, 2};

/// @brief What tells one patch from another, and in which order patches come: a surface, and more
/// where one surface has several.
using PatchKey = std::array<LocalIndex, 3>;

/// @brief What a format knows of the entities of a NETGEN mesh of it. Empty functions: no such
/// data.
struct GeometryNumbers {
  /// Model's surface number of a face descriptor. Required.
  std::function<LocalIndex(const ::netgen::FaceDescriptor&)> surface{};
  /// Name of a patch in the file; empty text: none, "patch_N" is used, N from 1.
  std::function<std::string(const ::netgen::FaceDescriptor&)> patch_name{};
  /// Model's curve number of a segment, kNoIndex: it is on none. Without it: no segments.
  std::function<LocalIndex(const ::netgen::Segment&)> curve{};
  /// Name of a material (from 1) in the file; empty text: none, "material_N" is used.
  std::function<std::string(LocalIndex)> material_name{};
  /// Material of a domain (both from 1), if domains are parts of materials: faces between two of
  /// one material are cuts. Without it: each domain is a material.
  std::function<LocalIndex(int)> material{};
  /// Part of the CutTree that a domain (from 1) is, if it is one.
  std::function<LocalIndex(int)> part{};
  /// Descriptors with one key make one patch. Without it: each descriptor is a patch.
  std::function<PatchKey(const ::netgen::FaceDescriptor&)> patch{};
  /// Largest edge that the file wants in a domain (from 1), file length unit.
  std::function<double(int)> max_size{};
  /// Parameters of corner 0…2 of a surface element; it has the surface number given.
  std::function<model::SurfaceParameters(const ::netgen::Element2d&, int corner)> uv{};
  /// Parameter of end 0 or 1 of a segment.
  std::function<double(const ::netgen::Segment&, int end)> t{};
};

/// @brief NETGEN's surface mesh as a coarse surface: from 0, all vertices, one patch a face
/// descriptor that has triangles, unless `numbers` says otherwise.
/// @param[in] max_size Largest edge in domains for which the file wants no smaller one.
/// @param[in] what     Put before an error: which mesh.
/// @throws NetgenError if it has other elements than triangles, or encloses nothing.
[[nodiscard]] surface::CoarseSurface to_coarse_surface(const ::netgen::Mesh& from,
                                                       const GeometryNumbers& numbers,
                                                       double max_size, const std::string& what);

/// @brief Adds tets of ours, corners as rows of vertices, all of one domain. Local.
void add_tets(::netgen::Mesh& mesh, const std::vector<LocalIndex>& tet_vertices, int domain = 1);

/// @brief The triangles of a NETGEN surface mesh, one patch a face descriptor that has some,
/// without size and names of solids.
/// @param[in] numbers With numbers of curves.
[[nodiscard]] coarse::CadSurface surface_of_mesh(const ::netgen::Mesh& from,
                                                 const GeometryNumbers& numbers);

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>

#include <meshing.hpp>

#include "tessera/base/types.hpp"
#include "tessera/coarse/fit_to_cad.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
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
  /// Parameters of corner 0…2 of a surface element; it has the surface number given.
  std::function<model::SurfaceParameters(const ::netgen::Element2d&, int corner)> uv{};
  /// Parameter of end 0 or 1 of a segment.
  std::function<double(const ::netgen::Segment&, int end)> t{};
};

/// @brief NETGEN's mesh as a coarse mesh: from 0, tets positive, only vertices of tets kept, one
/// patch a face descriptor that has triangles.
///
/// A segment with an end that is no vertex of a tet is left out: it bounds nothing.
/// @param[in] what Put before an error: which mesh.
/// @throws NetgenError if it has no tets, other elements than tets and triangles, or breaks what
/// mesh::validate() asks.
[[nodiscard]] mesh::CoarseMesh to_coarse_mesh(const ::netgen::Mesh& from,
                                              const GeometryNumbers& numbers,
                                              const std::string& what);

/// @brief The triangles of a NETGEN surface mesh, one patch a face descriptor that has some,
/// without size and names of solids.
/// @param[in] numbers With numbers of curves.
[[nodiscard]] coarse::CadSurface surface_of_mesh(const ::netgen::Mesh& from,
                                                 const GeometryNumbers& numbers);

}  // namespace tessera::netgen

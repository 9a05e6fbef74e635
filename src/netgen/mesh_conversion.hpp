// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/types.hpp"
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
  /// Name of a material (from 1) in the file; empty text: none, "material_N" is used.
  std::function<std::string(LocalIndex)> material_name{};
  /// Material of a domain (both from 1), if domains are parts of materials: faces between two of
  /// one material are left out, and so are their segments. Without it: each domain is a material.
  std::function<LocalIndex(int)> material{};
  /// Descriptors with one value make one patch; patches are in the order of these values. Without
  /// it: each descriptor is a patch.
  std::function<LocalIndex(const ::netgen::FaceDescriptor&)> patch{};
  /// Parameters of corner 0…2 of a surface element; it has the surface number given.
  std::function<model::SurfaceParameters(const ::netgen::Element2d&, int corner)> uv{};
  /// Parameter of end 0 or 1 of a segment.
  std::function<double(const ::netgen::Segment&, int end)> t{};
};

/// @brief Name of a patch (from 0) to which the file gives none.
[[nodiscard]] std::string default_patch_name(LocalIndex patch);

/// @brief A coarse mesh with the domains of NETGEN that its tets come from.
struct DomainMesh {
  mesh::CoarseMesh mesh{};
  std::vector<LocalIndex> tet_domain{};  ///< Shape (num_tets); from 1.
};

/// @brief NETGEN's mesh as a coarse mesh: from 0, tets positive, only vertices of tets kept, one
/// patch a face descriptor that has triangles, unless `numbers` says otherwise.
///
/// A segment with an end that is no vertex of a tet is left out: it bounds nothing.
/// @param[in] what Put before an error: which mesh.
/// @throws NetgenError if it has no tets, other elements than tets and triangles, or breaks what
/// mesh::validate() asks.
[[nodiscard]] DomainMesh to_domain_mesh(const ::netgen::Mesh& from, const GeometryNumbers& numbers,
                                        const std::string& what);

/// @brief to_domain_mesh() without the domains.
[[nodiscard]] mesh::CoarseMesh to_coarse_mesh(const ::netgen::Mesh& from,
                                              const GeometryNumbers& numbers,
                                              const std::string& what);

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/cut/cut_mesh.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/surface/defeature.hpp"

namespace tessera::surface {

/// @brief The coarse mesh before it has tets: triangles that enclose *domains*, each to be filled
/// for itself. A domain is a material, or a part of one; cuts between parts are no patch. A mesh
/// that is filled already has no domains.
struct CoarseSurface {
  mesh::CoarseMesh
      mesh{};  ///< Without the tets of domains. Vertices may be of no face. Faces of cuts have the
               ///< patch kNoIndex, and segments that only bound these such a curve.

  /// Shape (num_faces, 2): the domain that the normal of a face points out of, and the one it
  /// points into; from 1, 0: none.
  std::vector<std::array<LocalIndex, 2>> face_domains{};

  std::vector<LocalIndex> domain_material{};  ///< Shape (num_domains); from 1.
  std::vector<LocalIndex> domain_part{};      ///< Shape (num_domains), of a CutTree; or empty.
  std::vector<double> domain_max_size{};  ///< Shape (num_domains): largest edge, file length unit.
  Defeatured defeatured{};                ///< What of the model was merged, file length unit.

  static auto fields(auto& self)
  {
    return std::tie(self.mesh, self.face_domains, self.domain_material, self.domain_part,
                    self.domain_max_size, self.defeatured);
  }

  [[nodiscard]] LocalIndex num_domains() const
  {
    return static_cast<LocalIndex>(domain_max_size.size());
  }
};

/// @brief The closed surface of one domain.
struct DomainSkin {
  std::vector<LocalIndex> vertex{};             ///< Shape (num_vertices): row of the mesh's.
  std::vector<double> vertex_xyz{};             ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> triangle_vertices{};  ///< Shape (num_triangles, 3); normals point out.
  std::vector<LocalIndex> triangle_patch{};     ///< Shape (num_triangles); those of cuts come last.
  std::vector<LocalIndex> edge_vertices{};      ///< Shape (num_edges, 2): those on curves.
  double max_size = 0.0;                        ///< Largest edge, file length unit, > 0.
  Box model_box{};                              ///< Around all skins.
  bool is_hole = false;                         ///< In a domain that can also be filled otherwise.

  static auto fields(auto& self)
  {
    return std::tie(self.vertex, self.vertex_xyz, self.triangle_vertices, self.triangle_patch,
                    self.edge_vertices, self.max_size, self.model_box, self.is_hole);
  }
};

/// @brief Tets that fill a DomainSkin. Its vertices come first, in their places.
struct DomainTets {
  std::vector<double> vertex_xyz{};        ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive, VTK's order.

  static auto fields(auto& self) { return std::tie(self.vertex_xyz, self.tet_vertices); }
};

/// @brief The faces that bound domain `domain`, from 1, ascending. Local.
[[nodiscard]] std::vector<LocalIndex> faces_of(const CoarseSurface& surface, LocalIndex domain);

/// @brief The skin of domain `domain`, from 1: triangles in the order of faces_of(). Local; empty
/// if no face bounds it.
[[nodiscard]] DomainSkin skin_of(const CoarseSurface& surface, LocalIndex domain);

/// @brief How many tets a domain will have at least, by its triangles and its largest edge. Local.
[[nodiscard]] double predicted_tets(const DomainSkin& skin);

/// @brief The coarse mesh: the surface with the tets of all domains, without its cuts. Vertices
/// that no tet has are dropped, and segments with them.
/// @param[in] tets  Those of every domain, in their order.
/// @return Also the parts of the tets, if domains are parts.
/// @note Local. The result is not validated, since callers go on to change it. @throws MeshError if
/// there are no tets.
[[nodiscard]] cut::CutMesh fill_surface(CoarseSurface surface, const std::vector<DomainTets>& tets);

}  // namespace tessera::surface

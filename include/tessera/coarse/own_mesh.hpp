// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/tet_mesh_file.hpp"

namespace tessera::coarse {

/// @brief A mesh that a user brings, checked and complete.
struct OwnMesh {
  /// Its patches are the tags of the file; a patch is a surface of its own. No segments, no
  /// parameters. File length unit.
  mesh::CoarseMesh mesh{};
  std::vector<std::int32_t> patch_entity{};  ///< What the file calls the entity; 0: unknown.
  std::vector<char> patch_is_named{};     ///< Shape (num_patches); whether the file has the name.
  std::vector<char> material_is_named{};  ///< Shape (num_materials), likewise.
  /// Shape (num_faces). Entry 0: the material that the face is seen from outside of; entry 1: the
  /// other one, higher, or 0: none.
  std::vector<std::array<LocalIndex, 2>> face_materials{};
  std::vector<std::string> repairs{};  ///< What was changed or made up, one line each.

  static auto fields(auto& self)
  {
    return std::tie(self.mesh, self.patch_entity, self.patch_is_named, self.material_is_named,
                    self.face_materials, self.repairs);
  }

  /// @throws InputError if the parts do not fit together.
  void require_sound() const;
};

/// @brief Makes a coarse mesh of what a mesh file has. Local; a pure function.
///
/// - Points with the same coordinates become one. Points of no tet go.
/// - Tets that stand twice, as in two groups, count once. If all are inside out, all are turned.
/// - Materials are the groups of the tets, or, where no tet has a group, their entities.
/// - Patches are groups and entities of the triangles. Patches of one group have one row. Triangles
///   that are missing outside and between materials are made up. Those make patches by feature
///   angle. Triangles inside of one material are left out.
///
/// @param[in] name What messages call the file.
/// @param[in] feature_angle_deg Angle between normals from which an edge separates patches, in
/// (0, 180).
/// @throws InputError naming the file, the number of the element or point, and its place: no tets,
/// a tet that is flat or inside out, one with a corner twice, a triangle that is no tet's face,
/// three tets at one triangle, tets that meet without sharing their faces.
[[nodiscard]] OwnMesh make_own_mesh(const model::TetMeshFile& file, const std::string& name,
                                    double feature_angle_deg);

}  // namespace tessera::coarse

// SPDX-License-Identifier: BSD-3-Clause
#include "topology/add_patch.hpp"

#include <string>

namespace tessera::topology {

LocalIndex add_patch(mesh::CoarseMesh& mesh, LocalIndex like)
{
  mesh.patch_names.push_back(std::string(mesh.patch_names[at(like)]));
  mesh.patch_surface.push_back(LocalIndex{mesh.patch_surface[at(like)]});
  mesh.images.patch_origin.push_back(kNoIndex);
  mesh.images.patch_transform.push_back(0);
  mesh.images.patch_is_joint.push_back(0);
  if (!mesh.patch_row.empty()) mesh.patch_row.push_back(LocalIndex{mesh.patch_row[at(like)]});
  if (!mesh.patch_is_inside.empty()) mesh.patch_is_inside.push_back(0);
  if (!mesh.layers.are_none()) mesh.layers.patch_is_wall.push_back(0);
  return mesh.num_patches() - 1;
}

}  // namespace tessera::topology

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/patches.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "tessera/base/union_find.hpp"

namespace tessera::netgen {

PatchKey key_of_patch(LocalIndex surface, LocalIndex solid, LocalIndex other)
{
  const auto [low, high] = std::minmax(solid, other);
  return {surface, low, high};
}

void separate_patches(mesh::CoarseMesh& mesh)
{
  std::map<std::array<LocalIndex, 2>, LocalIndex> corners;  // Patch and vertex to a number.
  UnionFind pieces;
  const auto number = [&](LocalIndex f, std::size_t corner) {
    const std::array<LocalIndex, 2> key{mesh.face_patch[at(f)],
                                        mesh.face_vertices[3 * at(f) + corner]};
    const auto [found, is_new] = corners.emplace(key, static_cast<LocalIndex>(corners.size()));
    if (is_new) pieces.add();
    return found->second;
  };
  const auto is_cut = [&](LocalIndex f) { return mesh.face_patch[at(f)] == kNoIndex; };
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    if (is_cut(f)) continue;
    for (std::size_t corner = 1; corner < 3; ++corner) pieces.join(number(f, 0), number(f, corner));
  }
  std::map<LocalIndex, LocalIndex> patch_of_piece;
  std::vector<bool> is_taken(at(mesh.num_patches()), false);
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    if (is_cut(f)) continue;
    LocalIndex& patch = mesh.face_patch[at(f)];
    const auto [found, is_new] = patch_of_piece.emplace(pieces.find(number(f, 0)), patch);
    if (is_new && is_taken[at(patch)]) {
      found->second = mesh.num_patches();
      mesh.patch_names.push_back(mesh.patch_names[at(patch)]);
      mesh.patch_surface.push_back(mesh.patch_surface[at(patch)]);
    }
    is_taken[at(patch)] = true;
    patch = found->second;
  }
}

}  // namespace tessera::netgen

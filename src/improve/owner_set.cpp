// SPDX-License-Identifier: BSD-3-Clause
#include "improve/owner_set.hpp"

namespace tessera::improve {
namespace {

// A boundary triangle with no tet of the region's pieces in front of it may lie on the geometry.
// Such triangles stay in their pieces.
std::vector<OwnerSet> owners_behind(const RegionMesh& mesh)
{
  std::vector<OwnerSet> owners(at(mesh.num_triangles()), all_owners(mesh));
  for (LocalIndex i = 0; i < mesh.num_triangles(); ++i) {
    if (mesh.triangle_outside[at(i)] == kNoIndex) owners[at(i)] = only(mesh.triangle_owner[at(i)]);
  }
  return owners;
}

}  // namespace

OwnerSet all_owners(const RegionMesh& mesh)
{
  return ~OwnerSet{0} >> (kMaxOwners - mesh.subdomains.size());
}

std::vector<OwnerSet> holders_of_fixed(const RegionMesh& mesh)
{
  std::vector<OwnerSet> holders(at(mesh.num_fixed()), 0);
  for (LocalIndex v = 0; v < mesh.num_fixed(); ++v) {
    for (const PieceVertex& place : mesh.places_of(v)) holders[at(v)] |= only(place.owner);
  }
  return holders;
}

std::vector<OwnerSet> allowed_owners(const RegionMesh& mesh, const TetMesh& tets,
                                     const std::vector<LocalIndex>& triangle_tet)
{
  const std::vector<OwnerSet> holders = holders_of_fixed(mesh);
  const std::vector<OwnerSet> behind = owners_behind(mesh);
  std::vector<OwnerSet> allowed(tets.tet_vertices.size() / 4, all_owners(mesh));
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    const std::size_t v = at(tets.tet_vertices[i]);
    if (v < holders.size()) allowed[i / 4] &= holders[v];
  }
  for (std::size_t i = 0; i < triangle_tet.size(); ++i) allowed[at(triangle_tet[i])] &= behind[i];
  return allowed;
}

}  // namespace tessera::improve

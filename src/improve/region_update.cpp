// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/region_update.hpp"

#include <algorithm>
#include <utility>

#include "improve/make_update.hpp"

namespace tessera::improve {
namespace {

// How many owners use each free vertex: kShared stands for several.
constexpr LocalIndex kShared = -2;

std::vector<LocalIndex> users_of(const TetMesh& tets, const std::vector<LocalIndex>& owners)
{
  std::vector<LocalIndex> user(tets.vertex_xyz.size() / 3, kNoIndex);
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    LocalIndex& here = user[at(tets.tet_vertices[i])];
    const LocalIndex owner = owners[i / 4];
    here = here == kNoIndex || here == owner ? owner : kShared;
  }
  return user;
}

LocalIndex vertex_in_piece(const RegionMesh& mesh, LocalIndex fixed_vertex, LocalIndex owner)
{
  const auto places = mesh.places_of(fixed_vertex);
  return std::find_if(places.begin(), places.end(),
                      [&](const PieceVertex& place) { return place.owner == owner; })
      ->vertex;
}

// One owner's tets, with their new vertices: shared ones first.
PieceUpdate update_of(LocalIndex owner, const RegionMesh& mesh, const TetMesh& tets,
                      const std::vector<LocalIndex>& owners, const std::vector<LocalIndex>& user)
{
  PieceUpdate update{.region = mesh.region, .host = mesh.host};
  std::vector<char> is_used(user.size(), 0);
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    if (owners[i / 4] == owner) is_used[at(tets.tet_vertices[i])] = 1;
  }
  std::vector<LocalIndex> number(user.size(), kNoIndex);
  for (const bool wants_shared : {true, false}) {
    LocalIndex index = 0;  // Within the host.
    for (std::size_t v = at(mesh.num_fixed()); v < user.size(); ++v) {
      if ((user[v] == kShared) != wants_shared) continue;
      if (is_used[v] != 0) {
        number[v] = update.num_new_vertices();
        update.vertex_xyz.insert(update.vertex_xyz.end(), &tets.vertex_xyz[3 * v],
                                 tets.vertex_xyz.data() + 3 * v + 3);
        if (wants_shared) update.shared_index.push_back(index);
      }
      ++index;
    }
  }
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    if (owners[i / 4] != owner) continue;
    const LocalIndex v = tets.tet_vertices[i];
    update.tet_vertices.push_back(v < mesh.num_fixed() ? vertex_in_piece(mesh, v, owner)
                                                       : -1 - number[at(v)]);
  }
  return update;
}

}  // namespace

std::vector<PieceUpdate> make_updates(const RegionMesh& mesh, const TetMesh& tets,
                                      const std::vector<LocalIndex>& owners)
{
  const std::vector<LocalIndex> user = users_of(tets, owners);
  std::vector<PieceUpdate> updates;
  for (LocalIndex owner = 0; owner < mesh.num_owners(); ++owner) {
    updates.push_back(update_of(owner, mesh, tets, owners, user));
  }
  return updates;
}

}  // namespace tessera::improve

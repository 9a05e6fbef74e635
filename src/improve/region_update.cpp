// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/region_update.hpp"

#include <algorithm>
#include <utility>

#include "improve/make_update.hpp"

namespace tessera::improve {
namespace {

enum class Use : char { nobody, one_owner, shared };

// Numbers of the free vertices as new vertices of the update: shared ones first.
std::vector<LocalIndex> number_new_vertices(const TetMesh& tets, LocalIndex num_fixed,
                                            const std::vector<LocalIndex>& owners,
                                            RegionUpdate& update)
{
  const std::size_t num_vertices = tets.vertex_xyz.size() / 3;
  std::vector<Use> use(num_vertices, Use::nobody);
  std::vector<LocalIndex> user(num_vertices, kNoIndex);
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    const std::size_t v = at(tets.tet_vertices[i]);
    const LocalIndex owner = owners[i / 4];
    if (use[v] == Use::nobody) {
      use[v] = Use::one_owner;
      user[v] = owner;
    } else if (user[v] != owner) {
      use[v] = Use::shared;
    }
  }
  std::vector<LocalIndex> number(num_vertices, kNoIndex);
  const auto take = [&](Use wanted) {
    for (std::size_t v = at(num_fixed); v < num_vertices; ++v) {
      if (use[v] != wanted) continue;
      number[v] = update.num_new_vertices();
      update.vertex_xyz.insert(update.vertex_xyz.end(), &tets.vertex_xyz[3 * v],
                               tets.vertex_xyz.data() + 3 * v + 3);
    }
  };
  take(Use::shared);
  update.num_shared = update.num_new_vertices();
  take(Use::one_owner);
  return number;
}

LocalIndex vertex_in_piece(const RegionMesh& mesh, LocalIndex fixed_vertex, LocalIndex owner)
{
  const auto places = mesh.places_of(fixed_vertex);
  return std::find_if(places.begin(), places.end(),
                      [&](const PieceVertex& place) { return place.owner == owner; })
      ->vertex;
}

}  // namespace

RegionUpdate make_update(const RegionMesh& mesh, const TetMesh& tets,
                         const std::vector<LocalIndex>& owners)
{
  RegionUpdate update{.region = mesh.region, .host = mesh.host, .subdomains = mesh.subdomains};
  const std::vector<LocalIndex> new_number =
      number_new_vertices(tets, mesh.num_fixed(), owners, update);
  update.tet_offsets.push_back(0);
  for (LocalIndex owner = 0; owner < mesh.num_owners(); ++owner) {
    for (std::size_t t = 0; t < owners.size(); ++t) {
      if (owners[t] != owner) continue;
      for (std::size_t c = 0; c < 4; ++c) {
        const LocalIndex v = tets.tet_vertices[4 * t + c];
        update.tet_vertices.push_back(v < mesh.num_fixed() ? vertex_in_piece(mesh, v, owner)
                                                           : -1 - new_number[at(v)]);
      }
    }
    update.tet_offsets.push_back(static_cast<LocalIndex>(update.tet_vertices.size() / 4));
  }
  return update;
}

}  // namespace tessera::improve

// SPDX-License-Identifier: BSD-3-Clause
#include "distributed_meshes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::testing {
namespace {

constexpr GlobalIndex kFirstId = GlobalIndex{1} << 33;
constexpr GlobalIndex kIdStep = 7;

GlobalIndex id_of(LocalIndex number) { return kFirstId + kIdStep * number; }

std::vector<std::set<Rank>> ranks_of_vertices(const mesh::CoarseMesh& mesh,
                                              std::span<const Rank> tet_rank)
{
  std::vector<std::set<Rank>> ranks(at(mesh.num_vertices()));
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    for (const LocalIndex v : mesh.tet(t)) ranks[at(v)].insert(tet_rank[at(t)]);
  }
  return ranks;
}

void add_vertices(const mesh::CoarseMesh& mesh, std::span<const Rank> tet_rank, Rank rank,
                  migrate::DistributedMesh& share)
{
  const auto ranks = ranks_of_vertices(mesh, tet_rank);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (!ranks[at(v)].contains(rank)) continue;
    share.vertex_ids.push_back(id_of(v));
    for (const double x : mesh.position(v)) share.vertex_xyz.push_back(x);
    if (ranks[at(v)].size() > 1) {
      share.vertex_sharers.values.insert(share.vertex_sharers.values.end(), ranks[at(v)].begin(),
                                         ranks[at(v)].end());
    }
    share.vertex_sharers.end_list();
  }
}

void add_tets(const mesh::CoarseMesh& mesh, std::span<const Rank> tet_rank, Rank rank,
              migrate::DistributedMesh& share)
{
  std::map<GlobalIndex, LocalIndex> row;
  for (LocalIndex v = 0; v < share.num_vertices(); ++v) row[share.vertex_ids[at(v)]] = v;
  share.tet_columns.resize(1);
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (tet_rank[at(t)] != rank) continue;
    share.tet_ids.push_back(id_of(t));
    for (const LocalIndex v : mesh.tet(t)) share.tet_vertices.push_back(row.at(id_of(v)));
    share.tet_material.push_back(mesh.tet_material[at(t)]);
    share.tet_part.push_back(t % 5);
    share.tet_columns[0].push_back(std::uint64_t{1} << (t % 64));
  }
}

struct TetFace {
  LocalIndex tet = 0;
  LocalIndex corner = 0;  // Opposite to the face.
};

using Triangle = std::array<LocalIndex, 3>;

// By ascending vertices; of two tets, the lower one.
std::map<Triangle, TetFace> faces_of_tets(const mesh::CoarseMesh& mesh)
{
  std::map<Triangle, TetFace> faces;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    for (LocalIndex corner = 0; corner < 4; ++corner) {
      const auto& [a, b, c] = mesh::kTetFaceCorners[at(corner)];
      faces.try_emplace(mesh::sorted_triangle(mesh.tet(t)[a], mesh.tet(t)[b], mesh.tet(t)[c]),
                        TetFace{t, corner});
    }
  }
  return faces;
}

void add_boundary(const mesh::CoarseMesh& mesh, migrate::DistributedMesh& share)
{
  const auto faces = faces_of_tets(mesh);
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* const v = &mesh.face_vertices[3 * at(f)];
    const TetFace face = faces.at(mesh::sorted_triangle(v[0], v[1], v[2]));
    const auto row = std::ranges::find(share.tet_ids, id_of(face.tet));
    if (row == share.tet_ids.end()) continue;
    share.boundary_ids.push_back(id_of(f));
    share.boundary_tet.push_back(static_cast<LocalIndex>(row - share.tet_ids.begin()));
    share.boundary_corner.push_back(face.corner);
    share.boundary_patch.push_back(mesh.face_patch[at(f)]);
  }
}

}  // namespace

migrate::DistributedMesh share_of_mesh(const mesh::CoarseMesh& mesh, std::span<const Rank> tet_rank,
                                       Rank rank)
{
  migrate::DistributedMesh share;
  add_vertices(mesh, tet_rank, rank, share);
  add_tets(mesh, tet_rank, rank, share);
  add_boundary(mesh, share);
  return share;
}

LocalIndex tet_of_id(GlobalIndex id) { return static_cast<LocalIndex>((id - kFirstId) / kIdStep); }

}  // namespace tessera::testing

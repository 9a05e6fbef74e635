// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/tet_neighbours.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "migrate/list_streams.hpp"

namespace tessera::migrate {
namespace {

using Triangle = std::array<LocalIndex, 3>;

Triangle face_of(const MeshBlock& block, LocalIndex tet, std::size_t corner)
{
  const auto& [a, b, c] = mesh::kTetFaceCorners[corner];
  const auto vertices = block.tet(tet);
  return mesh::sorted_triangle(vertices[a], vertices[b], vertices[c]);
}

// A face with its lowest vertex left out, in the list of that vertex.
struct OpenFace {
  LocalIndex middle = 0;
  LocalIndex high = 0;
  LocalIndex side = 0;  // 4 * tet + corner.
};

// Joins faces with the same vertices; those of one lowest vertex stand together.
void join_faces(std::span<OpenFace> faces, std::vector<LocalIndex>& behind)
{
  std::ranges::sort(faces, [](const OpenFace& a, const OpenFace& b) {
    return std::tie(a.middle, a.high, a.side) < std::tie(b.middle, b.high, b.side);
  });
  const auto is_same = [&](std::size_t i, std::size_t j) {
    return j < faces.size() && faces[i].middle == faces[j].middle && faces[i].high == faces[j].high;
  };
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    if (!is_same(i, i + 1)) continue;
    if (is_same(i, i + 2)) throw InputError("the mesh has a triangle on more than two tets");
    behind[at(faces[i].side)] = faces[i + 1].side / 4;
    behind[at(faces[i + 1].side)] = faces[i].side / 4;
    ++i;
  }
}

struct SharedFace {
  std::array<GlobalIndex, 3> ids{};  // Ascending.
  LocalIndex tet = 0;
  LocalIndex corner = 0;
};

// Other ranks that have all three vertices.
std::vector<Rank> ranks_with(const DistributedMesh& mesh, const Triangle& face, Rank rank)
{
  std::vector<Rank> common;
  for (const Rank sharer : mesh.vertex_sharers[face[0]]) {
    const auto has = [&](LocalIndex v) {
      return std::ranges::binary_search(mesh.vertex_sharers[v], sharer);
    };
    if (sharer != rank && has(face[1]) && has(face[2])) common.push_back(sharer);
  }
  return common;
}

// Faces that another rank might have as well, in ascending order of ids for each rank.
RankBuckets<std::vector<SharedFace>> shared_faces(const comm::Communicator& comm,
                                                  const DistributedMesh& mesh,
                                                  const std::vector<LocalIndex>& behind)
{
  RankBuckets<std::vector<SharedFace>> faces(comm.size());
  for (std::size_t side = 0; side < behind.size(); ++side) {
    if (behind[side] != kNoIndex) continue;
    const auto tet = static_cast<LocalIndex>(side / 4);
    const Triangle face = face_of(mesh, tet, side % 4);
    for (const Rank rank : ranks_with(mesh, face, comm.rank())) {
      faces[rank].push_back({{mesh.vertex_ids[at(face[0])], mesh.vertex_ids[at(face[1])],
                              mesh.vertex_ids[at(face[2])]},
                             tet,
                             static_cast<LocalIndex>(side % 4)});
    }
  }
  for (const Rank rank : faces.ranks()) {
    std::ranges::sort(faces[rank], {}, &SharedFace::ids);
  }
  return faces;
}

void add_remote(const SharedFace& face, Rank rank, TetNeighbours& neighbours)
{
  LocalIndex& behind = neighbours.behind[4 * at(face.tet) + at(face.corner)];
  if (behind != kNoIndex) throw InputError("the mesh has a triangle on more than two tets");
  behind = static_cast<LocalIndex>(neighbours.behind.size() / 4 + neighbours.remote.size());
  neighbours.remote.push_back({rank, face.tet, face.corner});
}

// Takes the faces that both ranks have, in the order of their ids.
void join_remote(const std::vector<SharedFace>& mine, Rank rank, ListStreams<GlobalIndex>& theirs,
                 TetNeighbours& neighbours)
{
  std::vector<std::array<GlobalIndex, 3>> ids;
  while (theirs.has_more(rank)) {
    const auto list = theirs.get(rank);
    for (std::size_t i = 0; i + 2 < list.size(); i += 3)
      ids.push_back({list[i], list[i + 1], list[i + 2]});
  }
  for (const SharedFace& face : mine) {
    if (std::ranges::binary_search(ids, face.ids)) add_remote(face, rank, neighbours);
  }
}

}  // namespace

std::vector<LocalIndex> tets_behind_faces(const MeshBlock& block)
{
  std::vector<std::size_t> end(block.vertex_ids.size() + 1, 0);
  for (LocalIndex t = 0; t < block.num_tets(); ++t) {
    for (std::size_t c = 0; c < 4; ++c) ++end[at(face_of(block, t, c)[0]) + 1];
  }
  for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
  std::vector<OpenFace> faces(4 * block.tet_ids.size());
  for (LocalIndex t = 0; t < block.num_tets(); ++t) {
    for (std::size_t c = 0; c < 4; ++c) {
      const Triangle face = face_of(block, t, c);
      faces[end[at(face[0])]++] = {face[1], face[2], 4 * t + static_cast<LocalIndex>(c)};
    }
  }
  std::vector<LocalIndex> behind(faces.size(), kNoIndex);
  std::size_t begin = 0;
  for (std::size_t v = 0; v + 1 < end.size(); ++v) {
    join_faces(std::span(faces).subspan(begin, end[v] - begin), behind);
    begin = end[v];
  }
  return behind;
}

TetNeighbours find_neighbours(const comm::Communicator& comm, const DistributedMesh& mesh)
{
  TetNeighbours neighbours;
  comm::all_or_none(comm, [&] { neighbours.behind = tets_behind_faces(mesh); });

  auto faces = shared_faces(comm, mesh, neighbours.behind);
  ListStreams<GlobalIndex> streams(comm);
  for (const Rank rank : faces.ranks()) {
    for (const SharedFace& face : faces[rank]) streams.put(rank, face.ids);
  }
  Traffic traffic;
  streams.exchange(traffic);
  comm::all_or_none(comm, [&] {
    for (const Rank rank : faces.ranks()) join_remote(faces[rank], rank, streams, neighbours);
  });
  return neighbours;
}

std::vector<GlobalIndex> values_behind(const comm::Communicator& comm,
                                       const TetNeighbours& neighbours,
                                       const std::vector<GlobalIndex>& tet_values)
{
  ListStreams<GlobalIndex> streams(comm);
  for (const RemoteFace& face : neighbours.remote) streams.put(face.rank, tet_values[at(face.tet)]);
  Traffic traffic;
  streams.exchange(traffic);
  std::vector<GlobalIndex> values;
  values.reserve(neighbours.remote.size());
  for (const RemoteFace& face : neighbours.remote) values.push_back(streams.get(face.rank).front());
  return values;
}

}  // namespace tessera::migrate

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/read_mesh.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/migrate/cut_into_parts.hpp"
#include "tessera/migrate/ghosts.hpp"
#include "tessera/migrate/partition.hpp"
#include "tessera/subdomain/mesh_input.hpp"

#include "subdomain/consecutive_points.hpp"
#include "subdomain/files/ghost_points.hpp"

namespace tessera::subdomain {
namespace {

// As rank 0 sees it, so that no rank can read another mesh.
std::filesystem::path index_of(const std::filesystem::path& mesh, const comm::Communicator& comm)
{
  return comm::on_root(comm, [&] {
    std::error_code error;  // What cannot be looked at, the reader complains about.
    return std::filesystem::is_directory(mesh, error) ? mesh / "mesh.pvtu" : mesh;
  });
}

migrate::DistributedMesh cut_anew(migrate::DistributedMesh mesh, const std::string& name,
                                  const comm::Communicator& comm)
{
  const GlobalIndex num_tets = comm.sum(mesh.num_tets());
  if (num_tets < comm.size()) {
    throw comm::Collective<InputError>(
        fmt::format("{}: the mesh has only {} tets, fewer than ranks", name, num_tets));
  }
  migrate::Traffic traffic;
  return migrate::cut_into_parts(comm, std::move(mesh), {.num_parts = comm.size()}, traffic).mesh;
}

// With the rank as the part.
std::vector<migrate::GhostTets> ghosts_of(const migrate::DistributedMesh& mesh, int num_layers,
                                          const comm::Communicator& comm)
{
  if (num_layers <= 0) return {};
  const IndexLists vertex_parts = migrate::parts_of_vertices(comm, mesh);
  return migrate::find_ghosts(comm, mesh, vertex_parts, comm.size(), num_layers);
}

std::vector<LocalIndex> triangle_points(const migrate::DistributedMesh& mesh)
{
  std::vector<LocalIndex> points;
  points.reserve(3 * mesh.boundary_ids.size());
  for (LocalIndex b = 0; b < mesh.num_boundary(); ++b) {
    const auto tet = mesh.tet(mesh.boundary_tet[at(b)]);
    for (const std::size_t c : mesh::kTetFaceCorners[at(mesh.boundary_corner[at(b)])]) {
      points.push_back(tet[c]);
    }
  }
  return points;
}

void add_owners(const migrate::DistributedMesh& mesh, Rank rank, MeshShare& share)
{
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    share.point_owner.push_back(mesh.owner(v, rank));
    for (const Rank sharer : mesh.vertex_sharers[v]) {
      if (sharer != rank) share.point_sharers.values.push_back(sharer);
    }
    share.point_sharers.end_list();
  }
}

MeshShare own_share(migrate::DistributedMesh mesh, const comm::Communicator& comm)
{
  MeshShare share;
  add_owners(mesh, comm.rank(), share);
  share.num_global_points = comm.sum(std::ranges::count(share.point_owner, comm.rank()));
  share.num_global_tets = comm.sum(mesh.num_tets());
  share.num_global_triangles = comm.sum(mesh.num_boundary());
  share.tet_rank.assign(mesh.tet_ids.size(), comm.rank());
  share.triangle_points = triangle_points(mesh);
  share.point_xyz = std::move(mesh.vertex_xyz);
  share.point_ids = std::move(mesh.vertex_ids);
  share.tet_points = std::move(mesh.tet_vertices);
  share.tet_ids = std::move(mesh.tet_ids);
  share.tet_material = std::move(mesh.tet_material);
  share.triangle_ids = std::move(mesh.boundary_ids);
  share.triangle_tet = std::move(mesh.boundary_tet);
  share.triangle_patch = std::move(mesh.boundary_patch);
  return share;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from)
{
  to.insert(to.end(), from.begin(), from.end());
}

void add_ghosts(const migrate::GhostTets& ghosts, MeshShare& share)
{
  const LocalIndex num_own = share.num_points();
  const std::vector<LocalIndex> rows =
      add_ghost_points(ghosts, {share.point_ids, share.point_xyz, share.point_owner});
  share.num_ghost_points = share.num_points() - num_own;
  for (const LocalIndex v : ghosts.block.tet_vertices) share.tet_points.push_back(rows[at(v)]);
  append(share.tet_ids, ghosts.block.tet_ids);
  append(share.tet_material, ghosts.block.tet_material);
  append(share.tet_rank, ghosts.block.tet_part);
  share.num_ghost_tets = ghosts.block.num_tets();
}

void add_names(Texts texts, MeshShare& share)
{
  share.material_names = std::move(texts["material_names"]);
  share.patch_names = std::move(texts["patch_names"]);
  const std::vector<std::string>& unit = texts["length_unit"];
  if (!unit.empty()) share.length_unit = unit.front();
}

}  // namespace

MeshShare read_mesh(const std::filesystem::path& mesh, const comm::Communicator& comm,
                    const ReadOptions& options)
{
  comm::roll_call(comm.handle(), "read_mesh()", options.rank_timeout_s);
  const std::filesystem::path index = index_of(mesh, comm);
  migrate::MeshPieces pieces = read_pieces(index, comm, [] {});
  Texts texts = field_texts_of(pieces, comm);
  migrate::AssembledMesh assembled = assemble_pieces(index, pieces, comm);
  pieces = {};
  if (options.partition == ReadPartition::balanced) {
    assembled.mesh = cut_anew(std::move(assembled.mesh), index.string(), comm);
  }
  std::ranges::fill(assembled.mesh.tet_part, comm.rank());
  const std::vector<migrate::GhostTets> ghosts =
      ghosts_of(assembled.mesh, options.num_ghost_layers, comm);
  MeshShare share = own_share(std::move(assembled.mesh), comm);
  for (const migrate::GhostTets& of_rank : ghosts) add_ghosts(of_rank, share);
  if (options.consecutive_points) number_consecutively(share, comm);
  add_names(std::move(texts), share);
  share.notes = std::move(assembled.notes);
  return share;
}

}  // namespace tessera::subdomain

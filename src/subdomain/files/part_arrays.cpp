// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/part_arrays.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "tessera/mesh/tet_topology.hpp"

#include "subdomain/files/ghost_points.hpp"

namespace tessera::subdomain {
namespace {

// Adds points to a piece as they are asked for.
class PointRows {
 public:
  PointRows(const PartContext& context, mesh::MeshArrays& arrays)
      : context_(context),
        arrays_(arrays),
        owner_(arrays.point_ints["owner"]),
        row_(at(context.mesh.num_vertices()), kNoIndex)
  {
  }

  // Adds those that are marked, in ascending order of ids.
  void add(const std::vector<bool>& is_marked)
  {
    for (LocalIndex v = 0; v < context_.mesh.num_vertices(); ++v) {
      if (!is_marked[at(v)]) continue;
      row_[at(v)] = static_cast<LocalIndex>(arrays_.point_ids.size());
      arrays_.point_ids.push_back(context_.mesh.vertex_ids[at(v)]);
      for (const double x : context_.mesh.position(v)) arrays_.point_xyz.push_back(x);
      owner_.push_back(context_.vertex_parts[v].front());
    }
  }

  [[nodiscard]] LocalIndex operator[](LocalIndex v) const { return row_[at(v)]; }

 private:
  const PartContext& context_;
  mesh::MeshArrays& arrays_;
  std::vector<std::int32_t>& owner_;
  std::vector<LocalIndex> row_;
};

void add_column(const std::vector<std::uint64_t>& values, const migrate::TetColumn& column,
                const std::vector<LocalIndex>& tets, mesh::MeshArrays& arrays)
{
  const auto append = [&]<class T>(std::vector<T>& to, const auto& from_bits) {
    for (const LocalIndex t : tets) to.push_back(from_bits(values[at(t)]));
  };
  switch (column.type) {
    case migrate::ColumnType::int32:
      return append(arrays.cell_ints[column.name],
                    [](std::uint64_t bits) { return static_cast<std::int32_t>(bits); });
    case migrate::ColumnType::int64:
      return append(arrays.cell_longs[column.name],
                    [](std::uint64_t bits) { return static_cast<GlobalIndex>(bits); });
    case migrate::ColumnType::float64:
      return append(arrays.cell_doubles[column.name],
                    [](std::uint64_t bits) { return std::bit_cast<double>(bits); });
  }
}

mesh::MeshArrays tet_arrays(const PartContext& context, LocalIndex part)
{
  const migrate::DistributedMesh& mesh = context.mesh;
  mesh::MeshArrays arrays{.field_texts = context.field_texts};
  std::vector<LocalIndex> tets;
  std::vector<bool> is_used(at(mesh.num_vertices()), false);
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (mesh.tet_part[at(t)] != part) continue;
    tets.push_back(t);
    for (const LocalIndex v : mesh.tet(t)) is_used[at(v)] = true;
  }
  PointRows rows(context, arrays);
  rows.add(is_used);
  auto& attribute = arrays.cell_ints["attribute"];
  for (const LocalIndex t : tets) {
    for (const LocalIndex v : mesh.tet(t)) arrays.cell_points.push_back(rows[v]);
    arrays.cell_ids.push_back(mesh.tet_ids[at(t)]);
    attribute.push_back(mesh.tet_material[at(t)]);
  }
  arrays.cell_ints["subdomain"].assign(tets.size(), part);
  for (std::size_t c = 0; c < context.columns.size(); ++c) {
    add_column(mesh.tet_columns[c], context.columns[c], tets, arrays);
  }
  return arrays;
}

void add_ghosts(const PartContext& context, const migrate::GhostTets& ghosts,
                mesh::MeshArrays& arrays)
{
  const migrate::MeshBlock& block = ghosts.block;
  const std::vector<LocalIndex> rows =
      add_ghost_points(ghosts, {arrays.point_ids, arrays.point_xyz, arrays.point_ints["owner"]});
  std::vector<LocalIndex> tets;
  for (LocalIndex t = 0; t < block.num_tets(); ++t) {
    tets.push_back(t);
    for (const LocalIndex v : block.tet(t)) arrays.cell_points.push_back(rows[at(v)]);
    arrays.cell_ids.push_back(block.tet_ids[at(t)]);
    arrays.cell_ints["attribute"].push_back(block.tet_material[at(t)]);
    arrays.cell_ints["subdomain"].push_back(block.tet_part[at(t)]);
  }
  for (std::size_t c = 0; c < context.columns.size(); ++c) {
    add_column(block.tet_columns[c], context.columns[c], tets, arrays);
  }
}

// Exactly one piece has each cell, and each point, that is no ghost.
void mark_ghosts(GlobalIndex num_own, LocalIndex part, mesh::MeshArrays& arrays)
{
  for (const std::int32_t owner : arrays.point_ints["owner"]) {
    arrays.point_ghost.push_back(owner == part ? 0 : 1);
  }
  arrays.cell_ghost.assign(static_cast<std::size_t>(arrays.num_cells()), 1);
  std::fill_n(arrays.cell_ghost.begin(), num_own, std::uint8_t{0});
}

mesh::MeshArrays boundary_arrays(const PartContext& context, LocalIndex part)
{
  const migrate::DistributedMesh& mesh = context.mesh;
  mesh::MeshArrays arrays{.vertices_per_cell = 3, .field_texts = context.field_texts};
  std::vector<LocalIndex> corners;
  std::vector<bool> is_used(at(mesh.num_vertices()), false);
  auto& patch = arrays.cell_ints["patch"];
  auto& tet_ids = arrays.cell_longs["tet"];
  for (LocalIndex b = 0; b < mesh.num_boundary(); ++b) {
    const LocalIndex tet = mesh.boundary_tet[at(b)];
    if (mesh.tet_part[at(tet)] != part) continue;
    for (const std::size_t c : mesh::kTetFaceCorners[at(mesh.boundary_corner[at(b)])]) {
      corners.push_back(mesh.tet(tet)[c]);
      is_used[at(corners.back())] = true;
    }
    arrays.cell_ids.push_back(mesh.boundary_ids[at(b)]);
    patch.push_back(mesh.boundary_patch[at(b)]);
    tet_ids.push_back(mesh.tet_ids[at(tet)]);
  }
  arrays.cell_ints["subdomain"].assign(arrays.cell_ids.size(), part);
  PointRows rows(context, arrays);
  rows.add(is_used);
  for (const LocalIndex v : corners) arrays.cell_points.push_back(rows[v]);
  return arrays;
}

}  // namespace

PieceArrays part_arrays(const PartContext& context, LocalIndex part,
                        const migrate::GhostTets* ghosts)
{
  PieceArrays arrays{.tets = tet_arrays(context, part), .boundary = boundary_arrays(context, part)};
  arrays.tets.num_ghost_layers = context.num_ghost_layers;
  if (context.num_ghost_layers == 0) return arrays;
  const GlobalIndex num_own = arrays.tets.num_cells();
  if (ghosts != nullptr) add_ghosts(context, *ghosts, arrays.tets);
  mark_ghosts(num_own, part, arrays.tets);
  return arrays;
}

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/migrate/assemble.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "tessera/base/bytes.hpp"
#include "tessera/base/rows.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/migrate/tet_neighbours.hpp"

#include "migrate/attach_boundary.hpp"
#include "migrate/dense_ids.hpp"
#include "migrate/find_sharers.hpp"
#include "migrate/join_points.hpp"
#include "migrate/sharer_lists.hpp"

namespace tessera::migrate {
namespace {

// How many pieces have a column.
struct ColumnCounts {
  GlobalIndex num_pieces = 0;  // With tets.
  std::map<TetColumn, GlobalIndex> num_with{};

  static auto fields(auto& self) { return std::tie(self.num_pieces, self.num_with); }

  void add(const mesh::MeshArrays& piece)
  {
    static const std::set<std::string> own_meaning{"attribute", "subdomain"};
    if (piece.num_cells() == 0) return;
    ++num_pieces;
    const auto count = [&](const auto& arrays, ColumnType type) {
      for (const auto& [name, values] : arrays) {
        if (!own_meaning.contains(name)) ++num_with[{name, type}];
      }
    };
    count(piece.cell_ints, ColumnType::int32);
    count(piece.cell_longs, ColumnType::int64);
    count(piece.cell_doubles, ColumnType::float64);
  }

  void add(const ColumnCounts& other)
  {
    num_pieces += other.num_pieces;
    for (const auto& [column, count] : other.num_with) num_with[column] += count;
  }
};

// Columns that all pieces with tets have, on all ranks.
std::vector<TetColumn> common_columns(const comm::Communicator& comm, const MeshPieces& pieces)
{
  ColumnCounts mine;
  for (const mesh::MeshArrays& piece : pieces.tets) mine.add(piece);
  ColumnCounts all;
  for (const ColumnCounts& counts : comm.all_gather_values(mine)) all.add(counts);
  std::vector<TetColumn> columns;
  for (const auto& [column, count] : all.num_with) {
    if (count == all.num_pieces) columns.push_back(column);
  }
  return columns;
}

std::vector<std::uint64_t> column_values(const std::vector<mesh::MeshArrays>& pieces,
                                         const TetColumn& column)
{
  std::vector<std::uint64_t> bits;
  const auto append = [&](const auto& values, const auto& to_bits) {
    std::ranges::transform(values, std::back_inserter(bits), to_bits);
  };
  for (const mesh::MeshArrays& piece : pieces) {
    if (piece.num_cells() == 0) continue;
    const auto from_integer = [](auto value) { return static_cast<std::uint64_t>(value); };
    switch (column.type) {
      case ColumnType::int32:
        append(piece.cell_ints.at(column.name), from_integer);
        break;
      case ColumnType::int64:
        append(piece.cell_longs.at(column.name), from_integer);
        break;
      case ColumnType::float64:
        append(piece.cell_doubles.at(column.name),
               [](double value) { return std::bit_cast<std::uint64_t>(value); });
        break;
    }
  }
  return bits;
}

// Ids of the tets as in the files, if all pieces have some.
std::optional<std::vector<GlobalIndex>> tet_ids_of(const std::vector<mesh::MeshArrays>& pieces)
{
  std::vector<GlobalIndex> ids;
  for (const mesh::MeshArrays& piece : pieces) {
    if (std::cmp_not_equal(piece.cell_ids.size(), piece.num_cells())) return std::nullopt;
    ids.insert(ids.end(), piece.cell_ids.begin(), piece.cell_ids.end());
  }
  return ids;
}

bool have_inside_patches(const std::vector<mesh::MeshArrays>& pieces)
{
  return std::ranges::any_of(pieces, [](const mesh::MeshArrays& piece) {
    return piece.field_texts.contains(mesh::kInsidePatchesName);
  });
}

bool all_have_point_ids(const comm::Communicator& comm, const MeshPieces& pieces)
{
  GlobalIndex num_without = 0;
  for (const auto* const of_file : {&pieces.tets, &pieces.boundary}) {
    for (const mesh::MeshArrays& piece : *of_file) {
      if (std::cmp_not_equal(piece.point_ids.size(), piece.num_points())) ++num_without;
    }
  }
  return comm.sum(num_without) == 0;
}

// Of no use if by ids and contradicted. Vertices in the order of their keys, tets in the order of
// the pieces; ids are still to come.
struct Draft {
  VertexIdentity identity = VertexIdentity::ids;
  JoinedTets joined{};
  std::vector<LocalIndex> behind{};
  FoundSharers found{};
};

Draft join(const comm::Communicator& comm, const MeshPieces& pieces, VertexIdentity identity)
{
  Draft draft{.identity = identity};
  comm::all_or_none(comm, [&] { draft.joined = join_tets(pieces.tets, identity); });
  draft.found.has_contradiction = comm.sum(draft.joined.has_contradiction ? 1 : 0) > 0;
  if (draft.found.has_contradiction && identity == VertexIdentity::ids) return draft;
  comm::all_or_none(comm, [&] {
    require_tets(draft.joined.block);
    draft.behind = tets_behind_faces(draft.joined.block);
  });
  draft.found = find_sharers(comm, draft.joined, draft.behind);
  return draft;
}

// Dense ids for the vertices. The ids of the files are kept if points are matched by them and they
// are dense. Else each rank numbers the vertices that it owns, in the order in which its tets use
// them.
void number_vertices(const comm::Communicator& comm, const Draft& draft, DistributedMesh& mesh)
{
  std::vector<LocalIndex> owned;
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.owner(v, comm.rank()) == comm.rank()) owned.push_back(v);
  }
  std::ranges::sort(owned, {}, [&](LocalIndex v) { return draft.joined.first_use[at(v)]; });
  std::optional<std::vector<GlobalIndex>> ids;
  if (draft.identity == VertexIdentity::ids) {
    ids.emplace();
    for (const LocalIndex v : owned) {
      ids->push_back(static_cast<GlobalIndex>(draft.joined.vertex_keys[at(v)][0]));
    }
  }
  const std::vector<GlobalIndex> dense = dense_ids(comm, std::move(ids), owned.size());
  for (std::size_t i = 0; i < owned.size(); ++i) mesh.vertex_ids[at(owned[i])] = dense[i];
  Traffic traffic;
  mesh.vertex_ids = values_from_owners(comm, mesh, std::move(mesh.vertex_ids), traffic);
}

// Equal positions need not have equal bits (0 and -0): all ranks take the owner's.
void take_positions_of_owners(const comm::Communicator& comm, DistributedMesh& mesh)
{
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<GlobalIndex> bits;
    bits.reserve(mesh.vertex_ids.size());
    for (std::size_t i = d; i < mesh.vertex_xyz.size(); i += 3) {
      bits.push_back(std::bit_cast<GlobalIndex>(mesh.vertex_xyz[i]));
    }
    Traffic traffic;
    bits = values_from_owners(comm, mesh, std::move(bits), traffic);
    for (std::size_t v = 0; v < bits.size(); ++v) {
      mesh.vertex_xyz[3 * v + d] = std::bit_cast<double>(bits[v]);
    }
  }
}

std::vector<LocalIndex> ascending(const std::vector<GlobalIndex>& ids)
{
  std::vector<LocalIndex> order(ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](LocalIndex i) { return ids[at(i)]; });
  return order;
}

void sort_vertices(DistributedMesh& mesh)
{
  const auto order = ascending(mesh.vertex_ids);
  const auto place = inverse_of(order);
  mesh.vertex_ids = rows_of(mesh.vertex_ids, order);
  mesh.vertex_xyz = rows_of<3>(mesh.vertex_xyz, order);
  for (LocalIndex& v : mesh.tet_vertices) v = place[at(v)];
  IndexLists sharers;
  for (const LocalIndex v : order) sharers.add(mesh.vertex_sharers[v]);
  mesh.vertex_sharers = std::move(sharers);
}

void sort_tets(DistributedMesh& mesh)
{
  const auto order = ascending(mesh.tet_ids);
  const auto place = inverse_of(order);
  mesh.tet_ids = rows_of(mesh.tet_ids, order);
  mesh.tet_vertices = rows_of<4>(mesh.tet_vertices, order);
  mesh.tet_material = rows_of(mesh.tet_material, order);
  mesh.tet_part = rows_of(mesh.tet_part, order);
  for (auto& column : mesh.tet_columns) column = rows_of(column, order);
  for (LocalIndex& t : mesh.boundary_tet) t = place[at(t)];
}

void sort_boundary(DistributedMesh& mesh)
{
  const auto order = ascending(mesh.boundary_ids);
  mesh.boundary_ids = rows_of(mesh.boundary_ids, order);
  mesh.boundary_tet = rows_of(mesh.boundary_tet, order);
  mesh.boundary_corner = rows_of(mesh.boundary_corner, order);
  mesh.boundary_patch = rows_of(mesh.boundary_patch, order);
}

}  // namespace

AssembledMesh assemble(const comm::Communicator& comm, const MeshPieces& pieces)
{
  AssembledMesh assembled;
  const bool has_ids = all_have_point_ids(comm, pieces);
  Draft draft = join(comm, pieces, has_ids ? VertexIdentity::ids : VertexIdentity::positions);
  if (draft.found.has_contradiction) {
    assembled.notes.emplace_back("point ids stand for several positions and are not used");
    draft = join(comm, pieces, VertexIdentity::positions);
  } else if (!has_ids) {
    assembled.notes.emplace_back("points without ids: matched by position");
  }
  DistributedMesh& mesh = assembled.mesh;
  static_cast<MeshBlock&>(mesh) = draft.joined.block;
  mesh.vertex_sharers = std::move(draft.found.sharers);

  assembled.columns = common_columns(comm, pieces);
  for (const TetColumn& column : assembled.columns) {
    mesh.tet_columns.push_back(column_values(pieces.tets, column));
  }
  auto tet_ids = tet_ids_of(pieces.tets);
  attach_boundary(comm,
                  {.joined = draft.joined,
                   .behind = draft.behind,
                   .tet_ids = tet_ids.value_or(std::vector<GlobalIndex>{}),
                   .pieces = pieces.boundary,
                   .has_inside_patches = have_inside_patches(pieces.tets),
                   .has_boundary = pieces.has_boundary,
                   .identity = draft.identity},
                  mesh);
  mesh.tet_ids = dense_ids(comm, std::move(tet_ids), mesh.tet_ids.size());
  number_vertices(comm, draft, mesh);
  take_positions_of_owners(comm, mesh);
  sort_vertices(mesh);
  sort_tets(mesh);
  sort_boundary(mesh);
  return assembled;
}

}  // namespace tessera::migrate

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_arrays.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "tessera/base/version.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/quality/tet_quality.hpp"

namespace tessera::subdomain {
namespace {

std::vector<std::string> names_or_none(const std::string& name)
{
  return name.empty() ? std::vector<std::string>{} : std::vector<std::string>{name};
}

std::vector<LocalIndex> rows_of_patches(std::vector<LocalIndex> patches,
                                        const mesh::CoarseMesh& coarse)
{
  if (coarse.patch_row.empty()) return patches;
  for (LocalIndex& patch : patches) patch = coarse.patch_row[at(patch)];
  return patches;
}

mesh::MeshArrays with_names(const WriteContext& mesh)
{
  mesh::MeshArrays arrays;
  arrays.field_texts["material_names"] = mesh::body_names(mesh.coarse);
  arrays.field_texts["patch_names"] = names_of_rows(mesh.coarse);
  for (const auto& sides : mesh::split_patch_names(mesh.coarse)) {
    auto& names = arrays.field_texts["split_patches"];
    names.insert(names.end(), sides.begin(), sides.end());
  }
  if (auto names = mesh::inside_patch_names(mesh.coarse); !names.empty()) {
    arrays.field_texts[mesh::kInsidePatchesName] = std::move(names);
  }
  if (const auto pairs = mesh::periodic_pairs(mesh.coarse); !pairs.empty()) {
    arrays.field_texts[mesh::kPeriodicPairsName] = mesh::to_texts(pairs);
  }
  arrays.field_texts["length_unit"] = names_or_none(mesh.length_unit);
  arrays.field_texts["tessera_version"] = {std::string(version())};
  return arrays;
}

void number_by_host(const mesh::Piece& piece, const WriteContext& mesh, mesh::MeshArrays& arrays)
{
  auto& owner = arrays.point_ints["owner"];
  const mesh::HostLayout hosts(mesh.skeleton);
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    const mesh::HostPoint vertex = piece.skin_point(v);
    arrays.point_ids.push_back(mesh.ids.vertex_id(vertex));
    owner.push_back(mesh::owner_of_host(mesh.skeleton, hosts, vertex.host));
  }
  for (LocalIndex i = 0; i < piece.num_interior_vertices(); ++i) {
    arrays.point_ids.push_back(mesh.ids.interior_vertex_id(piece.subdomain, i));
    owner.push_back(piece.subdomain);
  }
}

void number_by_owner(const mesh::Piece& piece, const WriteContext& mesh, mesh::MeshArrays& arrays)
{
  auto& owner = arrays.point_ints["owner"];
  for (const VertexPlace& place : mesh.places_of(piece)) {
    arrays.point_ids.push_back(mesh.ids.owned_vertex_id(place.owner, place.index));
    owner.push_back(place.owner);
  }
}

// At a joint, layers on the other side end at points of the piece.
void share_points_of_joints(const mesh::Piece& piece, const LayerTables& layers,
                            mesh::MeshArrays& arrays)
{
  auto& owner = arrays.point_ints["owner"];
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    const mesh::HostEntity host = piece.name_in_layers(v).host;
    if (!layers.is_end_elsewhere(host)) continue;
    owner[at(v)] = std::min(owner[at(v)], layers.owner_of_ends(host));
  }
}

void add_points(const mesh::Piece& piece, const WriteContext& mesh, mesh::MeshArrays& arrays)
{
  arrays.point_ints["owner"].reserve(at(piece.num_vertices()));
  arrays.point_ids.reserve(at(piece.num_vertices()));
  if (piece.num_vertices() == 0) return;  // Nobody has noted owners of an empty piece.
  if (mesh.ids.is_by_host()) {
    number_by_host(piece, mesh, arrays);
  } else {
    number_by_owner(piece, mesh, arrays);
  }
  if (mesh.layers != nullptr) share_points_of_joints(piece, *mesh.layers, arrays);
}

// A vertex of the whole mesh.
struct NumberedVertex {
  GlobalIndex id = 0;
  LocalIndex owner = kNoIndex;
};

std::vector<NumberedVertex> number_names(std::span<const mesh::HostPoint> names,
                                         const WriteContext& mesh)
{
  std::vector<NumberedVertex> numbered;
  if (!mesh.ids.is_by_host() && !names.empty()) {
    for (const VertexPlace& place : mesh.places_of_names(names)) {
      numbered.push_back({mesh.ids.owned_vertex_id(place.owner, place.index), place.owner});
    }
    return numbered;
  }
  const mesh::HostLayout hosts(mesh.skeleton);
  for (const mesh::HostPoint& name : names) {
    numbered.push_back(
        {mesh.ids.vertex_id(name), mesh::owner_of_host(mesh.skeleton, hosts, name.host)});
  }
  return numbered;
}

// Where columns end, by row of `layered`; of those with an end of their own in the piece. At a
// joint that may be a vertex of the tets on the other side.
class ColumnEndIds {
 public:
  ColumnEndIds(const LayeredPiece& layered, const WriteContext& mesh) : mesh_(mesh)
  {
    std::vector<mesh::HostPoint> of_tets;
    for (std::size_t row = 0; row < layered.columns.size(); ++row) {
      const mesh::HostPoint end = end_of(layered.columns[row]);
      if (!layered.has_own_end(row) || layers().has_columns(end.host)) continue;
      const mesh::Columns& columns = layered.piece.columns;
      of_tets.push_back(columns.ends.empty() ? end
                                             : columns.ends[columns.row_of(layered.columns[row])]);
    }
    of_tets_ = number_names(of_tets, mesh);
  }

  // To be asked for in the order of rows.
  [[nodiscard]] NumberedVertex next(const mesh::HostPoint& column)
  {
    const mesh::HostPoint end = end_of(column);
    const LocalIndex of_columns = layers().owner_of_ends(end.host);
    if (layers().has_columns(end.host)) {
      const GlobalIndex point = layers().first_point(end) + layers().num_own_points(end.host) - 1;
      return {mesh_.ids.num_vertices() + point, of_columns};
    }
    const NumberedVertex& of_tets = of_tets_[next_++];
    return {of_tets.id, std::min(of_tets.owner, of_columns)};
  }

 private:
  [[nodiscard]] const LayerTables& layers() const { return *mesh_.layers; }
  [[nodiscard]] mesh::HostPoint end_of(const mesh::HostPoint& column) const
  {
    return {layers().end_host(column.host), column.index};
  }

  const WriteContext& mesh_;
  std::vector<NumberedVertex> of_tets_{};
  std::size_t next_ = 0;
};

void add_layer_points(const LayeredPiece& layered, const WriteContext& mesh,
                      mesh::MeshArrays& arrays)
{
  const LayerTables& layers = *mesh.layers;
  auto& owner = arrays.point_ints["owner"];
  ColumnEndIds ends(layered, mesh);
  for (std::size_t row = 0; row < layered.columns.size(); ++row) {
    const mesh::HostPoint& vertex = layered.columns[row];
    for (LocalIndex layer = 0; layer + 1 < layers.num_layers(vertex.host); ++layer) {
      arrays.point_ids.push_back(mesh.ids.num_vertices() + layers.first_point(vertex) + layer);
      owner.push_back(layers.owner(vertex.host));
    }
    if (!layered.has_own_end(row)) continue;
    const NumberedVertex end = ends.next(vertex);
    arrays.point_ids.push_back(end.id);
    owner.push_back(end.owner);
  }
}

// All but the positions and corners, which the piece itself gives away.
mesh::MeshArrays tet_arrays(const mesh::Piece& piece, mesh::MeshArrays arrays,
                            const WriteContext& mesh, bool with_quality)
{
  arrays.cell_ids.resize(at(piece.num_tets()));
  std::iota(arrays.cell_ids.begin(), arrays.cell_ids.end(), mesh.ids.first_tet(piece.subdomain));
  arrays.cell_ints["attribute"].assign(at(piece.num_tets()), mesh.coarse.body(piece.material));
  arrays.cell_ints["subdomain"].assign(at(piece.num_tets()), piece.subdomain);
  if (with_quality) {
    auto& mean_ratio = arrays.cell_doubles["mean_ratio"];
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      mean_ratio.push_back(quality::mean_ratio(piece.corners(t)));
    }
  }
  return arrays;
}

// Puts in cells and only the points that they use, in the order of the piece.
void add_cells(const std::vector<LocalIndex>& vertices, const mesh::Piece& piece,
               const mesh::MeshArrays& tets, mesh::MeshArrays& arrays)
{
  std::vector<LocalIndex> new_point(at(piece.num_vertices()), kNoIndex);
  for (const LocalIndex v : vertices) new_point[at(v)] = 0;
  auto& owner = arrays.point_ints["owner"];
  for (std::size_t v = 0; v < new_point.size(); ++v) {
    if (new_point[v] == kNoIndex) continue;
    new_point[v] = static_cast<LocalIndex>(arrays.point_ids.size());
    arrays.point_xyz.insert(arrays.point_xyz.end(), &piece.vertex_xyz[3 * v],
                            &piece.vertex_xyz[3 * v] + 3);
    arrays.point_ids.push_back(tets.point_ids[v]);
    owner.push_back(tets.point_ints.at("owner")[v]);
  }
  for (const LocalIndex v : vertices) arrays.cell_points.push_back(new_point[at(v)]);
}

mesh::MeshArrays boundary_arrays(const mesh::Piece& piece, const mesh::MeshArrays& tets,
                                 const WriteContext& mesh)
{
  mesh::MeshArrays arrays = with_names(mesh);
  arrays.vertices_per_cell = piece.is_of_second_order() ? 6 : 3;
  add_cells(with_nodes(piece.boundary_vertices, 3, piece.boundary_edge_nodes, 3), piece, tets,
            arrays);
  arrays.cell_ids.resize(at(piece.num_boundary()));
  std::iota(arrays.cell_ids.begin(), arrays.cell_ids.end(),
            mesh.ids.first_boundary_triangle(piece.subdomain));
  arrays.cell_ints["patch"] = rows_of_patches(piece.boundary_patch, mesh.coarse);
  arrays.cell_ints["subdomain"].assign(at(piece.num_boundary()), piece.subdomain);
  auto& tet = arrays.cell_longs["tet"];
  for (const LocalIndex t : piece.boundary_tet) tet.push_back(tets.cell_ids[at(t)]);
  return arrays;
}

mesh::MeshArrays line_arrays(const mesh::Piece& piece, const mesh::MeshArrays& tets,
                             const WriteContext& mesh)
{
  mesh::MeshArrays arrays{.vertices_per_cell = piece.is_of_second_order() ? 3 : 2,
                          .are_edges = true};
  std::vector<std::string> names = mesh::line_names(mesh.coarse);
  if (names.empty()) return arrays;
  arrays.field_texts["line_names"] = std::move(names);
  add_cells(with_nodes(piece.line_vertices, 2, piece.line_nodes, 1), piece, tets, arrays);
  arrays.cell_ids.resize(at(piece.num_line_edges()));
  std::iota(arrays.cell_ids.begin(), arrays.cell_ids.end(),
            mesh.ids.first_line_edge(piece.subdomain));
  arrays.cell_ints["line"] = piece.line;
  arrays.cell_ints["subdomain"].assign(at(piece.num_line_edges()), piece.subdomain);
  return arrays;
}

}  // namespace

std::vector<std::string> names_of_rows(const mesh::CoarseMesh& coarse)
{
  if (coarse.patch_row.empty()) return coarse.patch_names;
  std::vector<std::string> names;
  for (LocalIndex p = 0; p < coarse.num_patches(); ++p) {
    const bool is_first = at(coarse.patch_row[at(p)]) == names.size();
    if (is_first) names.push_back(coarse.patch_names[at(p)]);
  }
  return names;
}

PieceArrays piece_arrays(mesh::Piece piece, const WriteContext& mesh, bool with_quality)
{
  mesh::MeshArrays points = with_names(mesh);
  add_points(piece, mesh, points);
  if (mesh.layers != nullptr) {
    LayeredPiece layered = with_layers(std::move(piece), *mesh.layers);
    add_layer_points(layered, mesh, points);
    points.cell_ints["layer"] = std::move(layered.tet_layer);
    points.cell_ints["tet_of_prism"] = std::move(layered.tet_of_prism);
    piece = std::move(layered.piece);
  }
  PieceArrays arrays;
  arrays.tets = tet_arrays(piece, std::move(points), mesh, with_quality);
  arrays.boundary = boundary_arrays(piece, arrays.tets, mesh);
  arrays.lines = line_arrays(piece, arrays.tets, mesh);
  arrays.tets.point_xyz = std::move(piece.vertex_xyz);
  if (piece.is_of_second_order()) arrays.tets.vertices_per_cell = 10;
  arrays.tets.cell_points = with_nodes(std::move(piece.tet_vertices), 4, piece.tet_edge_nodes, 6);
  return arrays;
}

Hash128 digest_of(const mesh::MeshArrays& tets)
{
  if (tets.vertices_per_cell == 10) {
    return hash_quadratic_tets(tets.cell_points, tets.point_ids, tets.point_xyz,
                               tets.cell_ints.at("attribute"));
  }
  return hash_tets(tets.cell_points, tets.point_ids, tets.point_xyz,
                   tets.cell_ints.at("attribute"));
}

}  // namespace tessera::subdomain

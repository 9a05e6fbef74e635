// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_files.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::testing {
namespace {

// Adds cells to a piece, and their points with position and id when they are new.
class PieceBuilder {
 public:
  PieceBuilder(const mesh::CoarseMesh& mesh, const std::vector<GlobalIndex>& vertex_ids, int width)
      : mesh_(mesh), vertex_ids_(vertex_ids)
  {
    arrays_.vertices_per_cell = width;
  }

  void add_corner(LocalIndex v)
  {
    const auto [entry, is_new] = row_.emplace(v, static_cast<LocalIndex>(arrays_.num_points()));
    if (is_new) {
      const Vec3 x = mesh_.position(v);
      arrays_.point_xyz.insert(arrays_.point_xyz.end(), x.begin(), x.end());
      arrays_.point_ids.push_back(vertex_ids_[at(v)]);
    }
    arrays_.cell_points.push_back(entry->second);
  }

  [[nodiscard]] mesh::MeshArrays& arrays() { return arrays_; }

 private:
  const mesh::CoarseMesh& mesh_;
  const std::vector<GlobalIndex>& vertex_ids_;
  std::map<LocalIndex, LocalIndex> row_{};
  mesh::MeshArrays arrays_{};
};

struct Numbering {
  std::vector<LocalIndex> tet_piece{};
  std::vector<GlobalIndex> tet_ids{};
  std::vector<GlobalIndex> vertex_ids{};
};

Numbering number(const mesh::CoarseMesh& mesh, int num_pieces)
{
  Numbering numbering;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    double x = 0.0;
    for (const LocalIndex v : mesh.tet(t)) x += 0.25 * mesh.position(v)[0];
    numbering.tet_piece.push_back(static_cast<LocalIndex>(x * num_pieces));
  }
  numbering.tet_ids.assign(at(mesh.num_tets()), -1);
  numbering.vertex_ids.assign(at(mesh.num_vertices()), -1);
  GlobalIndex next_tet = 0;
  GlobalIndex next_vertex = 0;
  for (LocalIndex p = 0; p < num_pieces; ++p) {
    for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
      if (numbering.tet_piece[at(t)] != p) continue;
      numbering.tet_ids[at(t)] = next_tet++;
      for (const LocalIndex v : mesh.tet(t))
        if (numbering.vertex_ids[at(v)] < 0) numbering.vertex_ids[at(v)] = next_vertex++;
    }
  }
  return numbering;
}

void add_boundary_triangle(PieceBuilder& builder, const mesh::CoarseMesh& mesh,
                           const mesh::TriangleTets& triangle, const Numbering& numbering)
{
  const LocalIndex tet = triangle.tets[0];
  for (const std::size_t corner : mesh::kTetFaceCorners[at(triangle.corners[0])])
    builder.add_corner(mesh.tet(tet)[corner]);
  builder.arrays().cell_ints["patch"].push_back(0);
  builder.arrays().cell_ints["subdomain"].push_back(numbering.tet_piece[at(tet)]);
  builder.arrays().cell_longs["tet"].push_back(numbering.tet_ids[at(tet)]);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from)
{
  to.insert(to.end(), from.begin(), from.end());
}

mesh::MeshArrays merge_range(const std::vector<mesh::MeshArrays>& pieces, std::size_t begin,
                             std::size_t end)
{
  mesh::MeshArrays merged;
  merged.vertices_per_cell = pieces[begin].vertices_per_cell;
  std::map<GlobalIndex, LocalIndex> row;
  for (std::size_t p = begin; p < end; ++p) {
    const mesh::MeshArrays& piece = pieces[p];
    for (const LocalIndex point : piece.cell_points) {
      const auto i = static_cast<std::size_t>(point);
      const auto next = static_cast<LocalIndex>(merged.num_points());
      const auto [entry, is_new] = row.emplace(piece.point_ids[i], next);
      if (is_new) {
        merged.point_ids.push_back(piece.point_ids[i]);
        merged.point_xyz.insert(merged.point_xyz.end(), &piece.point_xyz[3 * i],
                                &piece.point_xyz[3 * i] + 3);
      }
      merged.cell_points.push_back(entry->second);
    }
    append(merged.cell_ids, piece.cell_ids);
    for (const auto& [name, values] : piece.cell_ints)
      if (name != "subdomain") append(merged.cell_ints[name], values);
    for (const auto& [name, values] : piece.cell_longs) append(merged.cell_longs[name], values);
    merged.cell_ints["subdomain"].insert(merged.cell_ints["subdomain"].end(),
                                         static_cast<std::size_t>(piece.num_cells()),
                                         static_cast<std::int32_t>(p));
  }
  return merged;
}

}  // namespace

MeshFiles slice(const mesh::CoarseMesh& mesh, int num_pieces)
{
  const Numbering numbering = number(mesh, num_pieces);
  std::vector<PieceBuilder> tets;
  std::vector<PieceBuilder> boundary;
  for (int p = 0; p < num_pieces; ++p) {
    tets.emplace_back(mesh, numbering.vertex_ids, 4);
    boundary.emplace_back(mesh, numbering.vertex_ids, 3);
  }
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    PieceBuilder& builder = tets[at(numbering.tet_piece[at(t)])];
    for (const LocalIndex v : mesh.tet(t)) builder.add_corner(v);
    builder.arrays().cell_ids.push_back(numbering.tet_ids[at(t)]);
    builder.arrays().cell_ints["attribute"].push_back(mesh.tet_material[at(t)]);
  }
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
    const auto material = [&](std::size_t side) {
      return mesh.tet_material[at(triangle.tets[side])];
    };
    if (triangle.tets[1] != kNoIndex && material(0) == material(1)) continue;
    add_boundary_triangle(boundary[at(numbering.tet_piece[at(triangle.tets[0])])], mesh, triangle,
                          numbering);
  }
  MeshFiles files;
  for (PieceBuilder& builder : tets) files.tets.push_back(builder.arrays());
  for (PieceBuilder& builder : boundary) files.boundary.push_back(builder.arrays());
  return files;
}

MeshFiles merge(const MeshFiles& files, const std::vector<std::size_t>& first)
{
  MeshFiles merged;
  for (std::size_t f = 0; f + 1 < first.size(); ++f) {
    merged.tets.push_back(merge_range(files.tets, first[f], first[f + 1]));
    merged.boundary.push_back(merge_range(files.boundary, first[f], first[f + 1]));
  }
  return merged;
}

check::PieceSource source_of(const std::vector<mesh::MeshArrays>& pieces)
{
  return {static_cast<LocalIndex>(pieces.size()),
          [&](LocalIndex piece) { return pieces[at(piece)]; }};
}

std::size_t row_of_point(const mesh::MeshArrays& piece, GlobalIndex id)
{
  const auto found = std::find(piece.point_ids.begin(), piece.point_ids.end(), id);
  if (found == piece.point_ids.end()) throw std::logic_error("the piece lacks the point");
  return static_cast<std::size_t>(found - piece.point_ids.begin());
}

GlobalIndex shared_point(const mesh::MeshArrays& a, const mesh::MeshArrays& b)
{
  for (const GlobalIndex id : a.point_ids)
    if (std::find(b.point_ids.begin(), b.point_ids.end(), id) != b.point_ids.end()) return id;
  throw std::logic_error("the pieces share no point");
}

}  // namespace tessera::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/piece_complex.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"

namespace tessera::subdomain {
namespace {

LocalIndex row_in(const std::vector<mesh::HostPoint>& names, const mesh::HostPoint& name)
{
  return static_cast<LocalIndex>(std::ranges::lower_bound(names, name) - names.begin());
}

std::vector<mesh::HostPoint> names_of(const std::vector<const mesh::Piece*>& pieces)
{
  std::vector<mesh::HostPoint> names;
  for (const mesh::Piece* piece : pieces) {
    for (LocalIndex v = 0; v < piece->num_skin_vertices(); ++v) {
      names.push_back(piece->skin_point(v));
    }
  }
  sort_unique(names);
  return names;
}

// Appends the tets of one piece; its named vertices have their place already.
void append_piece(const mesh::Piece& piece, const std::vector<mesh::HostPoint>& names,
                  mesh::CoarseMesh& mesh)
{
  const std::span<const double> xyz(piece.vertex_xyz);
  std::vector<LocalIndex> number(at(piece.num_vertices()));
  for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
    number[at(v)] = row_in(names, piece.skin_point(v));
    std::ranges::copy(point_at(xyz, v), &mesh.vertex_xyz[3 * at(number[at(v)])]);
  }
  LocalIndex next = mesh.num_vertices();
  for (LocalIndex v = piece.num_skin_vertices(); v < piece.num_vertices(); ++v) {
    number[at(v)] = next++;
  }
  mesh.vertex_xyz.insert(mesh.vertex_xyz.end(),
                         piece.vertex_xyz.begin() + 3 * piece.num_skin_vertices(),
                         piece.vertex_xyz.end());
  for (const LocalIndex v : piece.tet_vertices) mesh.tet_vertices.push_back(number[at(v)]);
}

mesh::Skeleton skeleton_of(const number::SurfaceSimplices& surface,
                           const std::vector<mesh::HostPoint>& names)
{
  mesh::Skeleton skeleton;
  const auto append_rows = [&](const auto& simplices, FlatArray<LocalIndex>& rows) {
    for (const auto& simplex : simplices) {
      for (const mesh::HostPoint& name : simplex) rows.push_back(row_in(surface.vertices, name));
    }
  };
  for (const mesh::HostPoint& name : surface.vertices) {
    skeleton.vertex_coarse.push_back(row_in(names, name));
  }
  append_rows(surface.edges, skeleton.edge_vertices);
  append_rows(surface.triangles, skeleton.triangle_vertices);
  skeleton.edge_owner.resize(surface.edges.size());
  skeleton.triangle_patch.assign(surface.triangles.size(), kNoIndex);
  skeleton.triangle_subdomains.assign(2 * surface.triangles.size(), kNoIndex);
  return skeleton;
}

}  // namespace

PieceComplex make_piece_complex(const mesh::Piece& piece, std::span<const mesh::Piece> halos,
                                const number::SurfaceSimplices& surface)
{
  std::vector<const mesh::Piece*> pieces{&piece};
  for (const mesh::Piece& halo : halos) pieces.push_back(&halo);
  std::ranges::sort(pieces, {}, [](const mesh::Piece* one) { return one->subdomain; });

  PieceComplex all{.names = names_of(pieces)};
  all.mesh.vertex_xyz.resize(3 * all.names.size());
  for (const mesh::Piece* one : pieces) {
    if (one == &piece) all.first_tet = all.mesh.num_tets();
    append_piece(*one, all.names, all.mesh);
    if (one == &piece) all.last_tet = all.mesh.num_tets();
  }
  all.surface = skeleton_of(surface, all.names);
  std::vector<LocalIndex> tets(at(all.mesh.num_tets()));
  std::iota(tets.begin(), tets.end(), 0);
  all.complex = mesh::tet_complex(all.mesh, all.surface, tets);
  if (all.complex.faces.num_vertices() != all.mesh.num_vertices()) {
    throw MeshError(fmt::format("piece {} has vertices of no tet", piece.subdomain));
  }
  return all;
}

}  // namespace tessera::subdomain

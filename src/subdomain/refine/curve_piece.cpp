// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/refine/curve_piece.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "tessera/base/quadratic_tet.hpp"
#include "tessera/subdomain/measure_piece.hpp"

namespace tessera::subdomain {
namespace {

constexpr LocalIndex kIntervals = 2;  // Of an edge with a node in its middle.

void put(const Vec3& point, LocalIndex vertex, mesh::Piece& piece)
{
  std::ranges::copy(point, &piece.vertex_xyz[3 * at(vertex)]);
}

}  // namespace

PieceCurver::PieceCurver(const mesh::Piece& piece, const PieceSurroundings& around,
                         const SplitSurface& surface)
    : piece_(piece), around_(around), surface_(surface), all_(surface.all())
{
}

RefinedPiece PieceCurver::run(const refine::RefineContext& refine, const PieceSummary& before) const
{
  const mesh::RefinedLattice points =
      surface_.points(surface_.known_points(refine), refine.limiter);
  const mesh::Skin skin = surface_.named_skin(points);
  RefinedPiece made;
  made.filled.piece = curved(skin, points);
  double least = 1.0;
  std::vector<LocalIndex> invalid;
  for (LocalIndex t = 0; t < made.filled.piece.num_tets(); ++t) {
    const JacobianBounds bounds = jacobian_bounds(made.filled.piece.nodes(t));
    least = std::min(least, bounds.scaled_jacobian());
    if (!bounds.is_positive()) invalid.push_back(all_.first_tet + t);
  }
  if (!invalid.empty()) {
    RefinedPiece folded;
    folded.folds = surface_.limits_at(invalid);
    folded.filled.result.summary = before;
    folded.filled.result.summary.is_folded = true;
    return folded;
  }
  made.filled.result = measure(made.filled.piece, skin, before);
  PieceSummary& summary = made.filled.result.summary;
  summary.min_scaled_jacobian = least;
  summary.num_held_back = points.distance.num_held_back;
  summary.model_distance = points.distance.largest;
  summary.held_back_distance = points.distance.largest_held_back;
  return made;
}

mesh::Piece PieceCurver::curved(const mesh::Skin& skin, const mesh::RefinedLattice& points) const
{
  const mesh::LatticeNumbering numbering(all_.complex.faces, points.levels());
  mesh::Piece curved{.subdomain = piece_.subdomain,
                     .material = piece_.material,
                     .skin_host = skin.vertex_host,
                     .skin_index = skin.vertex_index,
                     .boundary_patch = piece_.boundary_patch,
                     .boundary_tet = piece_.boundary_tet};
  place_nodes(points, numbering, curved);
  add_tets(numbering, curved);
  add_boundary(curved);
  add_lines(numbering, curved);
  return curved;
}

void PieceCurver::place_nodes(const mesh::RefinedLattice& points,
                              const mesh::LatticeNumbering& numbering, mesh::Piece& curved) const
{
  const mesh::Complex& faces = all_.complex.faces;
  curved.vertex_xyz.resize(3 * at(numbering.num_points()));
  for (LocalIndex v = 0; v < faces.num_vertices(); ++v) {
    put(point_at(std::span<const double>(all_.mesh.vertex_xyz), v), numbering.vertex(v), curved);
  }
  for (LocalIndex e = 0; e < faces.num_edges(); ++e) {
    put(points.edge_point(e, 1), numbering.edge_point(e, 1), curved);
  }
}

void PieceCurver::add_tets(const mesh::LatticeNumbering& numbering, mesh::Piece& curved) const
{
  for (LocalIndex t = all_.first_tet; t < all_.last_tet; ++t) {
    const LocalIndex* corners = &all_.complex.tet_vertices[4 * at(t)];
    for (std::size_t c = 0; c < 4; ++c) {
      curved.tet_vertices.push_back(numbering.vertex(corners[c]));
    }
    for (const auto& [a, b] : kQuadraticTetEdges) {
      const auto [low, high] = std::minmax(corners[a], corners[b]);
      const LocalIndex edge = mesh::find_edge(all_.complex.faces, {low, high});
      curved.tet_edge_nodes.push_back(numbering.edge_point(edge, 1));
    }
  }
}

// Corners and nodes are those of the tet behind.
void PieceCurver::add_boundary(mesh::Piece& curved) const
{
  for (std::size_t row = 0; row < piece_.boundary_tet.size(); ++row) {
    const std::size_t tet = at(piece_.boundary_tet[row]);
    const LocalIndex* before = &piece_.tet_vertices[4 * tet];
    std::array<std::size_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = static_cast<std::size_t>(
          std::find(before, before + 4, piece_.boundary_vertices[3 * row + i]) - before);
      curved.boundary_vertices.push_back(curved.tet_vertices[4 * tet + corners[i]]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t edge = row_of_edge(corners[i], corners[(i + 1) % 3]);
      curved.boundary_edge_nodes.push_back(curved.tet_edge_nodes[6 * tet + edge]);
    }
  }
}

void PieceCurver::add_lines(const mesh::LatticeNumbering& numbering, mesh::Piece& curved) const
{
  curved.line = piece_.line;
  for (const LocalIndex edge : surface_.edges_on_lines()) {
    curved.line_vertices.push_back(numbering.edge_point(edge, 0));
    curved.line_vertices.push_back(numbering.edge_point(edge, kIntervals));
    curved.line_nodes.push_back(numbering.edge_point(edge, 1));
  }
}

// Shapes are those of the straight tets. The hashes of the surface are those of its four small
// triangles a face, so that they hold the nodes as well.
FillResult PieceCurver::measure(const mesh::Piece& curved, const mesh::Skin& skin,
                                const PieceSummary& before) const
{
  const auto on_seam = surface_.surface_flags(
      at(skin.num_vertices()),
      [&](std::size_t simplex, mesh::HostKind kind) { return surface_.is_on_seam(simplex, kind); });
  FillResult result =
      measure_split_piece(curved, skin, all_.surface, {}, {on_seam.begin(), on_seam.end()}, before);
  PieceSummary& summary = result.summary;
  summary.volume = 0.0;
  for (LocalIndex t = 0; t < curved.num_tets(); ++t) {
    summary.volume += curved_volume(curved.nodes(t));
  }
  summary.num_owned_vertices =
      summary.num_interior_vertices + around_.shared.owned.num_points(kIntervals);
  return result;
}

}  // namespace tessera::subdomain

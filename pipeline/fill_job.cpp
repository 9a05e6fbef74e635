// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/fill_job.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tessera/fill/check.hpp"
#include "tessera/fill/size_samples.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/refine/skin.hpp"

namespace tessera::pipeline {
namespace {

// Triangles on the geometry that this subdomain owns: all on the outside, and those between two
// materials if it is the lower side.
void add_boundary(const mesh::Skin& skin, const mesh::Skeleton& skeleton,
                  const std::vector<LocalIndex>& triangle_tet, mesh::Piece& piece)
{
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    const LocalIndex parent = skin.triangle_parent[at(t)];
    const LocalIndex patch = skeleton.triangle_patch[at(parent)];
    if (patch == kNoIndex || skeleton.triangle_owner(parent) != piece.subdomain) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      piece.boundary_vertices.push_back(skin.triangle_vertices[3 * at(t) + c]);
    }
    piece.boundary_patch.push_back(patch);
    piece.boundary_tet.push_back(triangle_tet[at(t)]);
  }
}

double outside_area(const mesh::Skin& skin, const mesh::Skeleton& skeleton)
{
  const std::span<const double> xyz(skin.vertex_xyz);
  double area = 0.0;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    if (skeleton.is_inside(skin.triangle_parent[at(t)])) continue;
    const LocalIndex* v = &skin.triangle_vertices[3 * at(t)];
    const Vec3 a = point_at(xyz, v[0]);
    area += 0.5 * norm(cross(point_at(xyz, v[1]) - a, point_at(xyz, v[2]) - a));
  }
  return area;
}

std::vector<std::array<LocalIndex, 2>> edges_of(const mesh::Piece& piece)
{
  std::vector<std::array<LocalIndex, 2>> edges;
  edges.reserve(6 * at(piece.num_tets()));
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const LocalIndex* v = &piece.tet_vertices[4 * at(t)];
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      edges.push_back({std::min(v[a], v[b]), std::max(v[a], v[b])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

// Edge lengths, and the Euler characteristic with the edges' number.
void measure_edges(const mesh::Piece& piece, LocalIndex num_skin_triangles, FillResult& result)
{
  const auto edges = edges_of(piece);
  const std::span<const double> xyz(piece.vertex_xyz);
  for (const auto& [a, b] : edges) {
    const double length = norm(point_at(xyz, b) - point_at(xyz, a));
    result.histograms.log2_edge_length.add(std::log2(length));
  }
  const GlobalIndex num_tets = piece.num_tets();
  const GlobalIndex num_triangles = (4 * num_tets + num_skin_triangles) / 2;
  result.summary.euler_characteristic =
      piece.num_vertices() - static_cast<GlobalIndex>(edges.size()) + num_triangles - num_tets;
}

void measure_tets(const mesh::Piece& piece, const std::vector<char>& seam_units, FillResult& result)
{
  const auto on_seam = [&](LocalIndex v) {
    return v < piece.num_skin_vertices() && seam_units[at(piece.skin_unit[at(v)])] != 0;
  };
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const auto corners = piece.corners(t);
    quality::add_tet(corners, result.summary.tets, result.histograms.mean_ratio);
    const LocalIndex* v = &piece.tet_vertices[4 * at(t)];
    if (std::any_of(v, v + 4, on_seam)) {
      quality::add_tet(corners, result.summary.seam_tets, result.histograms.seam_mean_ratio);
    }
  }
}

}  // namespace

FilledPiece fill_subdomain(const FillContext& context, LocalIndex subdomain,
                           const fill::Kernel& kernel, const fill::FillTry& settings)
{
  const mesh::Skeleton& skeleton = context.refine.skeleton;
  const mesh::Complex complex = mesh::skin_complex(skeleton, subdomain);
  const mesh::RefinedLattice lattice = refine::refine_lattice(complex, context.refine);
  mesh::Skin skin = refine::extract_skin(complex, lattice, skeleton, subdomain);

  fill::FillInput input{.vertex_xyz = skin.vertex_xyz, .triangle_vertices = skin.triangle_vertices};
  fill::add_size_samples(context.refine.coarse, context.decomposition, subdomain,
                         context.vertex_size, context.refine.levels, input);
  fill::FillOutput tets = kernel.fill(input, settings);
  const fill::FillFacts facts = fill::check_fill(input, tets);

  FilledPiece filled;
  mesh::Piece& piece = filled.piece;
  piece.subdomain = subdomain;
  piece.material = context.decomposition.subdomain_material[at(subdomain)];
  piece.vertex_xyz = std::move(tets.vertex_xyz);
  piece.skin_unit = skin.vertex_unit;
  piece.skin_index = skin.vertex_index;
  piece.tet_vertices = std::move(tets.tet_vertices);
  add_boundary(skin, skeleton, facts.triangle_tet, piece);

  PieceSummary& summary = filled.result.summary;
  summary.subdomain = subdomain;
  summary.material = piece.material;
  summary.num_tets = piece.num_tets();
  summary.num_interior_vertices = piece.num_interior_vertices();
  summary.num_boundary = piece.num_boundary();
  summary.num_damped = lattice.distance.num_damped;
  summary.model_distance = lattice.distance.largest;
  summary.damped_distance = lattice.distance.largest_damped;
  summary.volume = facts.volume;
  summary.boundary_area = outside_area(skin, skeleton);
  measure_edges(piece, skin.num_triangles(), filled.result);
  measure_tets(piece, context.seam_units, filled.result);
  filled.result.seams = verify::seam_hashes(skin, skeleton);
  return filled;
}

}  // namespace tessera::pipeline

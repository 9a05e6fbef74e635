// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/refine/split_surface.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/refine/skin.hpp"

namespace tessera::subdomain {

namespace lattice = mesh::lattice;

SplitSurface::SplitSurface(const mesh::Piece& piece, const PieceSurroundings& around,
                           const PartitionedMesh& cut, const GeometryFinder& finder, int splits)
    : piece_(piece),
      around_(around),
      cut_(cut),
      finder_(finder),
      splits_(splits),
      n_(lattice::intervals(splits)),
      all_(make_piece_complex(piece, around.halos, around.surface.simplices)),
      skin_(mesh::skin_complex(cut.skeleton, piece.subdomain)),
      places_(finder.find(all_.complex.faces, all_.names))
{
  tie_surface_to_geometry();
  order_places_by_need();
}

mesh::RefinedLattice SplitSurface::points(const mesh::RefinedLattice& known,
                                          const mesh::ProjectionLimiter& limiter) const
{
  mesh::RefinedLattice points = midpoint_lattice(all_.complex.faces, all_.mesh.vertex_xyz,
                                                 {places_, known, cut_.skeleton, limiter}, splits_);
  points.distance = known.distance;
  return points;
}

mesh::Skin SplitSurface::named_skin(const mesh::RefinedLattice& points) const
{
  const mesh::HostLayout hosts(cut_.skeleton);
  const mesh::Complex& faces = all_.complex.faces;
  const auto& places = around_.places;
  mesh::Skin skin = refine::extract_skin(faces, points, all_.surface, piece_.subdomain);
  for_each_surface_simplex(
      [&](std::size_t simplex, mesh::HostKind kind, LocalIndex first, LocalIndex num_points) {
        const number::SimplexPlace& place =
            kind == mesh::HostKind::vertex ? places.vertices[at(faces.vertex_skeleton[simplex])]
            : kind == mesh::HostKind::edge ? places.edges[at(faces.edge_skeleton[simplex])]
                                           : places.triangles[at(faces.triangle_skeleton[simplex])];
        for (LocalIndex i = 0; i < num_points; ++i) {
          skin.vertex_host[at(first + i)] = hosts.piece(place.owner);
          skin.vertex_index[at(first + i)] = place.first + i;
        }
      });
  return skin;
}

// Patches and sides of the piece's surface, as subdivision asks them of a skeleton.
void SplitSurface::tie_surface_to_geometry()
{
  mesh::Skeleton& surface = all_.surface;
  const mesh::Complex& faces = all_.complex.faces;
  const std::span<const LocalIndex> triangles =
      std::span(all_.complex.tet_triangles)
          .subspan(4 * at(all_.first_tet), 4 * at(all_.last_tet - all_.first_tet));
  std::vector<char> num_tets(at(faces.num_triangles()), 0);
  for (const LocalIndex row : triangles) ++num_tets[at(row)];
  for (std::size_t face = 0; face < triangles.size(); ++face) {
    const LocalIndex row = triangles[face];
    if (num_tets[at(row)] != 1) continue;
    const LocalIndex own = faces.triangle_skeleton[at(row)];
    if (own == kNoIndex) {
      throw MeshError(fmt::format("piece {} has a face that its list lacks", piece_.subdomain));
    }
    const GeometryPlace& place = places_.of_triangles[at(row)];
    const bool points_out =
        is_outward(all_.first_tet + static_cast<LocalIndex>(face / 4), face % 4);
    LocalIndex* sides = &surface.triangle_subdomains[2 * at(own)];
    sides[points_out ? 0 : 1] = piece_.subdomain;
    sides[points_out ? 1 : 0] = other_side(place);
    if (!place.is_on_geometry()) continue;
    surface.triangle_patch[at(own)] =
        cut_.skeleton.triangle_patch[at(places_.triangles[at(place.triangle)])];
  }
}

// Whether vertices inside this simplex of the complex move with the seam that it lies on.
bool SplitSurface::is_free_on_seam(std::size_t simplex, mesh::HostKind kind) const
{
  return is_of_surface(simplex, kind) && is_on_seam(simplex, kind)
         && !is_on_geometry(simplex, kind);
}
bool SplitSurface::is_of_surface(std::size_t simplex, mesh::HostKind kind) const
{
  const mesh::Complex& faces = all_.complex.faces;
  switch (kind) {
    case mesh::HostKind::vertex:
      return faces.vertex_skeleton[simplex] != kNoIndex;
    case mesh::HostKind::edge:
      return faces.edge_skeleton[simplex] != kNoIndex;
    default:
      return faces.triangle_skeleton[simplex] != kNoIndex;
  }
}

// Its own tets, and those of the neighbours with vertices that move with a seam.
bool SplitSurface::needs_points_of(LocalIndex tet) const
{
  if (all_.first_tet <= tet && tet < all_.last_tet) return true;
  bool has_free = false;
  for_each_face_of(tet, [&](std::size_t simplex, mesh::HostKind kind) {
    has_free = has_free || is_free_on_seam(simplex, kind);
  });
  return has_free;
}

// Which of places_.triangles have points that matter.
std::vector<char> SplitSurface::needed_places() const
{
  std::vector<char> is_needed(places_.triangles.size(), 0);
  const auto need = [&](const GeometryPlace& place) {
    if (place.is_on_geometry()) is_needed[at(place.triangle)] = 1;
  };
  for (LocalIndex tet = 0; tet < all_.mesh.num_tets(); ++tet) {
    if (!needs_points_of(tet)) continue;
    for_each_face_of(tet, [&](std::size_t simplex, mesh::HostKind kind) {
      if (kind == mesh::HostKind::edge) need(places_.edges[simplex]);
      if (kind == mesh::HostKind::triangle) need(places_.of_triangles[simplex]);
    });
  }
  return is_needed;
}

// The skin's triangles first, then others with points that matter. The rest comes last:
// projection is dear, and nobody asks for these points.
void SplitSurface::order_places_by_need()
{
  const std::vector<char> is_needed = needed_places();
  const auto skin = cut_.skeleton.triangles_of(piece_.subdomain);
  std::vector<LocalIndex> order(skin.begin(), skin.end());
  const auto append = [&](char need) {
    for (std::size_t row = 0; row < is_needed.size(); ++row) {
      const LocalIndex triangle = places_.triangles[row];
      const bool is_of_skin = std::ranges::binary_search(skin, triangle);
      if (!is_of_skin && is_needed[row] == need) order.push_back(triangle);
    }
  };
  append(1);
  places_.num_known = static_cast<LocalIndex>(order.size());
  append(0);
  std::map<LocalIndex, LocalIndex> row_of;
  for (std::size_t row = 0; row < order.size(); ++row) {
    row_of.emplace(order[row], static_cast<LocalIndex>(row));
  }
  for (auto* const list : {&places_.edges, &places_.of_triangles}) {
    for (GeometryPlace& place : *list) {
      if (place.is_on_geometry()) {
        place.triangle = row_of.at(places_.triangles[at(place.triangle)]);
      }
    }
  }
  places_.triangles = std::move(order);
}

mesh::RefinedLattice SplitSurface::known_points(const refine::RefineContext& refine) const
{
  mesh::RefinedLattice known = refine::refine_lattice(skin_, levels_of(skin_), refine);
  const auto num_of_skin = cut_.skeleton.triangles_of(piece_.subdomain).size();
  const std::span<const LocalIndex> others =
      std::span(places_.triangles).subspan(num_of_skin, at(places_.num_known) - num_of_skin);
  refine::RefineContext unmeasured = refine;
  unmeasured.measure_distance = false;
  const mesh::Complex beside = mesh::skeleton_complex(cut_.skeleton, others);
  known.append_triangles(refine::refine_lattice(beside, levels_of(beside), unmeasured));
  return known;
}

// Of triangles of the skeleton after the split. A side has the level of its finest triangle: more
// than the mesh needs where another side of that triangle is finer.
mesh::LatticeLevels SplitSurface::levels_of(const mesh::Complex& complex) const
{
  mesh::LatticeLevels levels{.edges = std::vector<std::int8_t>(at(complex.num_edges()), 0)};
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    const int level = finder_.level_of(complex.triangle_skeleton[at(t)]) + splits_;
    levels.triangles.push_back(static_cast<std::int8_t>(level));
    for (std::size_t side = 0; side < 3; ++side) {
      std::int8_t& of_side = levels.edges[at(complex.triangle_edges[3 * at(t) + side])];
      of_side = std::max(of_side, levels.triangles.back());
    }
  }
  return levels;
}

// Whether the ascending orientation of a face of a tet points out of it.
bool SplitSurface::is_outward(LocalIndex tet, std::size_t corner) const
{
  const auto v = all_.mesh.tet(tet);
  const auto& [a, b, c] = mesh::kTetFaceCorners[corner];
  return mesh::is_even_triangle(v[a], v[b], v[c]);
}

// What lies across a face. Beyond a seam it is some piece of the same material.
LocalIndex SplitSurface::other_side(const GeometryPlace& place) const
{
  if (!place.is_on_geometry()) return cut_.num_subdomains();
  const LocalIndex triangle = places_.triangles[at(place.triangle)];
  const LocalIndex* sides = &cut_.skeleton.triangle_subdomains[2 * at(triangle)];
  const auto is_of_own_material = [&](LocalIndex subdomain) {
    return subdomain != kNoIndex
           && cut_.decomposition.subdomain_material[at(subdomain)] == piece_.material;
  };
  return is_of_own_material(sides[0]) ? sides[1] : sides[0];
}

bool SplitSurface::is_on_geometry(std::size_t simplex, mesh::HostKind kind) const
{
  switch (kind) {
    case mesh::HostKind::vertex:
      return places_.vertex_on_geometry[simplex] != 0;
    case mesh::HostKind::edge:
      return places_.edges[simplex].is_on_geometry() || places_.edge_on_line[simplex] != 0;
    default:
      return places_.of_triangles[simplex].is_on_geometry();
  }
}

bool SplitSurface::is_on_seam(std::size_t simplex, mesh::HostKind kind) const
{
  const mesh::Complex& faces = all_.complex.faces;
  switch (kind) {
    case mesh::HostKind::vertex:
      return around_.shared.vertex_on_seam[at(faces.vertex_skeleton[simplex])] != 0;
    case mesh::HostKind::edge:
      return around_.shared.edge_on_seam[at(faces.edge_skeleton[simplex])] != 0;
    default:
      return around_.shared.triangle_on_seam[at(faces.triangle_skeleton[simplex])] != 0;
  }
}

std::vector<LocalIndex> SplitSurface::edges_on_lines() const
{
  const auto vertex = [&](LocalIndex v) {
    const auto found = std::ranges::lower_bound(all_.names, piece_.skin_point(v));
    return static_cast<LocalIndex>(found - all_.names.begin());
  };
  std::vector<LocalIndex> edges;
  for (std::size_t row = 0; row < piece_.line.size(); ++row) {
    const LocalIndex a = vertex(piece_.line_vertices[2 * row]);
    const LocalIndex b = vertex(piece_.line_vertices[2 * row + 1]);
    edges.push_back(mesh::find_edge(all_.complex.faces, {std::min(a, b), std::max(a, b)}));
    if (edges.back() == kNoIndex) {
      throw MeshError(
          fmt::format("piece {} has lost an edge on a line inside of solids", piece_.subdomain));
    }
  }
  return edges;
}

std::vector<mesh::PointLimit> SplitSurface::limits_at(const std::vector<LocalIndex>& tets) const
{
  std::vector<LocalIndex> triangles;
  for (const LocalIndex tet : tets) {
    const LocalIndex* faces = &all_.complex.tet_triangles[4 * at(tet)];
    triangles.insert(triangles.end(), faces, faces + 4);
  }
  return limits_at_triangles(triangles);
}

std::vector<mesh::PointLimit> SplitSurface::limits_at_triangles(
    const std::vector<LocalIndex>& triangles) const
{
  std::vector<mesh::PointLimit> limits;
  const auto hold_back = [&](const GeometryPlace& place, LocalIndex i, LocalIndex j) {
    if (!place.is_on_geometry()) return;
    const LocalIndex triangle = places_.triangles[at(place.triangle)];
    const LocalIndex n = intervals_of_triangle(triangle);
    limits.push_back({key_of(cut_.skeleton, triangle, n, place.point(n_, i, j)), 0.0});
  };
  const mesh::Complex& faces = all_.complex.faces;
  for (const LocalIndex t : triangles) {
    for (std::size_t side = 0; side < 3; ++side) {
      const GeometryPlace& edge = places_.edges[at(faces.triangle_edges[3 * at(t) + side])];
      for (LocalIndex k = 1; k < n_; ++k) hold_back(edge, k, 0);
    }
    for (LocalIndex j = 1; j < n_; ++j) {
      for (LocalIndex i = 1; i + j < n_; ++i) hold_back(places_.of_triangles[at(t)], i, j);
    }
  }
  return limits;
}

}  // namespace tessera::subdomain

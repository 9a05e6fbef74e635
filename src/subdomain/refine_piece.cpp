// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/refine_piece.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/fill/check.hpp"
#include "tessera/fill/subdivide.hpp"
#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/optimize/smooth.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/measure_piece.hpp"

#include "subdomain/boundary_triangles.hpp"
#include "subdomain/geometry_places.hpp"
#include "subdomain/piece_complex.hpp"

namespace tessera::subdomain {

struct PieceRefiner::State {
  const PartitionedMesh& cut;
  int levels;
  mesh::HostLayout hosts;
  GeometryFinder finder;
};

namespace {

namespace lattice = mesh::lattice;

// Children of good tets are good: once over all vertices, then twice over those of bad tets. On
// shaft (L = 2 + 2) that gives 0.897, 0.746, 19.7 deg, and one more pass over all 0.901, 0.753,
// 19.4 deg for half the time again.
optimize::Schedule smoothing() { return {.steps = optimize::parse_steps("mww")}; }

// Splits one piece; lives for one call of refine().
class PieceSplitter {
 public:
  PieceSplitter(const mesh::Piece& piece, const PieceSurroundings& around,
                const refine::RefineContext& refine, const PartitionedMesh& cut, int levels)
      : piece_(piece),
        around_(around),
        refine_(refine),
        cut_(cut),
        hosts_(cut.skeleton),
        n_(lattice::intervals(refine.levels - levels)),
        all_(make_piece_complex(piece, around.halos, around.surface.simplices))
  {
  }

  RefinedPiece run(const GeometryFinder& finder, const PieceSummary& before)
  {
    places_ = finder.find(all_.complex.faces, all_.names);
    tie_surface_to_geometry();
    order_places_by_need();
    const mesh::RefinedLattice geometry = lattice_of_known_places();
    const mesh::RefinedLattice points =
        midpoint_lattice(all_.complex.faces, all_.mesh.vertex_xyz, places_, geometry, n_);
    fill::FillOutput tets = fill::subdivide(all_.complex, points);
    if (around_.is_smoothed) smooth_seams(tets);
    tets = own_tets(std::move(tets));
    if (around_.is_smoothed) smooth_inside(tets);
    RefinedPiece refined;
    if (!fill::all_positive(tets)) {
      refined.folds = limits_at(folded_parents(fill::subdivide(all_.complex, points)));
      refined.filled.result.summary = before;
      refined.filled.result.summary.is_folded = true;
      return refined;
    }
    const mesh::Skin skin = skin_of(points, tets);
    refined.filled = check_and_measure(skin, std::move(tets), before);
    PieceSummary& summary = refined.filled.result.summary;
    summary.num_held_back = geometry.distance.num_held_back;
    summary.model_distance = geometry.distance.largest;
    summary.held_back_distance = geometry.distance.largest_held_back;
    return refined;
  }

 private:
  [[nodiscard]] LocalIndex num_children() const { return n_ * n_ * n_; }

  // Patches and sides of the piece's surface, as subdivision asks them of a skeleton.
  void tie_surface_to_geometry()
  {
    mesh::Skeleton& surface = all_.surface;
    const std::vector<mesh::TriangleTets> triangles = mesh::triangles_of_tets(own_corners());
    const mesh::Complex& faces = all_.complex.faces;
    for (const mesh::TriangleTets& triangle : triangles) {
      if (triangle.tets[1] != kNoIndex) continue;
      const LocalIndex row = mesh::find_triangle(faces, triangle.vertices);
      const LocalIndex own = faces.triangle_skeleton[at(row)];
      if (own == kNoIndex) throw MeshError(name() + " has a face that its list lacks");
      const GeometryPlace& place = places_.of_triangles[at(row)];
      const bool points_out = is_outward(triangle);
      LocalIndex* sides = &surface.triangle_subdomains[2 * at(own)];
      sides[points_out ? 0 : 1] = piece_.subdomain;
      sides[points_out ? 1 : 0] = other_side(place);
      if (!place.is_on_geometry()) continue;
      surface.triangle_patch[at(own)] =
          cut_.skeleton.triangle_patch[at(places_.triangles[at(place.triangle)])];
    }
  }

  // Whether vertices inside this simplex of the complex move with the seam that it lies on.
  [[nodiscard]] bool is_free_on_seam(std::size_t simplex, mesh::HostKind kind) const
  {
    return is_of_surface(simplex, kind) && is_on_seam(simplex, kind)
           && !is_on_geometry(simplex, kind);
  }

  [[nodiscard]] bool is_of_surface(std::size_t simplex, mesh::HostKind kind) const
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

  // Calls visit(simplex, kind) for the faces of a tet and their edges and vertices, for some more
  // than once.
  template <class Visit>
  void for_each_face_of(LocalIndex tet, Visit&& visit) const
  {
    for (std::size_t c = 0; c < 4; ++c) {
      visit(at(all_.complex.tet_vertices[4 * at(tet) + c]), mesh::HostKind::vertex);
      const std::size_t t = at(all_.complex.tet_triangles[4 * at(tet) + c]);
      visit(t, mesh::HostKind::triangle);
      for (std::size_t side = 0; side < 3; ++side) {
        visit(at(all_.complex.faces.triangle_edges[3 * t + side]), mesh::HostKind::edge);
      }
    }
  }

  // Its own tets, and those of the neighbours with vertices that move with a seam.
  [[nodiscard]] bool needs_points_of(LocalIndex tet) const
  {
    if (all_.first_tet <= tet && tet < all_.last_tet) return true;
    bool has_free = false;
    for_each_face_of(tet, [&](std::size_t simplex, mesh::HostKind kind) {
      has_free = has_free || is_free_on_seam(simplex, kind);
    });
    return has_free;
  }

  // Which of places_.triangles have points that matter.
  [[nodiscard]] std::vector<char> needed_places() const
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
  void order_places_by_need()
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

  // Distances to the model are those of the skin alone: other triangles are of other skins.
  [[nodiscard]] mesh::RefinedLattice lattice_of_known_places() const
  {
    mesh::RefinedLattice known =
        refine::refine_lattice(mesh::skin_complex(cut_.skeleton, piece_.subdomain), refine_);
    const auto num_of_skin = cut_.skeleton.triangles_of(piece_.subdomain).size();
    const std::span<const LocalIndex> others =
        std::span(places_.triangles).subspan(num_of_skin, at(places_.num_known) - num_of_skin);
    refine::RefineContext unmeasured = refine_;
    unmeasured.measure_distance = false;
    const mesh::RefinedLattice more =
        refine::refine_lattice(mesh::skeleton_complex(cut_.skeleton, others), unmeasured);
    known.triangle_xyz.insert(known.triangle_xyz.end(), more.triangle_xyz.begin(),
                              more.triangle_xyz.end());
    return known;
  }

  [[nodiscard]] std::string name() const { return fmt::format("piece {}", piece_.subdomain); }

  [[nodiscard]] std::span<const LocalIndex> own_corners() const
  {
    return std::span(all_.mesh.tet_vertices)
        .subspan(4 * at(all_.first_tet), 4 * at(all_.last_tet - all_.first_tet));
  }

  // Whether the ascending orientation of a face of one tet points out of it.
  [[nodiscard]] bool is_outward(const mesh::TriangleTets& triangle) const
  {
    const LocalIndex* tet = &own_corners()[4 * at(triangle.tets[0])];
    const auto& [a, b, c] = mesh::kTetFaceCorners[at(triangle.corners[0])];
    return mesh::is_even_triangle(tet[a], tet[b], tet[c]);
  }

  // What lies across a face. Beyond a seam it is some piece of the same material.
  [[nodiscard]] LocalIndex other_side(const GeometryPlace& place) const
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

  // Calls visit(simplex, kind, first point, number of points) for the piece's surface, in the order
  // of its points.
  template <class Visit>
  void for_each_surface_simplex(Visit&& visit) const
  {
    LocalIndex first = 0;
    const auto walk = [&](const std::vector<LocalIndex>& rows, mesh::HostKind kind) {
      const LocalIndex points_each = mesh::num_points_of_host(kind, n_);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i] == kNoIndex) continue;
        visit(i, kind, first, points_each);
        first += points_each;
      }
    };
    const mesh::Complex& faces = all_.complex.faces;
    walk(faces.vertex_skeleton, mesh::HostKind::vertex);
    walk(faces.edge_skeleton, mesh::HostKind::edge);
    walk(faces.triangle_skeleton, mesh::HostKind::triangle);
  }

  [[nodiscard]] bool is_on_geometry(std::size_t simplex, mesh::HostKind kind) const
  {
    switch (kind) {
      case mesh::HostKind::vertex:
        return places_.vertex_on_geometry[simplex] != 0;
      case mesh::HostKind::edge:
        return places_.edges[simplex].is_on_geometry();
      default:
        return places_.of_triangles[simplex].is_on_geometry();
    }
  }

  [[nodiscard]] bool is_on_seam(std::size_t simplex, mesh::HostKind kind) const
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

  // One flag for each point of the surface. @param[in] size Of the result; the rest has 0.
  template <class Flag>
  [[nodiscard]] std::vector<std::uint8_t> surface_flags(std::size_t size, Flag&& flag) const
  {
    std::vector<std::uint8_t> flags(size, 0);
    for_each_surface_simplex(
        [&](std::size_t simplex, mesh::HostKind kind, LocalIndex first, LocalIndex num_points) {
          if (flag(simplex, kind)) std::fill_n(&flags[at(first)], num_points, 1);
        });
    return flags;
  }

  // By what all pieces around a seam know: its tets as they were split.
  void smooth_seams(fill::FillOutput& tets) const
  {
    const auto moves = [&](std::size_t simplex, mesh::HostKind kind) {
      return is_free_on_seam(simplex, kind);
    };
    optimize::TetMesh mesh{.vertex_xyz = std::move(tets.vertex_xyz),
                           .tet_vertices = std::move(tets.tet_vertices)};
    tets.vertex_xyz =
        optimize::smooth_at_once(mesh, surface_flags(mesh.vertex_xyz.size() / 3, moves));
    tets.tet_vertices = std::move(mesh.tet_vertices);
  }

  // Without those of the neighbours and the vertices that only they have.
  [[nodiscard]] fill::FillOutput own_tets(fill::FillOutput all) const
  {
    const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(num_children());
    const auto first = all.tet_vertices.begin() + row * all_.first_tet;
    fill::FillOutput own{.tet_vertices = {first, first + row * (all_.last_tet - all_.first_tet)}};
    std::vector<LocalIndex> number(all.vertex_xyz.size() / 3, kNoIndex);
    for (const LocalIndex v : own.tet_vertices) number[at(v)] = 0;
    LocalIndex next = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] == kNoIndex) continue;
      number[v] = next++;
      own.vertex_xyz.insert(own.vertex_xyz.end(), &all.vertex_xyz[3 * v],
                            &all.vertex_xyz[3 * v] + 3);
    }
    for (LocalIndex& v : own.tet_vertices) v = number[at(v)];
    return own;
  }

  // Vertices inside, also those that have a name since tets were exchanged.
  void smooth_inside(fill::FillOutput& tets) const
  {
    const auto stays = [&](std::size_t simplex, mesh::HostKind kind) {
      return is_on_seam(simplex, kind) || is_on_geometry(simplex, kind);
    };
    optimize::TetMesh mesh{.vertex_xyz = std::move(tets.vertex_xyz),
                           .tet_vertices = std::move(tets.tet_vertices)};
    mesh.vertex_fixed = surface_flags(mesh.vertex_xyz.size() / 3, stays);
    tets.vertex_xyz = optimize::smooth(mesh, smoothing());
    tets.tet_vertices = std::move(mesh.tet_vertices);
  }

  // The piece's own tets with children that are not positive. @param[in] all Before smoothing: it
  // may have made these good and tets beside them bad, whose points are to blame for nothing.
  [[nodiscard]] std::vector<LocalIndex> folded_parents(const fill::FillOutput& all) const
  {
    std::vector<LocalIndex> parents;
    const std::span<const double> xyz(all.vertex_xyz);
    for (LocalIndex tet = all_.first_tet; tet < all_.last_tet; ++tet) {
      for (LocalIndex child = 0; child < num_children(); ++child) {
        const LocalIndex* v = &all.tet_vertices[4 * at(tet * num_children() + child)];
        const double volume = tet_volume(point_at(xyz, v[0]), point_at(xyz, v[1]),
                                         point_at(xyz, v[2]), point_at(xyz, v[3]));
        if (volume > 0.0) continue;
        parents.push_back(tet);
        break;
      }
    }
    return parents;
  }

  // All new points on the geometry that these tets have stay midpoints from now on.
  [[nodiscard]] std::vector<mesh::PointLimit> limits_at(const std::vector<LocalIndex>& tets) const
  {
    std::vector<mesh::PointLimit> limits;
    const auto hold_back = [&](const GeometryPlace& place, LocalIndex i, LocalIndex j) {
      if (!place.is_on_geometry()) return;
      limits.push_back({key_of(cut_.skeleton, places_.triangles[at(place.triangle)],
                               lattice::intervals(refine_.levels), place.point(n_, i, j)),
                        0.0});
    };
    const mesh::Complex& faces = all_.complex.faces;
    for (const LocalIndex tet : tets) {
      for (std::size_t c = 0; c < 4; ++c) {
        const LocalIndex t = all_.complex.tet_triangles[4 * at(tet) + c];
        for (std::size_t side = 0; side < 3; ++side) {
          const GeometryPlace& edge = places_.edges[at(faces.triangle_edges[3 * at(t) + side])];
          for (LocalIndex k = 1; k < n_; ++k) hold_back(edge, k, 0);
        }
        for (LocalIndex j = 1; j < n_; ++j) {
          for (LocalIndex i = 1; i + j < n_; ++i) hold_back(places_.of_triangles[at(t)], i, j);
        }
      }
    }
    return limits;
  }

  // With the names that owners give.
  [[nodiscard]] mesh::Skin skin_of(const mesh::RefinedLattice& points,
                                   const fill::FillOutput& tets) const
  {
    mesh::Skin skin =
        refine::extract_skin(all_.complex.faces, points, all_.surface, piece_.subdomain);
    std::copy_n(tets.vertex_xyz.begin(), skin.vertex_xyz.size(), skin.vertex_xyz.begin());
    const auto& places = around_.places;
    const mesh::Complex& faces = all_.complex.faces;
    for_each_surface_simplex([&](std::size_t simplex, mesh::HostKind kind, LocalIndex first,
                                 LocalIndex num_points) {
      const number::SimplexPlace& place =
          kind == mesh::HostKind::vertex ? places.vertices[at(faces.vertex_skeleton[simplex])]
          : kind == mesh::HostKind::edge ? places.edges[at(faces.edge_skeleton[simplex])]
                                         : places.triangles[at(faces.triangle_skeleton[simplex])];
      for (LocalIndex i = 0; i < num_points; ++i) {
        skin.vertex_host[at(first + i)] = hosts_.piece(place.owner);
        skin.vertex_index[at(first + i)] = place.first + i;
      }
    });
    return skin;
  }

  [[nodiscard]] FilledPiece check_and_measure(const mesh::Skin& skin, fill::FillOutput tets,
                                              const PieceSummary& before) const
  {
    const fill::FillFacts facts = fill::check_fill(
        {.vertex_xyz = skin.vertex_xyz, .triangle_vertices = skin.triangle_vertices}, tets);
    FilledPiece filled{.piece = {.subdomain = piece_.subdomain,
                                 .material = piece_.material,
                                 .vertex_xyz = std::move(tets.vertex_xyz),
                                 .skin_host = skin.vertex_host,
                                 .skin_index = skin.vertex_index,
                                 .tet_vertices = std::move(tets.tet_vertices)}};
    add_boundary(skin, all_.surface, facts.triangle_tet, filled.piece);
    const auto on_seam = surface_flags(
        at(skin.num_vertices()),
        [&](std::size_t simplex, mesh::HostKind kind) { return is_on_seam(simplex, kind); });
    filled.result = measure_split_piece(filled.piece, skin, all_.surface,
                                        {on_seam.begin(), on_seam.end()}, before);
    PieceSummary& summary = filled.result.summary;
    summary.volume = facts.volume;
    summary.num_owned_vertices =
        summary.num_interior_vertices + around_.shared.owned.num_points(n_);
    return filled;
  }

  const mesh::Piece& piece_;
  const PieceSurroundings& around_;
  const refine::RefineContext& refine_;
  const PartitionedMesh& cut_;
  mesh::HostLayout hosts_;
  LocalIndex n_;  // Intervals of an edge of the piece.
  PieceComplex all_;
  GeometryPlaces places_{};
};

}  // namespace

PieceRefiner::PieceRefiner(const PartitionedMesh& cut, int levels)
    : state_(std::make_unique<const State>(
        State{cut, levels, mesh::HostLayout(cut.skeleton),
              GeometryFinder(cut.skeleton, lattice::intervals(levels))}))
{
}

PieceRefiner::PieceRefiner(PieceRefiner&&) noexcept = default;
PieceRefiner::~PieceRefiner() = default;

RefinedPiece PieceRefiner::refine(const mesh::Piece& piece, const PieceSurroundings& around,
                                  const refine::RefineContext& refine,
                                  const PieceSummary& before) const
{
  return PieceSplitter(piece, around, refine, state_->cut, state_->levels)
      .run(state_->finder, before);
}

}  // namespace tessera::subdomain

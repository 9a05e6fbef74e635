// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/refine_piece.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/fill/check.hpp"
#include "tessera/fill/subdivide.hpp"
#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/optimize/smooth.hpp"
#include "tessera/subdomain/measure_piece.hpp"

#include "subdomain/files/boundary_triangles.hpp"
#include "subdomain/geometry_places.hpp"
#include "subdomain/layers/measure_layers.hpp"
#include "subdomain/refine/curve_piece.hpp"
#include "subdomain/refine/split_columns.hpp"
#include "subdomain/refine/split_surface.hpp"

namespace tessera::subdomain {

struct PieceRefiner::State {
  const PartitionedMesh& cut;
  PieceSplit split;
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
                const refine::RefineContext& refine, const PartitionedMesh& cut,
                const GeometryFinder& finder, int splits, const LayerTables* layers)
      : piece_(piece),
        around_(around),
        refine_(refine),
        images_(cut.coarse.images),
        layers_(layers),
        n_(lattice::intervals(splits)),
        surface_(piece, around, cut, finder, splits),
        all_(surface_.all())
  {
  }

  RefinedPiece run(const PieceSummary& before) const
  {
    const mesh::RefinedLattice known = surface_.known_points(refine_);
    const mesh::RefinedLattice points = surface_.points(known, refine_.limiter);
    SplitColumns columns = columns_of(known, points);
    fill::FillOutput tets = fill::subdivide(all_.complex, points);
    if (around_.is_smoothed) smooth_seams(tets);
    tets = own_tets(std::move(tets));
    if (around_.is_smoothed) smooth_inside(tets);
    RefinedPiece refined;
    const bool is_sound = fill::all_positive(tets);
    if (!is_sound) {
      refined.folds = surface_.limits_at(folded_parents(fill::subdivide(all_.complex, points)));
    }
    const auto of_layers = surface_.limits_at_triangles(columns.folded);
    refined.folds.insert(refined.folds.end(), of_layers.begin(), of_layers.end());
    if (!is_sound || !columns.folded.empty()) {
      refined.filled.result.summary = before;
      refined.filled.result.summary.is_folded = true;
      return refined;
    }
    const mesh::Skin skin = skin_of(points, tets);
    refined.filled = check_and_measure(skin, points.levels(), std::move(tets), before);
    PieceSummary& summary = refined.filled.result.summary;
    if (layers_ != nullptr) {
      refined.filled.piece.columns = std::move(columns.columns);
      measure_layers(refined.filled.piece, *layers_, summary);
    }
    summary.num_held_back = points.distance.num_held_back;
    summary.model_distance = points.distance.largest;
    summary.held_back_distance = points.distance.largest_held_back;
    return refined;
  }

 private:
  [[nodiscard]] LocalIndex num_children() const { return n_ * n_ * n_; }

  [[nodiscard]] SplitColumns columns_of(const mesh::RefinedLattice& known,
                                        const mesh::RefinedLattice& points) const
  {
    if (layers_ == nullptr) return {};
    return split_columns(surface_, piece_, around_, known, points, refine_, *layers_);
  }

  // By what all pieces around a seam know: its tets as they were split.
  void smooth_seams(fill::FillOutput& tets) const
  {
    const auto moves = [&](std::size_t simplex, mesh::HostKind kind) {
      return surface_.is_free_on_seam(simplex, kind);
    };
    optimize::TetMesh mesh{.vertex_xyz = std::move(tets.vertex_xyz),
                           .tet_vertices = std::move(tets.tet_vertices)};
    tets.vertex_xyz =
        optimize::smooth_at_once(mesh, surface_.surface_flags(mesh.vertex_xyz.size() / 3, moves));
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
      return surface_.is_on_seam(simplex, kind) || surface_.is_on_geometry(simplex, kind);
    };
    optimize::TetMesh mesh{.vertex_xyz = std::move(tets.vertex_xyz),
                           .tet_vertices = std::move(tets.tet_vertices)};
    mesh.vertex_fixed = surface_.surface_flags(mesh.vertex_xyz.size() / 3, stays);
    tets.vertex_xyz = optimize::smooth(mesh, smoothing());
    tets.tet_vertices = std::move(mesh.tet_vertices);
  }

  // The piece's own tets with children that are not positive. @param[in] all Before smoothing: it
  // may have made these good and tets beside them bad, whose points are to blame for nothing.
  [[nodiscard]] std::vector<LocalIndex> folded_parents(const fill::FillOutput& all) const
  {
    std::vector<LocalIndex> parents;
    for (LocalIndex tet = all_.first_tet; tet < all_.last_tet; ++tet) {
      for (LocalIndex child = 0; child < num_children(); ++child) {
        const LocalIndex row = tet * num_children() + child;
        if (tet_volume(corners_at<4>(all.vertex_xyz, all.tet_vertices, row)) > 0.0) continue;
        parents.push_back(tet);
        break;
      }
    }
    return parents;
  }

  // With the positions after smoothing.
  [[nodiscard]] mesh::Skin skin_of(const mesh::RefinedLattice& points,
                                   const fill::FillOutput& tets) const
  {
    mesh::Skin skin = surface_.named_skin(points);
    std::copy_n(tets.vertex_xyz.begin(), skin.vertex_xyz.size(), skin.vertex_xyz.begin());
    return skin;
  }

  // The parts of those that the piece had.
  void add_line_edges(const mesh::LatticeLevels& levels, mesh::Piece& split) const
  {
    const mesh::LatticeNumbering numbering(all_.complex.faces, levels);
    const std::vector<LocalIndex> edges = surface_.edges_on_lines();
    for (std::size_t row = 0; row < edges.size(); ++row) {
      for (LocalIndex k = 0; k < n_; ++k) {
        split.line_vertices.push_back(numbering.edge_point(edges[row], k));
        split.line_vertices.push_back(numbering.edge_point(edges[row], k + 1));
        split.line.push_back(piece_.line[row]);
      }
    }
  }

  [[nodiscard]] FilledPiece check_and_measure(const mesh::Skin& skin,
                                              const mesh::LatticeLevels& levels,
                                              fill::FillOutput tets,
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
    add_line_edges(levels, filled.piece);
    const auto on_seam = surface_.surface_flags(at(skin.num_vertices()),
                                                [&](std::size_t simplex, mesh::HostKind kind) {
                                                  return surface_.is_on_seam(simplex, kind);
                                                });
    filled.result = measure_split_piece(filled.piece, skin, all_.surface, images_,
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
  const mesh::SideImages& images_;
  const LayerTables* layers_;  // Null: the mesh has none.
  LocalIndex n_;               // Intervals of an edge of the piece.
  SplitSurface surface_;
  const PieceComplex& all_;  // Of the surface.
};

}  // namespace

PieceRefiner::PieceRefiner(const PartitionedMesh& cut, const PieceSplit& split)
    : state_(std::make_unique<const State>(State{cut, split, GeometryFinder(cut)}))
{
}

PieceRefiner::PieceRefiner(PieceRefiner&&) noexcept = default;
PieceRefiner::~PieceRefiner() = default;

RefinedPiece PieceRefiner::refine(const mesh::Piece& piece, const PieceSurroundings& around,
                                  const refine::RefineContext& refine, const PieceSummary& before,
                                  const LayerTables* layers) const
{
  const auto& [cut, split, finder] = *state_;
  if (split.is_curved) {
    const SplitSurface surface(piece, around, cut, finder, split.levels);
    return PieceCurver(piece, around, surface).run(refine, before);
  }
  return PieceSplitter(piece, around, refine, cut, finder, split.levels, layers).run(before);
}

}  // namespace tessera::subdomain

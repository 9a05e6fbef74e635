// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/refine/split_columns.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/mesh/prism.hpp"

#include "subdomain/layers/layer_columns.hpp"
#include "subdomain/refine/end_places.hpp"
#include "subdomain/refine/split_names.hpp"

namespace tessera::subdomain {
namespace {

namespace lattice = mesh::lattice;
using lattice::TrianglePoint;
using Part = lattice::PointPlace::Part;

// Splits the columns of one piece; lives for one call of split_columns().
class ColumnSplitter {
 public:
  ColumnSplitter(const SplitSurface& surface, const mesh::Piece& piece,
                 const PieceSurroundings& around, const mesh::RefinedLattice& known,
                 const mesh::RefinedLattice& points, const refine::RefineContext& refine,
                 const LayerTables& tables)
      : surface_(surface),
        piece_(piece),
        known_(known),
        points_(points),
        refine_(refine),
        tables_(tables),
        hosts_(refine.skeleton),
        faces_(surface.all().complex.faces),
        skin_(surface.skin()),
        names_(surface, refine.skeleton),
        ends_(around, tables),
        numbering_(faces_, points.levels()),
        n_(surface.intervals()),
        vertices_(at(numbering_.num_skeleton_points()))
  {
  }

  SplitColumns run()
  {
    for (LocalIndex t = 0; t < faces_.num_triangles(); ++t) {
      if (is_on_wall(t)) walls_.push_back(t);
    }
    for (const LocalIndex t : walls_) name_points(t);
    if (tables_.has_joints()) name_ends_of_others();
    for (const LocalIndex t : walls_) keep_columns(t);
    place_known_columns();
    for (const LocalIndex t : walls_) place_held_back_columns(t);
    SplitColumns made{.columns = named_columns()};
    std::ranges::copy_if(walls_, std::back_inserter(made.folded),
                         [&](LocalIndex t) { return is_folded(t); });
    return made;
  }

 private:
  // A point of the piece's surface; what lies on no wall has no name here.
  struct Vertex {
    mesh::HostPoint name{kNoIndex, 0};
    Vec3 xyz{};
    std::vector<Vec3> column{};  // Shape (most_layers): where layers end; empty: there is none.
    number::SimplexPlace end{};  // Where the column ends, if at tets across a joint.
  };

  // A point of a wall, as its triangle sees it.
  struct WallPoint {
    LocalIndex vertex = kNoIndex;
    LocalIndex row = kNoIndex;  // Of the skeleton triangle among the places.
    SkeletonPoint place{};
  };

  [[nodiscard]] bool is_on_wall(LocalIndex t) const
  {
    const GeometryPlace& place = surface_.places().of_triangles[at(t)];
    if (faces_.triangle_skeleton[at(t)] == kNoIndex || !place.is_on_geometry()) return false;
    return tables_.is_wall(refine_.skeleton.triangle_patch[at(triangle_of(place))]);
  }

  [[nodiscard]] LocalIndex triangle_of(const GeometryPlace& place) const
  {
    return surface_.places().triangles[at(place.triangle)];
  }

  [[nodiscard]] WallPoint point_of(LocalIndex t, const TrianglePoint& p) const
  {
    const GeometryPlace& place = surface_.places().of_triangles[at(t)];
    return {numbering_.triangle_point(t, n_, p),
            place.triangle,
            {triangle_of(place), place.point(n_, p.i, p.j)}};
  }

  [[nodiscard]] bool is_corner(const TrianglePoint& p) const
  {
    return lattice::place_of(n_, p).part == Part::corner;
  }

  template <class Visit>
  void for_each_point(Visit&& visit) const
  {
    for (LocalIndex j = 0; j <= n_; ++j) {
      for (LocalIndex i = 0; i + j <= n_; ++i) visit(TrianglePoint{i, j});
    }
  }

  void name_points(LocalIndex t)
  {
    std::array<mesh::HostPoint, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = surface_.all().names[at(faces_.triangle_vertices[3 * at(t) + c])];
    }
    for_each_point([&](const TrianglePoint& p) {
      const WallPoint point = point_of(t, p);
      Vertex& vertex = vertices_[at(point.vertex)];
      if (vertex.name.host != kNoIndex) return;
      vertex.name = names_.of(point.place);
      vertex.xyz = points_.triangle_point(t, p);
      vertex.end = ends_.of(corners, n_, p);
    });
  }

  // Vertices at which columns of other pieces may end.
  void name_ends_of_others()
  {
    surface_.for_each_surface_simplex(
        [&](std::size_t simplex, mesh::HostKind kind, LocalIndex first, LocalIndex num_points) {
          for (LocalIndex i = 0; i < num_points; ++i) {
            if (const auto name = name_for_ends(simplex, kind, i))
              vertices_[at(first + i)].name = *name;
          }
        });
  }

  // Of point `i` of a simplex of the surface, if columns end there.
  [[nodiscard]] std::optional<mesh::HostPoint> name_for_ends(std::size_t simplex,
                                                             mesh::HostKind kind, LocalIndex i)
  {
    if (kind == mesh::HostKind::vertex) {
      const mesh::HostPoint& before = surface_.all().names[simplex];
      if (!tables_.is_end_elsewhere(before.host)) return std::nullopt;
      return names_.of(before);
    }
    const bool is_edge = kind == mesh::HostKind::edge;
    const auto& places = is_edge ? surface_.places().edges : surface_.places().of_triangles;
    const GeometryPlace& place = places[simplex];
    if (!place.is_on_geometry()) return std::nullopt;
    const auto [a, b] = is_edge ? TrianglePoint{i + 1, 0} : lattice::inner_triangle_point(n_, i);
    const SkeletonPoint point{triangle_of(place), place.point(n_, a, b)};
    if (!tables_.is_end_elsewhere(names_.host_of(point))) return std::nullopt;
    return names_.of(point);
  }

  [[nodiscard]] bool wants_column(const Vertex& vertex) const
  {
    return vertex.column.empty() && tables_.has_columns(vertex.name.host);
  }

  // Those of the vertices that the piece had before.
  void keep_columns(LocalIndex t)
  {
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = faces_.triangle_vertices[3 * at(t) + c];
      Vertex& vertex = vertices_[at(numbering_.vertex(v))];
      if (!wants_column(vertex)) continue;
      vertex.column = column_of(piece_.columns, surface_.all().names[at(v)]);
    }
  }

  [[nodiscard]] std::vector<Vec3> column_of(const mesh::Columns& columns,
                                            const mesh::HostPoint& name) const
  {
    const std::size_t row = columns.row_of(name);
    if (row == columns.size()) {
      throw MeshError(fmt::format("piece {} has no column over vertex {} of host {} to be split",
                                  piece_.subdomain, name.index, name.host));
    }
    const LocalIndex first = tables_.most_layers() * static_cast<LocalIndex>(row);
    std::vector<Vec3> column;
    for (LocalIndex layer = 0; layer < tables_.most_layers(); ++layer) {
      column.push_back(point_at(std::span(columns.point_xyz), first + layer));
    }
    return column;
  }

  [[nodiscard]] bool is_held_back(const SkeletonPoint& point) const
  {
    const LocalIndex n = surface_.intervals_of_triangle(point.triangle);
    return refine_.limiter.factor(key_of(refine_.skeleton, point.triangle, n, point.p)) == 0.0;
  }

  // In the lattice of known points, which may have more than the split.
  [[nodiscard]] mesh::HostPoint name_in_known(const WallPoint& point) const
  {
    const auto& [triangle, p] = point.place;
    const LocalIndex n = surface_.intervals_of_triangle(triangle);
    const auto [part, side, k] = lattice::place_of(n, p);
    const mesh::HostEntity host = names_.host_of(point.place);
    if (part != Part::side) return {host, lattice::inner_triangle_index(n, p.i, p.j)};
    const LocalIndex edge = skin_.triangle_edges[3 * at(point.row) + side];
    return {host, k * known_.edge_intervals(edge) / n - 1};
  }

  // Those of new points that are not held back.
  void place_known_columns()
  {
    LatticePoints list;
    std::map<LocalIndex, mesh::HostPoint> name_of;
    for (const LocalIndex t : walls_) {
      for_each_point([&](const TrianglePoint& p) {
        const WallPoint point = point_of(t, p);
        if (is_corner(p) || !wants_column(vertices_[at(point.vertex)])) return;
        if (name_of.contains(point.vertex) || is_held_back(point.place)) return;
        const mesh::HostPoint name = name_in_known(point);
        name_of.emplace(point.vertex, name);
        list.names.push_back(name);
        append(known_.triangle_point(point.row, point.place.p), list.tets_xyz);
        append(known_.walls->triangle_point(point.row, point.place.p), list.walls_xyz);
      });
    }
    const mesh::Columns made = make_columns(skin_, known_, list, refine_);
    for (const auto& [vertex, name] : name_of) {
      vertices_[at(vertex)].column = column_of(made, name);
    }
  }

  static void append(const Vec3& point, std::vector<double>& xyz)
  {
    xyz.insert(xyz.end(), point.begin(), point.end());
  }

  void place_held_back_columns(LocalIndex t)
  {
    for (LocalIndex step = n_ / 2; step >= 1; step /= 2) {
      for_each_point([&](const TrianglePoint& p) {
        const bool is_new =
            p.i % step == 0 && p.j % step == 0 && (p.i % (2 * step) != 0 || p.j % (2 * step) != 0);
        if (!is_new) return;
        Vertex& vertex = vertices_[at(numbering_.triangle_point(t, n_, p))];
        if (wants_column(vertex)) vertex.column = column_between(t, lattice::parents(p, step));
      });
    }
  }

  [[nodiscard]] std::vector<Vec3> column_between(LocalIndex t,
                                                 const std::array<TrianglePoint, 2>& parents) const
  {
    std::vector<Vec3> column;
    for (LocalIndex layer = 0; layer < tables_.most_layers(); ++layer) {
      column.push_back(midpoint(end_at(t, parents[0], layer), end_at(t, parents[1], layer)));
    }
    return column;
  }

  // Where a layer ends at a point of a triangle; the tets are at layer -1.
  [[nodiscard]] Vec3 end_at(LocalIndex t, const TrianglePoint& p, LocalIndex layer) const
  {
    const Vertex& vertex = vertices_[at(numbering_.triangle_point(t, n_, p))];
    return layer < 0 || vertex.column.empty() ? vertex.xyz : vertex.column[at(layer)];
  }

  [[nodiscard]] bool is_folded(LocalIndex t) const
  {
    const LocalIndex own = faces_.triangle_skeleton[at(t)];
    const bool points_out =
        surface_.all().surface.triangle_subdomains[2 * at(own)] == piece_.subdomain;
    bool is_bad = false;
    const auto test = [&](const TrianglePoint& a, const TrianglePoint& b, const TrianglePoint& c) {
      const auto ends = [&](LocalIndex layer) {
        return std::array{end_at(t, a, layer), end_at(t, points_out ? b : c, layer),
                          end_at(t, points_out ? c : b, layer)};
      };
      for (LocalIndex layer = 0; layer < tables_.most_layers() && !is_bad; ++layer) {
        is_bad = !mesh::is_positive_prism(ends(layer - 1), ends(layer));
      }
    };
    lattice::for_each_small_triangle(n_, 1, test);
    return is_bad;
  }

  [[nodiscard]] mesh::Columns named_columns() const
  {
    mesh::Columns named;
    std::vector<const Vertex*> with_columns;
    for (const Vertex& vertex : vertices_) {
      named.skin_names.push_back(vertex.name);
      if (!vertex.column.empty()) with_columns.push_back(&vertex);
    }
    std::ranges::sort(with_columns, {}, [](const Vertex* vertex) { return vertex->name; });
    for (const Vertex* vertex : with_columns) {
      named.vertices.push_back(vertex->name);
      for (const Vec3& end : vertex->column) append(end, named.point_xyz);
      if (tables_.has_joints()) named.ends.push_back(name_of_end(*vertex));
    }
    return named;
  }

  // That which its owner gives.
  [[nodiscard]] mesh::HostPoint name_of_end(const Vertex& vertex) const
  {
    if (tables_.end_at_tets(vertex.name) == vertex.name) return {kNoIndex, 0};
    if (vertex.end.owner == kNoIndex) {
      throw MeshError(fmt::format("nobody owns the end of the column over vertex {} of host {}",
                                  vertex.name.index, vertex.name.host));
    }
    return {hosts_.piece(vertex.end.owner), vertex.end.first};
  }

  const SplitSurface& surface_;
  const mesh::Piece& piece_;
  const mesh::RefinedLattice& known_;
  const mesh::RefinedLattice& points_;
  const refine::RefineContext& refine_;
  const LayerTables& tables_;
  mesh::HostLayout hosts_;
  const mesh::Complex& faces_;
  const mesh::Complex& skin_;  // Of the subdomain, not of the piece.
  SplitNames names_;
  EndPlaces ends_;
  mesh::LatticeNumbering numbering_;
  LocalIndex n_;                     // Intervals of an edge of the piece.
  std::vector<Vertex> vertices_;     // Shape (num_skin_vertices).
  std::vector<LocalIndex> walls_{};  // Triangles of the complex.
};

}  // namespace

SplitColumns split_columns(const SplitSurface& surface, const mesh::Piece& piece,
                           const PieceSurroundings& around, const mesh::RefinedLattice& known,
                           const mesh::RefinedLattice& points, const refine::RefineContext& refine,
                           const LayerTables& tables)
{
  return ColumnSplitter(surface, piece, around, known, points, refine, tables).run();
}

}  // namespace tessera::subdomain

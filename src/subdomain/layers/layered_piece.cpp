// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/layers/prism_tets.hpp"
#include "tessera/subdomain/layer_tables.hpp"

namespace tessera::subdomain {
namespace {

// Puts prisms onto the triangles of walls, from the tets outwards.
class LayerBuilder {
 public:
  LayerBuilder(mesh::Piece piece, const LayerTables& tables) : tables_(tables)
  {
    made_.num_vertices = piece.num_vertices();
    made_.tet_layer.assign(at(piece.num_tets()), 0);
    made_.tet_of_prism.assign(at(piece.num_tets()), 0);
    made_.piece = std::move(piece);
  }

  LayeredPiece run() &&
  {
    find_columns();
    place_points();
    const LocalIndex num_boundary = piece().num_boundary();
    for (LocalIndex row = 0; row < num_boundary; ++row) {
      if (tables_.is_wall(piece().boundary_patch[at(row)])) add_prisms(row);
    }
    drop_hidden();
    return std::move(made_);
  }

 private:
  // A corner of a wall's triangle, and the row of its column.
  struct Corner {
    LocalIndex vertex = kNoIndex;
    mesh::HostPoint name{};
    LocalIndex column = kNoIndex;
  };

  [[nodiscard]] mesh::Piece& piece() { return made_.piece; }

  void find_columns()
  {
    for (LocalIndex row = 0; row < piece().num_boundary(); ++row) {
      if (!tables_.is_wall(piece().boundary_patch[at(row)])) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const mesh::HostPoint name =
            piece().name_in_layers(piece().boundary_vertices[3 * at(row) + c]);
        if (tables_.has_columns(name.host)) made_.columns.push_back(name);
      }
    }
    sort_unique(made_.columns);
  }

  // Vertices that columns of other hosts end at.
  void find_ends_on_skin()
  {
    if (!tables_.has_joints()) return;
    for (LocalIndex v = 0; v < piece().num_skin_vertices(); ++v) {
      const mesh::HostPoint name = piece().name_in_layers(v);
      if (tables_.is_end_elsewhere(name.host)) ends_.emplace(name, v);
    }
  }

  void place_points()
  {
    find_ends_on_skin();
    for (const mesh::HostPoint& name : made_.columns) {
      made_.first_point.push_back(piece().num_vertices());
      add_points(name);
    }
    made_.first_point.push_back(piece().num_vertices());
  }

  void add_points(const mesh::HostPoint& name)
  {
    const mesh::Columns& all = piece().columns;
    const std::size_t row = all.row_of(name);
    if (row == all.size()) {
      throw MeshError(fmt::format("piece {} has no column over vertex {} of host {}",
                                  piece().subdomain, name.index, name.host));
    }
    const std::size_t size = 3 * at(tables_.most_layers());
    const double* end = &all.point_xyz[size * row] + size;
    const double* first = end - 3 * tables_.num_layers(name.host);
    const mesh::HostPoint end_name{tables_.end_host(name.host), name.index};
    const auto known = ends_.find(end_name);
    const bool is_known = known != ends_.end();
    piece().vertex_xyz.insert(piece().vertex_xyz.end(), first, is_known ? end - 3 : end);
    made_.end.push_back(is_known ? known->second : piece().num_vertices() - 1);
    if (!is_known && tables_.has_joints()) ends_.emplace(end_name, made_.end.back());
  }

  [[nodiscard]] Corner corner_of(LocalIndex vertex)
  {
    Corner corner{vertex, piece().name_in_layers(vertex)};
    const auto found = std::ranges::lower_bound(made_.columns, corner.name);
    if (found != made_.columns.end() && *found == corner.name) {
      corner.column = static_cast<LocalIndex>(found - made_.columns.begin());
    }
    return corner;
  }

  // Where a layer ends at a corner; what is missing ends at the tets, as layer -1 does.
  [[nodiscard]] LocalIndex point(const Corner& corner, LocalIndex layer) const
  {
    if (corner.column == kNoIndex) return corner.vertex;
    const auto column = at(corner.column);
    const LocalIndex from_wall = tables_.most_layers() - layer;
    if (from_wall == 1) return made_.end[column];
    const LocalIndex from_tets = tables_.num_layers(corner.name.host) - from_wall;
    return from_tets < 0 ? corner.vertex : made_.first_point[column] + from_tets;
  }

  void add_prisms(LocalIndex row)
  {
    std::array<Corner, 3> outward;
    for (std::size_t c = 0; c < 3; ++c) {
      outward[c] = corner_of(piece().boundary_vertices[3 * at(row) + c]);
    }
    const auto has_column = [](const Corner& corner) { return corner.column != kNoIndex; };
    if (std::ranges::none_of(outward, has_column)) return;
    std::array<Corner, 3> sorted = outward;
    std::ranges::sort(sorted, {}, &Corner::name);
    const bool is_even = is_rotation(outward, sorted);
    for (LocalIndex layer = 0; layer < tables_.most_layers(); ++layer) {
      const LocalIndex first_tet = piece().num_tets();
      layers::Prism prism{};
      for (std::size_t c = 0; c < 3; ++c) {
        prism[c] = point(sorted[c], layer - 1);
        prism[3 + c] = point(sorted[c], layer);
      }
      layers::append_prism_tets(prism, is_even, piece().tet_vertices);
      made_.tet_layer.resize(at(piece().num_tets()), tables_.most_layers() - layer);
      for (LocalIndex t = first_tet; t < piece().num_tets(); ++t) {
        made_.tet_of_prism.push_back(t - first_tet);
      }
      for (std::size_t c = 0; c < 3; ++c) {
        add_side(outward[c], outward[(c + 1) % 3], layer, first_tet);
      }
    }
    end_at_wall(row, outward);
  }

  static bool is_rotation(const std::array<Corner, 3>& outward, const std::array<Corner, 3>& sorted)
  {
    for (std::size_t c = 0; c < 3; ++c) {
      if (outward[c].vertex != sorted[0].vertex) continue;
      return outward[(c + 1) % 3].vertex == sorted[1].vertex;
    }
    return false;
  }

  // The side of a prism that lies on a patch without layers: two triangles, or one where a column
  // is missing.
  void add_side(const Corner& a, const Corner& b, LocalIndex layer, LocalIndex first_tet)
  {
    const auto side = tables_.side(a.name, b.name, piece().subdomain);
    if (!side) return;
    const std::array<LocalIndex, 4> quad{point(a, layer - 1), point(b, layer - 1), point(b, layer),
                                         point(a, layer)};
    const bool begins_at_a = a.name < b.name;
    const std::array<std::array<std::size_t, 3>, 2> halves =
        begins_at_a ? std::array<std::array<std::size_t, 3>, 2>{{{0, 1, 2}, {0, 2, 3}}}
                    : std::array<std::array<std::size_t, 3>, 2>{{{0, 1, 3}, {1, 2, 3}}};
    for (const auto& half : halves) {
      const std::array<LocalIndex, 3> triangle{quad[half[0]], quad[half[1]], quad[half[2]]};
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
        continue;
      }
      piece().boundary_vertices.insert(piece().boundary_vertices.end(), triangle.begin(),
                                       triangle.end());
      piece().boundary_patch.push_back(side->patch);
      piece().boundary_tet.push_back(tet_behind(triangle, first_tet));
      if (side->is_outside) made_.outside_area += area_of(triangle);
    }
  }

  // The triangle of the tets gives way to that of the wall.
  void end_at_wall(LocalIndex row, const std::array<Corner, 3>& outward)
  {
    std::array<LocalIndex, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = point(outward[c], tables_.most_layers() - 1);
    const std::array<LocalIndex, 3> of_tets{outward[0].vertex, outward[1].vertex,
                                            outward[2].vertex};
    if (!tables_.is_inside(piece().boundary_patch[at(row)])) {
      made_.outside_area += area_of(triangle) - area_of(of_tets);
    }
    std::ranges::copy(triangle, &piece().boundary_vertices[3 * at(row)]);
    const LocalIndex num_last = std::min(piece().num_tets(), 3);
    piece().boundary_tet[at(row)] = tet_behind(triangle, piece().num_tets() - num_last);
  }

  // The piece on the other side of a joint has these triangles; of a wake nobody has them.
  void drop_hidden()
  {
    LocalIndex num_kept = 0;
    for (LocalIndex row = 0; row < piece().num_boundary(); ++row) {
      if (tables_.is_hidden(piece().boundary_patch[at(row)])) continue;
      std::copy_n(&piece().boundary_vertices[3 * at(row)], 3,
                  &piece().boundary_vertices[3 * at(num_kept)]);
      piece().boundary_patch[at(num_kept)] = piece().boundary_patch[at(row)];
      piece().boundary_tet[at(num_kept)] = piece().boundary_tet[at(row)];
      ++num_kept;
    }
    piece().boundary_vertices.resize(3 * at(num_kept));
    piece().boundary_patch.resize(at(num_kept));
    piece().boundary_tet.resize(at(num_kept));
  }

  [[nodiscard]] double area_of(const std::array<LocalIndex, 3>& triangle) const
  {
    const std::span<const double> xyz(made_.piece.vertex_xyz);
    return triangle_area(point_at(xyz, triangle[0]), point_at(xyz, triangle[1]),
                         point_at(xyz, triangle[2]));
  }

  // Of those from `first` on the one that has the triangle.
  [[nodiscard]] LocalIndex tet_behind(const std::array<LocalIndex, 3>& triangle, LocalIndex first)
  {
    for (LocalIndex t = first; t < piece().num_tets(); ++t) {
      const LocalIndex* corners = &piece().tet_vertices[4 * at(t)];
      const bool has_all = std::ranges::all_of(triangle, [&](LocalIndex v) {
        return std::find(corners, corners + 4, v) != corners + 4;
      });
      if (has_all) return t;
    }
    throw MeshError(
        fmt::format("piece {} has a triangle in front of its layers that none of them "
                    "has",
                    piece().subdomain));
  }

  const LayerTables& tables_;
  LayeredPiece made_{};
  std::map<mesh::HostPoint, LocalIndex> ends_{};  // At joints: vertices where columns end.
};

}  // namespace

LayeredPiece with_layers(mesh::Piece piece, const LayerTables& tables)
{
  return LayerBuilder(std::move(piece), tables).run();
}

}  // namespace tessera::subdomain

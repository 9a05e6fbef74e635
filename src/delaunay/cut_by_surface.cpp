// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/delaunay/cut_by_surface.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "delaunay/crossing.hpp"

namespace tessera::delaunay {
namespace {

using Corner = LocalIndex;

// A triangle of the surface by its vertices.
struct Key {
  std::array<LocalIndex, 3> vertices{};
  LocalIndex triangle = kNoIndex;

  friend auto operator<=>(const Key&, const Key&) = default;
};

class Cutter {
 public:
  Cutter(std::span<const double> xyz, const Tetrahedralization& tets,
         std::span<const LocalIndex> triangle_vertices, LocalIndex first_inside)
      : xyz_(xyz),
        tets_(tets),
        triangle_vertices_(triangle_vertices),
        first_inside_(first_inside),
        faces_(tets.tet_vertices.size(), kNoFace)
  {
  }

  SurfaceCut run()
  {
    cut_.tet_side.assign(at(tets_.num_tets()), Side::outside);
    find_faces();
    find_crossed();
    flood_all();
    return std::move(cut_);
  }

 private:
  // What the face opposite to a corner is, as seen from its tet.
  enum Face : std::uint8_t { kNoFace, kFaceFromInside, kFaceFromOutside };

  [[nodiscard]] std::array<LocalIndex, 3> triangle(LocalIndex t) const
  {
    const LocalIndex* v = &triangle_vertices_[3 * at(t)];
    return {v[0], v[1], v[2]};
  }

  [[nodiscard]] std::vector<Key> sorted_triangles() const
  {
    std::vector<Key> keys;
    for (LocalIndex t = 0; 3 * at(t) < triangle_vertices_.size(); ++t) {
      const auto [a, b, c] = triangle(t);
      keys.push_back({mesh::sorted_triangle(a, b, c), t});
    }
    std::ranges::sort(keys);
    return keys;
  }

  // Triangles that are faces of tets.
  void find_faces()
  {
    const std::vector<Key> keys = sorted_triangles();
    cut_.triangle_corner.assign(keys.size(), kNoIndex);
    std::vector<char> is_found(keys.size(), 0);
    for (Corner corner = 0; at(corner) < tets_.tet_vertices.size(); ++corner) {
      const auto [a, b, c] = outward_face(corner);
      const Key key{mesh::sorted_triangle(a, b, c), 0};
      const auto found = std::ranges::lower_bound(keys, key);
      if (found == keys.end() || found->vertices != key.vertices) continue;
      const auto [d, e, f] = triangle(found->triangle);
      const bool from_inside = mesh::is_even_triangle(a, b, c) == mesh::is_even_triangle(d, e, f);
      faces_[at(corner)] = from_inside ? kFaceFromInside : kFaceFromOutside;
      if (from_inside) cut_.triangle_corner[at(found->triangle)] = corner;
      is_found[at(found->triangle)] = 1;
    }
    for (LocalIndex t = 0; at(t) < is_found.size(); ++t) {
      if (is_found[at(t)] == 0) missing_.push_back(t);
    }
    cut_.num_missing = static_cast<LocalIndex>(missing_.size());
  }

  [[nodiscard]] std::array<LocalIndex, 3> outward_face(Corner corner) const
  {
    const LocalIndex* v = &tets_.tet_vertices[at(corner & ~3)];
    const auto& [a, b, c] = mesh::kTetFaceCorners[at(corner & 3)];
    return {v[a], v[b], v[c]};
  }

  [[nodiscard]] Vec3 point(LocalIndex v) const { return point_at(xyz_, v); }

  void find_crossed()
  {
    if (missing_.empty()) return;
    const IndexLists stars =
        rows_by_key(tets_.tet_vertices, static_cast<LocalIndex>(xyz_.size() / 3), 4);
    std::vector<LocalIndex> tested(at(tets_.num_tets()), kNoIndex);
    for (const LocalIndex t : missing_) cross(t, stars, tested);
  }

  // From the tets around the corners of a triangle on, to all that touch one that it crosses.
  void cross(LocalIndex t, const IndexLists& stars, std::vector<LocalIndex>& tested)
  {
    const auto [a, b, c] = triangle(t);
    const std::array<Vec3, 3> corners{point(a), point(b), point(c)};
    std::vector<LocalIndex> to_visit{a, b, c};
    while (!to_visit.empty()) {
      const LocalIndex vertex = to_visit.back();
      to_visit.pop_back();
      for (const LocalIndex tet : stars[vertex]) {
        if (std::exchange(tested[at(tet)], t) == t) continue;
        const LocalIndex* v = &tets_.tet_vertices[4 * at(tet)];
        if (!is_crossed({point(v[0]), point(v[1]), point(v[2]), point(v[3])}, corners)) continue;
        cut_.tet_side[at(tet)] = Side::crossed;
        to_visit.insert(to_visit.end(), v, v + 4);
      }
    }
  }

  // Each set of tets that hang together without going through the surface lies on one side.
  void flood_all()
  {
    std::vector<char> is_reached(at(tets_.num_tets()), 0);
    for (LocalIndex tet = 0; tet < tets_.num_tets(); ++tet) {
      if (cut_.tet_side[at(tet)] == Side::crossed || is_reached[at(tet)] != 0) continue;
      const std::vector<LocalIndex> together = flood(tet, is_reached);
      const Side side = side_of(together);
      for (const LocalIndex one : together) cut_.tet_side[at(one)] = side;
    }
  }

  [[nodiscard]] std::vector<LocalIndex> flood(LocalIndex first, std::vector<char>& is_reached) const
  {
    std::vector<LocalIndex> together{first};
    is_reached[at(first)] = 1;
    for (std::size_t i = 0; i < together.size(); ++i) {
      const LocalIndex tet = together[i];
      for (Corner corner = 4 * tet; corner < 4 * tet + 4; ++corner) {
        const LocalIndex across = tets_.tet_neighbours[at(corner)];
        if (across == kNoIndex || faces_[at(corner)] != kNoFace) continue;
        const LocalIndex next = across >> 2;
        if (cut_.tet_side[at(next)] == Side::crossed || is_reached[at(next)] != 0) continue;
        is_reached[at(next)] = 1;
        together.push_back(next);
      }
    }
    return together;
  }

  // Of tets that touch no triangle and no point of the inside nobody can tell.
  [[nodiscard]] Side side_of(const std::vector<LocalIndex>& together) const
  {
    bool is_inside = false;
    bool is_outside = false;
    for (const LocalIndex tet : together) {
      for (Corner corner = 4 * tet; corner < 4 * tet + 4; ++corner) {
        const std::uint8_t face = faces_[at(corner)];
        const bool is_of_hull = tets_.tet_neighbours[at(corner)] == kNoIndex;
        const bool has_inside_point = tets_.tet_vertices[at(corner)] >= first_inside_;
        is_inside = is_inside || face == kFaceFromInside || has_inside_point;
        is_outside = is_outside || face == kFaceFromOutside || (face == kNoFace && is_of_hull);
      }
    }
    if (is_inside && is_outside) {
      throw MeshError("the surface is not closed or cuts itself: tets lie on both of its sides");
    }
    if (!is_inside && !is_outside) return Side::crossed;
    return is_inside ? Side::inside : Side::outside;
  }

  std::span<const double> xyz_;
  const Tetrahedralization& tets_;
  std::span<const LocalIndex> triangle_vertices_;
  LocalIndex first_inside_;
  std::vector<std::uint8_t> faces_;  // Shape (num_tets, 4), of type Face.
  std::vector<LocalIndex> missing_{};
  SurfaceCut cut_{};
};

}  // namespace

SurfaceCut cut_by_surface(std::span<const double> xyz, const Tetrahedralization& tets,
                          std::span<const LocalIndex> triangle_vertices, LocalIndex first_inside)
{
  return Cutter(xyz, tets, triangle_vertices, first_inside).run();
}

}  // namespace tessera::delaunay

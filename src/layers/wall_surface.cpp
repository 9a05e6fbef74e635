// SPDX-License-Identifier: BSD-3-Clause
#include "layers/wall_surface.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/face_tets.hpp"

#include "layers/image_columns.hpp"

namespace tessera::layers {
namespace {

// A column that leans more than that against one of its triangles is not begun.
constexpr double kLeastCosine = 0.1;

// Two walls that meet at a sharp edge share a column if their layers have at least this part of
// their height there: down to 23 degrees between them. Below that the side which their prisms share
// is skewed: at the trailing edge of a wing, of 16 degrees, by up to 5.9, which OpenFOAM's
// checkMesh refuses; at edges of 20 and of 45 degrees by no more than elsewhere.
constexpr double kLeastOfHeight = 0.5;

// Two walls that meet at less than 64 degrees, in the material, have no column at their edge, but
// layers that close towards it. The sides that their prisms would share there are skewed by
// cot(angle / 2) / 0.4, whatever is chosen; OpenFOAM's checkMesh refuses 4. So the cosine is that
// of the angle whose half has the cotangent 1.6.
constexpr double kMostAcute = 0.438;

// A triangle keeps this shape, or half of its own if that is less.
constexpr double kLeastShape = 0.15;

SurfaceTriangle surface_triangle(const mesh::CoarseMesh& mesh, LocalIndex face,
                                 const std::array<LocalIndex, 3>& v, bool is_wall)
{
  const std::array<Vec3, 3> p{mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2])};
  return {face, v, is_wall, unit_normal_of(p), std::min(kLeastShape, 0.5 * triangle_shape(p))};
}

// A face of the geometry, turned so that it points away from the tets; between two materials, away
// from the lower one.
std::array<LocalIndex, 3> outward(const mesh::CoarseMesh& mesh, const mesh::TriangleTets& face)
{
  const auto material = [&](std::size_t side) { return mesh.tet_material[at(face.tets[side])]; };
  const std::size_t side = face.tets[1] != kNoIndex && material(1) < material(0) ? 1 : 0;
  const auto tet = mesh.tet(face.tets[side]);
  const auto& [a, b, c] = mesh::kTetFaceCorners[at(face.corners[side])];
  return {tet[a], tet[b], tet[c]};
}

WallEdge edge_between(LocalIndex a, LocalIndex b) { return {std::min(a, b), std::max(a, b)}; }

// What is known around the vertices of walls.
class WallFinder {
 public:
  WallFinder(const mesh::CoarseMesh& mesh, std::span<const PatchLayers> patches)
      : mesh_(mesh), patches_(patches), faces_(mesh::tets_of_faces(mesh))
  {
  }

  WallSurface run()
  {
    find_vertices();
    find_triangles();
    find_wall_edges();
    find_segments();
    const IndexLists around = triangles_around();
    for (std::size_t row = 0; row < surface_.vertices.size(); ++row) {
      WallVertex& vertex = surface_.vertices[row];
      vertex.origin = static_cast<LocalIndex>(row);
      if (on_edge_without_room_.contains(vertex.vertex)) continue;
      set_column(vertex, around[static_cast<LocalIndex>(row)]);
    }
    join_image_columns(mesh_, edges_on_walls_, surface_);
    return std::move(surface_);
  }

 private:
  [[nodiscard]] bool is_wall(LocalIndex face) const
  {
    return patches_[at(mesh_.face_patch[at(face)])].thickness > 0.0;
  }

  void find_vertices()
  {
    surface_.wall_of_vertex.assign(at(mesh_.num_vertices()), kNoIndex);
    std::vector<LocalIndex> on_wall;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (!is_wall(f)) continue;
      on_wall.insert(on_wall.end(), &mesh_.face_vertices[3 * at(f)],
                     &mesh_.face_vertices[3 * at(f)] + 3);
    }
    sort_unique(on_wall);
    for (const LocalIndex v : on_wall) {
      surface_.wall_of_vertex[at(v)] = static_cast<LocalIndex>(surface_.vertices.size());
      surface_.vertices.push_back({.vertex = v, .wall = mesh_.position(v)});
    }
  }

  void find_triangles()
  {
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      const auto v = outward(mesh_, faces_[at(f)]);
      const bool touches = std::ranges::any_of(
          v, [&](LocalIndex one) { return surface_.wall_of_vertex[at(one)] != kNoIndex; });
      if (touches) surface_.triangles.push_back(surface_triangle(mesh_, f, v, is_wall(f)));
    }
  }

  void find_wall_edges()
  {
    std::map<WallEdge, const SurfaceTriangle*> first;
    for (const SurfaceTriangle& triangle : surface_.triangles) {
      if (!triangle.is_wall) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const WallEdge edge = edge_between(triangle.vertices[c], triangle.vertices[(c + 1) % 3]);
        edges_on_walls_.insert(edge);
        const auto [other, is_new] = first.emplace(edge, &triangle);
        if (!is_new && leave_no_room(*other->second, triangle, c)) {
          on_edge_without_room_.insert(edge.begin(), edge.end());
        }
      }
    }
  }

  // Whether there is no room between two triangles of walls, or one column would not do for both.
  // @param[in] side Of the second one, where they meet.
  [[nodiscard]] bool leave_no_room(const SurfaceTriangle& first, const SurfaceTriangle& second,
                                   std::size_t side) const
  {
    const Vec3 away =
        mesh_.position(second.vertices[(side + 2) % 3]) - mesh_.position(second.vertices[side]);
    if (is_ridge(first.normal, second.normal, away)) return true;
    return dot(first.normal, second.normal) <= -kMostAcute && dot(away, first.normal) < 0.0;
  }

  // Curves that leave a wall: their segments are no sides of its triangles.
  void find_segments()
  {
    for (LocalIndex s = 0; s < mesh_.num_segments(); ++s) {
      const LocalIndex* v = &mesh_.segment_vertices[2 * at(s)];
      if (edges_on_walls_.contains(edge_between(v[0], v[1]))) continue;
      for (std::size_t end = 0; end < 2; ++end) {
        if (surface_.wall_of_vertex[at(v[end])] != kNoIndex) leaving_[v[end]].push_back({s, end});
      }
    }
  }

  [[nodiscard]] IndexLists triangles_around() const
  {
    std::vector<LocalIndex> rows;
    for (const SurfaceTriangle& triangle : surface_.triangles) {
      for (const LocalIndex v : triangle.vertices) {
        rows.push_back(surface_.wall_of_vertex[at(v)]);
      }
    }
    return rows_by_key(rows, static_cast<LocalIndex>(surface_.vertices.size()), 3);
  }

  void set_column(WallVertex& vertex, std::span<const LocalIndex> around)
  {
    std::vector<Vec3> inward;
    std::map<LocalIndex, Vec3> of_patch;
    std::vector<LocalIndex> sides;
    LocalIndex thinnest = kNoIndex;
    for (const LocalIndex row : around) {
      const SurfaceTriangle& triangle = surface_.triangles[at(row)];
      const LocalIndex patch = mesh_.face_patch[at(triangle.face)];
      if (!triangle.is_wall) {
        sides.push_back(patch);
        continue;
      }
      inward.push_back(-1.0 * triangle.normal);
      of_patch[patch] = of_patch[patch] - angle_at(triangle, vertex.vertex) * triangle.normal;
      thinnest = thinner(thinnest, patch);
    }
    sort_unique(sides);
    const Vec3 direction = direction_at(vertex, around, sides, inward);
    double least = direction == Vec3{} ? 0.0 : 1.0;
    for (const Vec3& normal : inward) least = std::min(least, dot(normal, direction));
    if (least < kLeastCosine) return;
    // Within a patch the geometry is round, and only its triangles have edges.
    double lean = 1.0;
    for (const auto& [patch, normal] : of_patch) {
      lean = std::max(lean, 1.0 / std::max(dot(unit(normal), direction), 1.0 / kMostLean));
    }
    vertex.column = (patches_[at(thinnest)].thickness * lean) * direction;
    vertex.stack = patches_[at(thinnest)].stack;
  }

  // Of two patches with layers; `a` may be kNoIndex.
  [[nodiscard]] LocalIndex thinner(LocalIndex a, LocalIndex b) const
  {
    const auto key = [&](LocalIndex patch) {
      const PatchLayers& layers = patches_[at(patch)];
      return std::pair(layers.thickness, layers.stack);
    };
    return a == kNoIndex || key(b) < key(a) ? b : a;
  }

  // Radians.
  [[nodiscard]] double angle_at(const SurfaceTriangle& triangle, LocalIndex vertex) const
  {
    const auto& v = triangle.vertices;
    const auto c = static_cast<std::size_t>(std::ranges::find(v, vertex) - v.begin());
    const Vec3 here = mesh_.position(vertex);
    return angle_between(mesh_.position(v[(c + 1) % 3]) - here,
                         mesh_.position(v[(c + 2) % 3]) - here);
  }

  // Zero if there is none.
  [[nodiscard]] Vec3 direction_at(WallVertex& vertex, std::span<const LocalIndex> around,
                                  const std::vector<LocalIndex>& sides,
                                  const std::vector<Vec3>& inward) const
  {
    const auto leaving = leaving_.find(vertex.vertex);
    if (leaving != leaving_.end()) return along_curve(vertex, around, leaving->second);
    if (sides.empty()) return best_direction(inward);
    if (sides.size() > 1) return {};
    return along_patch(vertex, around, sides.front(), inward);
  }

  // Segments of one curve may stand twice, with the parameters of either side. A curve that does
  // not bound the wall's body leads out of it.
  [[nodiscard]] Vec3 along_curve(
      WallVertex& vertex, std::span<const LocalIndex> around,
      const std::vector<std::pair<LocalIndex, std::size_t>>& leaving) const
  {
    const auto other_end = [&](const std::pair<LocalIndex, std::size_t>& one) {
      return mesh_.segment_vertices[2 * at(one.first) + 1 - one.second];
    };
    const auto [segment, end] = leaving.front();
    for (const auto& one : leaving) {
      if (other_end(one) != other_end(leaving.front())) return {};
    }
    if (!bounds_wall_body(other_end(leaving.front()), around)) return {};
    vertex.curve = mesh_.segment_curve[at(segment)];
    if (!mesh_.segment_t.empty()) vertex.t = mesh_.segment_t[2 * at(segment) + end];
    return unit(mesh_.position(other_end(leaving.front())) - vertex.wall);
  }

  // Whether the edge to another vertex is a side of a triangle on a body that has a wall here.
  [[nodiscard]] bool bounds_wall_body(LocalIndex other, std::span<const LocalIndex> around) const
  {
    std::set<LocalIndex> of_walls;
    std::set<LocalIndex> at_edge;
    for (const LocalIndex row : around) {
      const SurfaceTriangle& triangle = surface_.triangles[at(row)];
      const bool has_edge = std::ranges::count(triangle.vertices, other) > 0;
      for (const LocalIndex tet : faces_[at(triangle.face)].tets) {
        if (tet == kNoIndex) continue;
        const LocalIndex body = mesh_.body(mesh_.tet_material[at(tet)]);
        if (triangle.is_wall) of_walls.insert(body);
        if (has_edge) at_edge.insert(body);
      }
    }
    return std::ranges::any_of(at_edge, [&](LocalIndex body) { return of_walls.contains(body); });
  }

  [[nodiscard]] Vec3 along_patch(WallVertex& vertex, std::span<const LocalIndex> around,
                                 LocalIndex patch, std::vector<Vec3> inward) const
  {
    vertex.patch = patch;
    Vec3 across{};
    for (const LocalIndex row : around) {
      const SurfaceTriangle& triangle = surface_.triangles[at(row)];
      if (triangle.is_wall) continue;
      across = across + triangle.normal;
      vertex.uv = parameters_of(triangle.face, vertex.vertex);
    }
    across = unit(across);
    for (Vec3& normal : inward) normal = unit(normal - dot(normal, across) * across);
    const Vec3 best = best_direction(inward);
    const Vec3 direction = unit(best - dot(best, across) * across);
    return goes_over_sides(vertex.vertex, around, across, direction) ? direction : Vec3{};
  }

  // Whether a direction along the triangles without layers leads onto one of them, as they are seen
  // along `across`. Else the wall ends at an edge that the material goes around.
  [[nodiscard]] bool goes_over_sides(LocalIndex vertex, std::span<const LocalIndex> around,
                                     const Vec3& across, const Vec3& direction) const
  {
    return std::ranges::any_of(around, [&](LocalIndex row) {
      const SurfaceTriangle& triangle = surface_.triangles[at(row)];
      const auto& v = triangle.vertices;
      if (triangle.is_wall) return false;
      const auto c = static_cast<std::size_t>(std::ranges::find(v, vertex) - v.begin());
      const Vec3 here = mesh_.position(vertex);
      const Vec3 first = mesh_.position(v[(c + 1) % 3]) - here;
      const Vec3 last = mesh_.position(v[(c + 2) % 3]) - here;
      return dot(cross(first, direction), across) >= 0.0
             && dot(cross(direction, last), across) >= 0.0;
    });
  }

  [[nodiscard]] model::SurfaceParameters parameters_of(LocalIndex face, LocalIndex vertex) const
  {
    if (mesh_.face_uv.empty()) return {};
    const LocalIndex* v = &mesh_.face_vertices[3 * at(face)];
    const auto corner = static_cast<std::size_t>(std::find(v, v + 3, vertex) - v);
    const double* uv = &mesh_.face_uv[2 * (3 * at(face) + corner)];
    return {uv[0], uv[1]};
  }

  const mesh::CoarseMesh& mesh_;
  std::span<const PatchLayers> patches_;
  std::vector<mesh::TriangleTets> faces_;
  WallSurface surface_{};
  std::set<WallEdge> edges_on_walls_{};
  std::set<LocalIndex> on_edge_without_room_{};
  std::map<LocalIndex, std::vector<std::pair<LocalIndex, std::size_t>>> leaving_{};
};

}  // namespace

double triangle_shape(const std::array<Vec3, 3>& corners)
{
  double longest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 side = corners[(c + 1) % 3] - corners[c];
    longest = std::max(longest, dot(side, side));
  }
  return norm(normal_of(corners)) / longest;
}

Vec3 best_direction(std::span<const Vec3> normals)
{
  constexpr int kSteps = 300;  // The cosine is off by less than 0.01 then.
  Vec3 centre{};
  for (const Vec3& normal : normals) centre = centre + normal;
  centre = (1.0 / static_cast<double>(normals.size())) * centre;
  // Towards the farthest one by ever shorter steps: the centre of the smallest ball round them.
  for (int step = 1; step <= kSteps; ++step) {
    const auto farthest = std::ranges::max_element(
        normals, {}, [&](const Vec3& normal) { return dot(normal - centre, normal - centre); });
    centre = centre + (1.0 / (step + 1.0)) * (*farthest - centre);
  }
  return unit(centre);
}

bool is_ridge(const Vec3& first, const Vec3& second, const Vec3& away)
{
  constexpr double kOfColumn = kLeastOfHeight / kMostLean;
  constexpr double kOfNormals = 2.0 * kOfColumn * kOfColumn - 1.0;
  return dot(first, second) < kOfNormals && dot(away, first) > 0.0;
}

WallSurface find_walls(const mesh::CoarseMesh& mesh, std::span<const PatchLayers> patches)
{
  return WallFinder(mesh, patches).run();
}

}  // namespace tessera::layers

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/folded_children.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/coarse/patch_surface.hpp"
#include "tessera/coarse/surface_overlap.hpp"

namespace tessera::coarse {
namespace {

using Edge = PatchSurface::Edge;
using Triangle = PatchSurface::Triangle;

constexpr std::size_t kChildren = 4;

Edge edge_of(LocalIndex a, LocalIndex b) { return {std::min(a, b), std::max(a, b)}; }

// The surface of a coarse mesh on level one: four children of each triangle, one after the other.
class HalvedSurface {
 public:
  HalvedSurface(const mesh::CoarseMesh& mesh, const model::Model& model) : mesh_(mesh), model_(model)
  {
    for (LocalIndex v = 0; v < mesh.num_vertices(); ++v)
      surface_.vertex_xyz.push_back(mesh.position(v));
    for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
      const LocalIndex* v = &mesh.segment_vertices[2 * at(s)];
      segments_.emplace(edge_of(v[0], v[1]), s);
    }
    for (LocalIndex f = 0; f < mesh.num_faces(); ++f) add_children(f);
  }

  // Faces with a child that looks the other way, or that cuts another one.
  [[nodiscard]] std::set<std::size_t> folded_faces() const
  {
    std::set<std::size_t> faces;
    for (const Overlap& overlap : find_overlaps(surface_)) {
      faces.insert({overlap.first / kChildren, overlap.second / kChildren});
    }
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const LocalIndex* v = &mesh_.face_vertices[3 * (t / kChildren)];
      const Vec3 parent = normal_of({mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])});
      if (dot(parent, normal_of(surface_.corners(t))) <= 0.0) faces.insert(t / kChildren);
    }
    return faces;
  }

 private:
  static Vec3 normal_of(const std::array<Vec3, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]); }

  void add_children(LocalIndex f)
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    Triangle middle{};  // Opposite to each corner.
    for (std::size_t c = 0; c < 3; ++c) middle[c] = middle_of(f, (c + 1) % 3, (c + 2) % 3);
    for (std::size_t c = 0; c < 3; ++c) {
      surface_.triangles.push_back({v[c], middle[(c + 2) % 3], middle[(c + 1) % 3]});
    }
    surface_.triangles.push_back(middle);
  }

  LocalIndex middle_of(LocalIndex f, std::size_t from, std::size_t to)
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    const Edge edge = edge_of(v[from], v[to]);
    const auto [found, is_new] =
        middles_.emplace(edge, static_cast<LocalIndex>(surface_.vertex_xyz.size()));
    if (is_new) surface_.vertex_xyz.push_back(place_of_middle(f, from, to, edge));
    return found->second;
  }

  // A mesh must not be lost because a projection fails.
  [[nodiscard]] Vec3 place_of_middle(LocalIndex f, std::size_t from, std::size_t to,
                                     const Edge& edge) const
  {
    const Vec3 chord = midpoint(mesh_.position(edge[0]), mesh_.position(edge[1]));
    try {
      return on_geometry(f, from, to, edge, chord);
    } catch (const GeometryError&) {
      return chord;
    }
  }

  [[nodiscard]] Vec3 on_geometry(LocalIndex f, std::size_t from, std::size_t to,
                                 const Edge& edge, const Vec3& chord) const
  {
    if (const auto found = segments_.find(edge); found != segments_.end()) {
      const std::size_t s = at(found->second);
      const double guess = mesh_.segment_t.empty()
                               ? 0.0
                               : 0.5 * (mesh_.segment_t[2 * s] + mesh_.segment_t[2 * s + 1]);
      return model_.project_to_curve(mesh_.segment_curve[s], chord, guess).xyz;
    }
    model::SurfaceParameters guess{};
    for (std::size_t k = 0; k < 2 && !mesh_.face_uv.empty(); ++k) {
      const double* uv = &mesh_.face_uv[6 * at(f) + k];
      guess[k] = 0.5 * (uv[2 * from] + uv[2 * to]);
    }
    return model_
        .project_to_surface(mesh_.patch_surface[at(mesh_.face_patch[at(f)])], chord, guess)
        .xyz;
  }

  const mesh::CoarseMesh& mesh_;
  const model::Model& model_;
  PatchSurface surface_{};
  std::map<Edge, LocalIndex> segments_{};
  std::map<Edge, LocalIndex> middles_{};
};

}  // namespace

mesh::SizePoints sizes_of_folds(const mesh::CoarseMesh& mesh, const model::Model& model)
{
  mesh::SizePoints sizes;
  for (const std::size_t f : HalvedSurface(mesh, model).folded_faces()) {
    std::array<Vec3, 4> points{};  // The corners and their centroid.
    double longest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) points[c] = mesh.position(mesh.face_vertices[3 * f + c]);
    for (std::size_t c = 0; c < 3; ++c) {
      points[3] = points[3] + (1.0 / 3.0) * points[c];
      longest = std::max(longest, norm(points[(c + 1) % 3] - points[c]));
    }
    for (const Vec3& point : points) {
      sizes.xyz.insert(sizes.xyz.end(), point.begin(), point.end());
      sizes.size.push_back(0.5 * longest);
    }
  }
  return sizes;
}

}  // namespace tessera::coarse

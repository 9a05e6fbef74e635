// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/coarse_surface.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tessera/base/box.hpp"
#include "tessera/base/enclosed_volume.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::surface {
namespace {

// Rows of a table of vertices that are used, in their order, and their new numbers.
class KeptVertices {
 public:
  explicit KeptVertices(LocalIndex num_vertices) : number_(at(num_vertices), kNoIndex) {}

  void keep(std::span<const LocalIndex> vertices)
  {
    for (const LocalIndex v : vertices) number_.at(at(v)) = 0;
  }

  // The rows that are kept; from here on number() is theirs.
  [[nodiscard]] std::vector<LocalIndex> number_all()
  {
    std::vector<LocalIndex> rows;
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] == kNoIndex) continue;
      number_[v] = static_cast<LocalIndex>(rows.size());
      rows.push_back(static_cast<LocalIndex>(v));
    }
    return rows;
  }

  [[nodiscard]] LocalIndex number(LocalIndex v) const { return number_[at(v)]; }

 private:
  std::vector<LocalIndex> number_;  // kNoIndex: not kept.
};

std::vector<double> positions_of(std::span<const LocalIndex> rows,
                                 std::span<const double> vertex_xyz)
{
  std::vector<double> xyz;
  xyz.reserve(3 * rows.size());
  for (const LocalIndex v : rows) {
    const Vec3 point = point_at(vertex_xyz, v);
    xyz.insert(xyz.end(), point.begin(), point.end());
  }
  return xyz;
}

void drop_cuts(mesh::CoarseMesh& mesh)
{
  mesh::CoarseMesh left;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    if (mesh.face_patch[at(f)] == kNoIndex) continue;
    left.face_patch.push_back(mesh.face_patch[at(f)]);
    const auto* v = &mesh.face_vertices[3 * at(f)];
    left.face_vertices.insert(left.face_vertices.end(), v, v + 3);
    if (mesh.face_uv.empty()) continue;
    const auto* uv = &mesh.face_uv[6 * at(f)];
    left.face_uv.insert(left.face_uv.end(), uv, uv + 6);
  }
  mesh.face_patch = std::move(left.face_patch);
  mesh.face_vertices = std::move(left.face_vertices);
  mesh.face_uv = std::move(left.face_uv);
}

// A segment with an end that is not kept bounds nothing.
void drop_segments(const KeptVertices& kept, mesh::CoarseMesh& mesh)
{
  mesh::CoarseMesh left;
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const LocalIndex a = kept.number(mesh.segment_vertices[2 * at(s)]);
    const LocalIndex b = kept.number(mesh.segment_vertices[2 * at(s) + 1]);
    if (mesh.segment_curve[at(s)] == kNoIndex || a == kNoIndex || b == kNoIndex) continue;
    left.segment_vertices.insert(left.segment_vertices.end(), {a, b});
    left.segment_curve.push_back(mesh.segment_curve[at(s)]);
    if (mesh.segment_t.empty()) continue;
    left.segment_t.push_back(mesh.segment_t[2 * at(s)]);
    left.segment_t.push_back(mesh.segment_t[2 * at(s) + 1]);
  }
  mesh.segment_vertices = std::move(left.segment_vertices);
  mesh.segment_curve = std::move(left.segment_curve);
  mesh.segment_t = std::move(left.segment_t);
}

void keep_vertices_of_tets(mesh::CoarseMesh& mesh)
{
  KeptVertices kept(mesh.num_vertices());
  kept.keep(mesh.tet_vertices);
  mesh.vertex_xyz = positions_of(kept.number_all(), mesh.vertex_xyz);
  for (LocalIndex& v : mesh.tet_vertices) v = kept.number(v);
  for (LocalIndex& v : mesh.face_vertices) v = kept.number(v);
  drop_segments(kept, mesh);
}

void add_tets(const DomainSkin& skin, const DomainTets& tets, LocalIndex material,
              mesh::CoarseMesh& mesh)
{
  const std::size_t num_skin = skin.vertex.size();
  const auto first_inner = static_cast<LocalIndex>(mesh.vertex_xyz.size() / 3);
  mesh.vertex_xyz.insert(mesh.vertex_xyz.end(),
                         tets.vertex_xyz.begin() + static_cast<std::ptrdiff_t>(3 * num_skin),
                         tets.vertex_xyz.end());
  for (const LocalIndex v : tets.tet_vertices) {
    const bool is_inner = at(v) >= num_skin;
    mesh.tet_vertices.push_back(is_inner ? first_inner + v - static_cast<LocalIndex>(num_skin)
                                         : skin.vertex[at(v)]);
  }
  mesh.tet_material.insert(mesh.tet_material.end(), tets.tet_vertices.size() / 4, material);
}

// Patches of which one body is on both sides.
void mark_patches_inside(CoarseSurface& surface)
{
  mesh::CoarseMesh& mesh = surface.mesh;
  if (mesh.material_row.empty()) return;
  const auto body = [&](LocalIndex domain) {
    return domain == 0 ? 0 : mesh.body(surface.domain_material[at(domain - 1)]);
  };
  mesh.patch_is_inside.assign(at(mesh.num_patches()), 0);
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const auto [out_of, into] = surface.face_domains[at(f)];
    const LocalIndex patch = mesh.face_patch[at(f)];
    if (patch != kNoIndex && body(out_of) == body(into)) mesh.patch_is_inside[at(patch)] = 1;
  }
}

}  // namespace

std::vector<LocalIndex> faces_of(const CoarseSurface& surface, LocalIndex domain)
{
  std::vector<LocalIndex> faces;
  for (LocalIndex f = 0; f < surface.mesh.num_faces(); ++f) {
    const auto& [out_of, into] = surface.face_domains[at(f)];
    if (out_of == domain || into == domain) faces.push_back(f);
  }
  return faces;
}

DomainSkin skin_of(const CoarseSurface& surface, LocalIndex domain)
{
  const mesh::CoarseMesh& mesh = surface.mesh;
  DomainSkin skin{.max_size = surface.domain_max_size[at(domain - 1)],
                  .model_box = bounding_box(mesh.vertex_xyz)};
  for (const LocalIndex f : faces_of(surface, domain)) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    skin.triangle_vertices.insert(skin.triangle_vertices.end(), {v[0], v[1], v[2]});
    if (surface.face_domains[at(f)][0] != domain)
      std::swap(skin.triangle_vertices.end()[-1], skin.triangle_vertices.end()[-2]);
    const LocalIndex patch = mesh.face_patch[at(f)];
    skin.triangle_patch.push_back(patch == kNoIndex ? mesh.num_patches() : patch);
  }
  KeptVertices kept(mesh.num_vertices());
  kept.keep(skin.triangle_vertices);
  skin.vertex = kept.number_all();
  skin.vertex_xyz = positions_of(skin.vertex, mesh.vertex_xyz);
  for (LocalIndex& v : skin.triangle_vertices) v = kept.number(v);
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const LocalIndex a = kept.number(mesh.segment_vertices[2 * at(s)]);
    const LocalIndex b = kept.number(mesh.segment_vertices[2 * at(s) + 1]);
    if (a != kNoIndex && b != kNoIndex) {
      skin.edge_vertices.insert(skin.edge_vertices.end(), {a, b});
    }
  }
  return skin;
}

double predicted_tets(const DomainSkin& skin)
{
  constexpr double kTetsPerTriangle = 4.0;  // Of bodies with many features, at least.
  constexpr double kTetsPerCube = 8.5;      // Regular tets in the cube of their edge.
  const double by_size = kTetsPerCube * enclosed_volume(skin.vertex_xyz, skin.triangle_vertices)
                         / std::pow(skin.max_size, 3);
  return std::max(by_size, kTetsPerTriangle * static_cast<double>(skin.triangle_patch.size()));
}

cut::CutMesh fill_surface(CoarseSurface surface, const std::vector<DomainTets>& tets)
{
  std::vector<DomainSkin> skins;
  for (LocalIndex d = 1; d <= surface.num_domains(); ++d) skins.push_back(skin_of(surface, d));
  mark_patches_inside(surface);
  cut::CutMesh filled{std::move(surface.mesh), {}};
  for (std::size_t d = 0; d < tets.size(); ++d) {
    add_tets(skins[d], tets[d], surface.domain_material[d], filled.mesh);
    if (surface.domain_part.empty()) continue;
    filled.tet_part.resize(at(filled.mesh.num_tets()), surface.domain_part[d]);
  }
  if (filled.mesh.num_tets() == 0) throw MeshError("the coarse mesh has no tets");
  drop_cuts(filled.mesh);
  keep_vertices_of_tets(filled.mesh);
  return filled;
}

}  // namespace tessera::surface

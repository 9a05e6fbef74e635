// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/coarse_mesh.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/mesh/sorted_rows.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {
namespace {

// Puts the text together only if it is needed: there is a call for every tet and triangle.
template <class... Args>
void require(bool condition, fmt::format_string<Args...> text, Args&&... args)
{
  if (!condition) {
    throw MeshError("coarse mesh: " + fmt::format(text, std::forward<Args>(args)...));
  }
}

void require_indices_below(std::span<const LocalIndex> indices, LocalIndex limit,
                           const std::string& name)
{
  for (const LocalIndex i : indices) {
    require(i >= 0 && i < limit, "{} holds {}, not in [0, {})", name, i, limit);
  }
}

void validate_shapes(const CoarseMesh& mesh)
{
  const auto tets = static_cast<std::size_t>(mesh.num_tets());
  const auto faces = static_cast<std::size_t>(mesh.num_faces());
  const auto segments = static_cast<std::size_t>(mesh.num_segments());
  require(tets > 0, "it has no tets");
  require(mesh.tet_material.size() == tets, "tet_material has another length than tet_vertices");
  require(mesh.face_patch.size() == faces, "face_patch has another length than face_vertices");
  require(mesh.face_uv.empty() || mesh.face_uv.size() == 6 * faces, "face_uv has a wrong length");
  require(mesh.segment_curve.size() == segments, "segment_curve has a wrong length");
  require(mesh.segment_t.empty() || mesh.segment_t.size() == 2 * segments,
          "segment_t has a wrong length");
  require(mesh.patch_surface.size() == mesh.patch_names.size(), "patch_surface has a wrong length");
  require(mesh.patch_row.empty() || mesh.patch_row.size() == mesh.patch_names.size(),
          "patch_row has a wrong length");
  require_indices_below(mesh.patch_row, mesh.num_patches(), "patch_row");
  require(mesh.patch_is_inside.empty() || mesh.patch_is_inside.size() == mesh.patch_names.size(),
          "patch_is_inside has a wrong length");
  require(mesh.material_row.empty() || mesh.material_row.size() == mesh.material_names.size(),
          "material_row has a wrong length");
  require_indices_below(mesh.material_row, mesh.num_materials(), "material_row");
  require_indices_below(mesh.tet_vertices, mesh.num_vertices(), "tet_vertices");
  require_indices_below(mesh.face_vertices, mesh.num_vertices(), "face_vertices");
  require_indices_below(mesh.face_patch, mesh.num_patches(), "face_patch");
  require_indices_below(mesh.segment_vertices, mesh.num_vertices(), "segment_vertices");
  for (const LocalIndex m : mesh.tet_material) {
    require(m >= 1 && m <= mesh.num_materials(), "material {} has no name", m);
  }
}

void validate_images(const CoarseMesh& mesh)
{
  const SideImages& images = mesh.images;
  if (images.are_none()) return;
  require(images.patch_origin.size() == mesh.patch_names.size()
              && images.patch_transform.size() == mesh.patch_names.size()
              && images.patch_is_joint.size() == mesh.patch_names.size(),
          "images have a wrong number of patches");
  require(images.face_origin.size() == mesh.face_patch.size(),
          "images have a wrong number of faces");
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex patch = images.patch_origin[at(mesh.face_patch[at(f)])];
    const LocalIndex origin = images.face_origin[at(f)];
    require(origin == kNoIndex
                ? patch == kNoIndex
                : origin >= 0 && origin < mesh.num_faces() && mesh.face_patch[at(origin)] == patch,
            "face {} is the image of none of its patch's origin", f);
  }
}

void validate_tets(const CoarseMesh& mesh)
{
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const double volume = tet_volume(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t));
    require(volume > 0.0, "tet {} has volume {:g}", t, volume);
  }
}

// Faces by their vertices, each once, ascending.
std::vector<std::array<LocalIndex, 3>> sorted_faces(const CoarseMesh& mesh)
{
  std::vector<std::array<LocalIndex, 3>> faces;
  for (std::size_t f = 0; f < mesh.face_patch.size(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * f];
    faces.push_back(sorted_triangle(v[0], v[1], v[2]));
  }
  NumberedRows<3> numbered = number_rows(faces);
  std::vector<char> is_seen(numbered.rows.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    char& seen = is_seen[at(numbered.row_of[f])];
    require(seen == 0, "face {} stands twice", f);
    seen = 1;
  }
  return std::move(numbered.rows);
}

void validate_faces(const CoarseMesh& mesh)
{
  const std::vector<std::array<LocalIndex, 3>> faces = sorted_faces(mesh);
  auto next_face = faces.begin();
  std::size_t num_found = 0;
  for (const TriangleTets& triangle : triangles_of_tets(mesh.tet_vertices)) {
    while (next_face != faces.end() && *next_face < triangle.vertices) ++next_face;
    const bool is_face = next_face != faces.end() && *next_face == triangle.vertices;
    num_found += is_face ? 1 : 0;
    const auto material = [&](std::size_t side) {
      return mesh.tet_material[at(triangle.tets[side])];
    };
    const auto body = [&](std::size_t side) { return mesh.body(material(side)); };
    const bool outside = triangle.tets[1] == kNoIndex;
    require(!is_face || outside || material(0) != material(1),
            "a face of tet {} lies within one material", triangle.tets[0]);
    require(is_face || !(outside || body(0) != body(1)),
            "a triangle of tet {} is on the outside or between two bodies but no face",
            triangle.tets[0]);
  }
  require(num_found == faces.size(), "a face is no triangle of any tet");
}

std::string line_name(const NamedCurve& curve)
{
  return curve.name.empty() ? "curve_" + curve.number : curve.name;
}

}  // namespace

std::string default_patch_name(LocalIndex patch) { return fmt::format("patch_{}", patch + 1); }

std::string default_material_name(LocalIndex material)
{
  return fmt::format("material_{}", material);
}

std::vector<std::string> inside_patch_names(const CoarseMesh& mesh)
{
  std::vector<std::string> names;
  for (std::size_t p = 0; p < mesh.patch_is_inside.size(); ++p) {
    if (mesh.patch_is_inside[p] != 0) names.push_back(mesh.patch_names[p]);
  }
  sort_unique(names);
  return names;
}

std::vector<std::string> line_names(const CoarseMesh& mesh)
{
  std::vector<std::string> names;
  for (const NamedCurve& curve : mesh.curves) {
    if (curve.is_line) names.push_back(line_name(curve));
  }
  sort_unique(names);
  return names;
}

std::map<LocalIndex, LocalIndex> lines_by_curve(const CoarseMesh& mesh)
{
  const std::vector<std::string> names = line_names(mesh);
  std::map<LocalIndex, LocalIndex> lines;
  for (const NamedCurve& curve : mesh.curves) {
    if (!curve.is_line) continue;
    const auto row = std::ranges::lower_bound(names, line_name(curve)) - names.begin();
    lines.emplace(curve.curve, static_cast<LocalIndex>(row));
  }
  return lines;
}

std::vector<std::string> body_names(const CoarseMesh& mesh)
{
  std::vector<std::string> names;
  for (LocalIndex m = 1; m <= mesh.num_materials(); ++m) {
    const bool is_first = at(mesh.body(m)) > names.size();
    if (is_first) names.push_back(mesh.material_names[at(m - 1)]);
  }
  return names;
}

std::vector<std::array<std::string, 2>> split_patch_names(const CoarseMesh& mesh)
{
  std::vector<std::array<std::string, 2>> names;
  for (LocalIndex minus = 0; minus < mesh.num_patches(); ++minus) {
    if (!mesh.images.is_of_split(minus)) continue;
    const LocalIndex plus = mesh.images.patch_origin[at(minus)];
    const std::array<std::string, 2> both{mesh.patch_names[at(plus)], mesh.patch_names[at(minus)]};
    // Patches of one row have one name.
    if (std::ranges::find(names, both) == names.end()) names.push_back(both);
  }
  return names;
}

std::vector<std::string> final_patch_names(const CoarseMesh& mesh)
{
  std::vector<std::string> names = mesh.patch_names;
  for (LocalIndex minus = 0; minus < mesh.num_patches(); ++minus) {
    if (!mesh.images.is_of_split(minus)) continue;
    names[at(minus)] += "_minus";
    names[at(mesh.images.patch_origin[at(minus)])] += "_plus";
  }
  return names;
}

std::vector<PeriodicPair> periodic_pairs(const CoarseMesh& mesh)
{
  std::vector<PeriodicPair> pairs;
  const SideImages& images = mesh.images;
  std::vector<std::size_t> by_entry;  // Of the case.
  for (std::size_t p = 0; p < images.patch_origin.size(); ++p) {
    if (images.patch_origin[p] != kNoIndex && images.patch_transform[p] != 0) by_entry.push_back(p);
  }
  std::ranges::stable_sort(by_entry, {}, [&](std::size_t p) { return images.patch_transform[p]; });
  for (const std::size_t p : by_entry) {
    const PeriodicPair pair{.from = mesh.patch_names[at(images.patch_origin[p])],
                            .to = mesh.patch_names[p],
                            .there = images.transforms[at(images.patch_transform[p])]};
    // Patches of one row have one name.
    if (std::ranges::find(pairs, pair) == pairs.end()) pairs.push_back(pair);
  }
  return pairs;
}

void validate(const CoarseMesh& mesh)
{
  validate_shapes(mesh);
  validate_tets(mesh);
  validate_faces(mesh);
  validate_images(mesh);
}

}  // namespace tessera::mesh

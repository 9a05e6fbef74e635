// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/named_surface.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::geometry {
namespace {

std::string name_of(const surface::PatchSurface& surface, const SurfaceNames& names,
                    std::size_t triangle)
{
  const LocalIndex patch = surface.triangle_patch[triangle];
  const std::string name = names.patch(patch);
  return name.empty() ? fmt::format("face {}", patch) : fmt::format("face {} '{}'", patch, name);
}

// Patches without triangles are left out.
void add_patches(const surface::PatchSurface& from, const SurfaceNames& names,
                 surface::CoarseSurface& to)
{
  // One of which all triangles were merged away keeps its row: names of others do not depend on it.
  constexpr std::array<LocalIndex, 2> kNoMaterials{0, 0};
  std::vector<LocalIndex> row(at(from.num_patches()), kNoIndex);
  for (LocalIndex p = 0; p < from.num_patches(); ++p) {
    if (from.patch_materials[at(p)] == kNoMaterials) continue;
    row[at(p)] = to.mesh.num_patches();
    to.mesh.patch_surface.push_back(p);
    const std::string name = names.patch(p);
    to.mesh.patch_names.push_back(name.empty() ? mesh::default_patch_name(row[at(p)]) : name);
  }
  for (const LocalIndex patch : from.triangle_patch) {
    to.mesh.face_patch.push_back(row[at(patch)]);
    to.face_domains.push_back(from.patch_materials[at(patch)]);
  }
}

}  // namespace

void require_no_overlaps(const std::vector<surface::Overlap>& overlaps,
                         const surface::PatchSurface& surface, const SurfaceNames& names,
                         const std::string& what)
{
  if (overlaps.empty()) return;
  const auto& [first, second, place] = overlaps.front();
  throw NetgenError(fmt::format(
      "{}: the surface cuts itself at {} pairs of triangles, first {} and {} at ({:g}); part "
      "bodies that overlap, and in an STL file those that touch without a common face, in the CAD "
      "program, or let geometry.repair = \"wrap\" make one body of an STL file; for a thin wall "
      "try a smaller coarse.max_size",
      what, overlaps.size(), name_of(surface, names, first), name_of(surface, names, second),
      fmt::join(place, ", ")));
}

surface::CoarseSurface to_coarse_surface(const surface::PatchSurface& surface, double max_size,
                                         const SurfaceNames& names)
{
  surface::CoarseSurface result;
  mesh::CoarseMesh& mesh = result.mesh;
  for (const Vec3& p : surface.vertex_xyz)
    mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), p.begin(), p.end());
  for (const auto& v : surface.triangles)
    mesh.face_vertices.insert(mesh.face_vertices.end(), v.begin(), v.end());
  for (const auto& v : surface.edges)
    mesh.segment_vertices.insert(mesh.segment_vertices.end(), v.begin(), v.end());
  mesh.segment_curve = surface.edge_curve;
  add_patches(surface, names, result);
  add_domains(
      result, max_size, [](LocalIndex domain) { return domain; }, names.material);
  return result;
}

void add_domains(surface::CoarseSurface& surface, double max_size,
                 const std::function<LocalIndex(LocalIndex)>& material,
                 const std::function<std::string(LocalIndex)>& material_name)
{
  LocalIndex num_domains = 0;
  for (const auto& [out_of, into] : surface.face_domains) {
    num_domains = std::max({num_domains, out_of, into});
  }
  surface.domain_max_size.assign(at(num_domains), max_size);
  LocalIndex num_materials = 0;
  for (LocalIndex domain = 1; domain <= num_domains; ++domain) {
    surface.domain_material.push_back(material(domain));
    num_materials = std::max(num_materials, surface.domain_material.back());
  }
  for (LocalIndex m = 1; m <= num_materials; ++m) {
    const std::string given = material_name ? material_name(m) : "";
    surface.mesh.material_names.push_back(given.empty() ? mesh::default_material_name(m) : given);
  }
}

}  // namespace tessera::geometry

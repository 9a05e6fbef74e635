// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/volume_mesher.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <meshing.hpp>

#include "tessera/base/error.hpp"
#include "tessera/coarse/surface_overlap.hpp"

#include "netgen/mesh_conversion.hpp"
#include "netgen/netgen_session.hpp"
#include "netgen/skin_mesh.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

::netgen::PointIndex number_of(LocalIndex v) { return {v + PointIndex::BASE}; }

void add_surface(::netgen::Mesh& mesh, const coarse::PatchSurface& surface)
{
  for (const Vec3& point : surface.vertex_xyz) mesh.AddPoint(to_netgen(point));
  for (LocalIndex p = 0; p < surface.num_patches(); ++p) {
    const auto& [below, above] = surface.patch_materials[at(p)];
    mesh.AddFaceDescriptor(::netgen::FaceDescriptor(p + 1, below, above, 0));
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& v = surface.triangles[t];
    ::netgen::Element2d triangle(number_of(v[0]), number_of(v[1]), number_of(v[2]));
    triangle.SetIndex(surface.triangle_patch[t] + 1);
    mesh.AddSurfaceElement(triangle);
  }
  for (std::size_t e = 0; e < surface.edges.size(); ++e) {
    ::netgen::Segment segment;
    segment[0] = number_of(surface.edges[e][0]);
    segment[1] = number_of(surface.edges[e][1]);
    segment.edgenr = surface.edge_curve[e] + 1;
    mesh.AddSegment(segment);
  }
}

GeometryNumbers numbers_of(const SurfaceNames& names)
{
  GeometryNumbers numbers;
  numbers.surface = [](const ::netgen::FaceDescriptor& face) { return face.SurfNr() - 1; };
  numbers.patch_name = [&names](const ::netgen::FaceDescriptor& face) {
    return names.patch(face.SurfNr() - 1);
  };
  numbers.material_name = names.material;
  numbers.curve = [](const ::netgen::Segment& segment) { return segment.edgenr - 1; };
  return numbers;
}

std::string name_of(const coarse::PatchSurface& surface, const SurfaceNames& names,
                    std::size_t triangle)
{
  const LocalIndex patch = surface.triangle_patch[triangle];
  const std::string name = names.patch(patch);
  return name.empty() ? fmt::format("face {}", patch) : fmt::format("face {} '{}'", patch, name);
}

// NETGEN would say only that there is such a place.
void require_apart(const coarse::PatchSurface& surface, const SurfaceNames& names,
                   const std::string& what)
{
  const std::vector<coarse::Overlap> overlaps = coarse::find_overlaps(surface);
  if (overlaps.empty()) return;
  const auto& [first, second, place] = overlaps.front();
  throw NetgenError(fmt::format(
      "{}: the surface cuts itself at {} pairs of triangles, first {} and {} at ({:g}); part "
      "bodies that overlap or touch without a common face in the CAD program; for a thin wall try "
      "a smaller coarse.max_size",
      what, overlaps.size(), name_of(surface, names, first), name_of(surface, names, second),
      fmt::join(place, ", ")));
}

}  // namespace

mesh::CoarseMesh mesh_volume(const coarse::PatchSurface& surface,
                             const coarse::CoarseOptions& options, const SurfaceNames& names,
                             const std::string& what)
{
  require_apart(surface, names, what);
  NetgenSession session(coarse_parameters(options));
  return session.run(what, [&] {
    ::netgen::Mesh mesh;
    add_surface(mesh, surface);
    mesh.CalcLocalH(options.grading);
    if (::netgen::MeshVolume(session.parameters(), mesh) != ::netgen::MESHING3_OK) {
      throw NetgenError("NETGEN gave up on the coarse volume mesh: " + session.words());
    }
    ::netgen::RemoveIllegalElements(mesh);
    ::netgen::OptimizeVolume(session.parameters(), mesh);
    return to_coarse_mesh(mesh, numbers_of(names), what);
  });
}

}  // namespace tessera::netgen

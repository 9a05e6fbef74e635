// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/model_mesher.hpp"

#include <span>
#include <utility>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/error.hpp"

#include "geometry/gmsh_mesher.hpp"
#include "netgen/fill/skin_mesh.hpp"
#include "netgen/mesh_conversion.hpp"
#include "netgen/volume_mesher.hpp"

namespace tessera::netgen {
namespace {

// Vertices of the surface are in NETGEN's mesh already, in their order.
void give_to_netgen(const surface::DomainSkin& skin, const surface::DomainTets& tets, int domain,
                    double scale, ::netgen::Mesh& mesh)
{
  const std::size_t num_skin = skin.vertex.size();
  const auto first_inner = static_cast<LocalIndex>(mesh.GetNP());
  for (std::size_t v = num_skin; v < tets.vertex_xyz.size() / 3; ++v) {
    mesh.AddPoint(to_point3d(scale * point_at(std::span(tets.vertex_xyz), v)));
  }
  std::vector<LocalIndex> vertices;
  for (const LocalIndex v : tets.tet_vertices) {
    vertices.push_back(at(v) < num_skin ? skin.vertex[at(v)]
                                        : first_inner + v - static_cast<LocalIndex>(num_skin));
  }
  add_tets(mesh, vertices, domain);
}

}  // namespace

surface::CoarseSurface ModelMesher::mesh_surface(const surface::CoarseOptions& options,
                                                 const cut::CutTree& planes) const
{
  if (options.mesher == surface::Mesher::netgen) return model_.mesh_surface(options, planes);
  if (planes.num_parts > 0) {
    throw ConfigError(
        "coarse.mesher = \"gmsh\" meshes whole models only; with decompose.method = "
        "\"geometry\" leave it out");
  }
  return {.mesh = geometry::mesh_with_gmsh(model_, options)};
}

surface::DomainTets ModelMesher::fill_domain(const surface::DomainSkin& skin,
                                             const surface::CoarseOptions& options) const
{
  return netgen::fill_domain(skin, options);
}

mesh::CoarseMesh ModelMesher::generate(const surface::CoarseOptions& options,
                                       const NetgenMeshUser& use) const
{
  const auto* const by_netgen = dynamic_cast<const MeshedByNetgen*>(&model_);
  if (by_netgen == nullptr) throw MeshError("NETGEN meshes no surface of such a model");
  mesh::CoarseMesh coarse;
  const auto fill = [&](const ::netgen::NetgenGeometry& geometry, ::netgen::Mesh& mesh,
                        double scale, const surface::CoarseSurface& surface) {
    const std::vector<surface::DomainTets> tets = mesh_domains(surface, options);
    for (LocalIndex domain = 1; domain <= surface.num_domains(); ++domain) {
      give_to_netgen(surface::skin_of(surface, domain), tets[at(domain - 1)], domain, scale, mesh);
    }
    coarse = surface::fill_surface(surface, tets).mesh;
    use(geometry, mesh);
  };
  static_cast<void>(by_netgen->mesh_whole(options, fill));
  return coarse;
}

}  // namespace tessera::netgen

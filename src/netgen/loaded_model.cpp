// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/loaded_model.hpp"

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/surface/defeature.hpp"
#include "tessera/surface/mend_folds.hpp"
#include "tessera/surface/mend_surface.hpp"

#include "netgen/mesh_conversion.hpp"
#include "netgen/skin_mesh.hpp"
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

struct Mended {
  surface::CoarseSurface surface{};
  RepairCounts repairs{};
  // Folds that could not be mended; the largest number if they are not known.
  LocalIndex num_left = std::numeric_limits<LocalIndex>::max();
};

// Neither of these two loses a surface that can be filled because a projection fails.
Mended shaped(const surface::CoarseSurface& surface, const LoadedModel& model)
{
  if (is_left_out(Repair::mend_surface)) return {surface};
  try {
    Mended better{surface};
    const LocalIndex num_steps = surface::mend_surface(better.surface, model).total();
    if (num_steps == 0) return {surface};
    model.locate_parameters(better.surface.mesh);
    better.repairs.add(Repair::mend_surface, num_steps);
    return better;
  } catch (const GeometryError&) {
    return {surface};
  }
}

Mended unfolded(Mended as_it_was, const LoadedModel& model)
{
  try {
    Mended better = as_it_was;
    const surface::FoldStatistics done = surface::mend_folds(better.surface, model);
    as_it_was.num_left = done.num_before;
    const LocalIndex num_steps = done.num_flips + done.num_cuts;
    if (num_steps == 0) return as_it_was;
    model.locate_parameters(better.surface.mesh);
    better.num_left = done.num_left;
    better.repairs.add(Repair::mend_folds, num_steps - done.num_steps_of_needles);
    better.repairs.add(Repair::mend_needles, done.num_steps_of_needles);
    return better;
  } catch (const GeometryError&) {
    return as_it_was;
  }
}

// A fold keeps points off the geometry, which is worse than a bad angle. Where better shapes have
// folds that cannot be mended, those before may have none.
surface::CoarseSurface mended(surface::CoarseSurface surface, const LoadedModel& model)
{
  if (surface.num_domains() == 0) return surface;
  Mended best = unfolded(shaped(surface, model), model);
  if (best.num_left > 0) {
    Mended plain = unfolded({std::move(surface)}, model);
    if (plain.num_left < best.num_left) best = std::move(plain);
  }
  note_repairs(best.repairs);
  return std::move(best.surface);
}

surface::CoarseSurface defeatured(surface::CoarseSurface surface, const LoadedModel& model,
                                  const surface::CoarseOptions& options)
{
  if (options.defeature == 0.0 || surface.num_domains() == 0) return surface;
  if (surface::defeature(surface, model, {options.defeature, options.kept}))
    model.locate_parameters(surface.mesh);
  return surface;
}

}  // namespace

surface::CoarseSurface LoadedModel::mesh_surface(const surface::CoarseOptions& options,
                                                 const cut::CutTree& planes) const
{
  const bool is_cut = planes.num_parts > 0;
  const bool has_merged = !is_cut && options.surface_mesher == surface::SurfaceMesher::remesh;
  surface::CoarseSurface surface =
      is_cut ? mesh_parts(options, planes) : mesh_surface(options, [](const auto&...) {});
  if (!has_merged) surface = defeatured(std::move(surface), *this, options);
  return mended(std::move(surface), *this);
}

surface::CoarseSurface LoadedModel::mesh_parts(const surface::CoarseOptions& /*options*/,
                                               const cut::CutTree& /*tree*/) const
{
  throw ConfigError("decompose.method = \"geometry\" needs a solid model: CSG, STEP, IGES or BREP");
}

surface::DomainTets LoadedModel::fill_domain(const surface::DomainSkin& skin,
                                             const surface::CoarseOptions& options) const
{
  return netgen::fill_domain(skin, options);
}

surface::DomainTets LoadedModel::improve_domain(const surface::DomainSkin& skin,
                                                surface::DomainTets tets) const
{
  return netgen::improve_domain(skin, std::move(tets));
}

mesh::CoarseMesh LoadedModel::generate(const surface::CoarseOptions& options,
                                       const NetgenMeshUser& use) const
{
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
  static_cast<void>(mesh_surface(options, fill));
  return coarse;
}

}  // namespace tessera::netgen

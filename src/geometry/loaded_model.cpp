// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/loaded_model.hpp"

#include <limits>
#include <set>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/surface/defeature.hpp"
#include "tessera/surface/mend_folds.hpp"
#include "tessera/surface/mend_surface.hpp"

namespace tessera::geometry {
namespace {

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
  } catch (const GeometryError& error) {
    note_given_up("better shapes of coarse triangles", error);
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
  } catch (const GeometryError& error) {
    note_given_up("folds of the coarse surface", error);
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
  surface::CoarseSurface surface = is_cut ? mesh_parts(options, planes) : mesh_whole(options);
  if (!has_merged) surface = defeatured(std::move(surface), *this, options);
  // Steps on one side only would part it from its image.
  if (!options.periodic.empty()) return surface;
  return mended(std::move(surface), *this);
}

surface::CoarseSurface LoadedModel::mesh_parts(const surface::CoarseOptions& /*options*/,
                                               const cut::CutTree& /*tree*/) const
{
  throw ConfigError("decompose.method = \"geometry\" needs a solid model: CSG, STEP, IGES or BREP");
}

void LoadedModel::write_brep(const std::filesystem::path& /*file*/) const
{
  throw ConfigError("coarse.mesher = \"gmsh\" is for .step, .iges and .brep; leave it out");
}

const LoadedModel& as_loaded(const model::Model& model)
{
  const auto* loaded = dynamic_cast<const LoadedModel*>(&model);
  if (loaded == nullptr) throw MeshError("this needs a model of load_model()");
  return *loaded;
}

void name_curves(const model::Model& model, mesh::CoarseMesh& mesh)
{
  const std::set<LocalIndex> curves(mesh.segment_curve.begin(), mesh.segment_curve.end());
  mesh.curves.clear();
  for (const LocalIndex curve : curves) {
    if (curve != kNoIndex) mesh.curves.push_back(as_loaded(model).named_curve(curve));
  }
}

}  // namespace tessera::geometry

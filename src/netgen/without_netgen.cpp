// SPDX-License-Identifier: BSD-3-Clause
// Stands in for all other files of this module but model_file.cpp in a build with
// TESSERA_WITH_NETGEN=OFF: a mesh of the user's needs no library, and the triangles of an STL file
// can be read.
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/surface/overlap.hpp"

#include "geometry/loaded_model.hpp"
#include "geometry/own_mesh_model.hpp"
#include "geometry/stl_model.hpp"
#include "netgen/model_file.hpp"

namespace tessera::netgen {
namespace {

using model::ImportOptions;
using model::ModelSource;

[[noreturn]] void refuse(const char* what)
{
  throw ConfigError(fmt::format(
      "this build of tessera has no NETGEN (it was configured with "
      "-DTESSERA_WITH_NETGEN=OFF), so it cannot {}; it can check and repartition meshes, "
      "and refine a coarse mesh that geometry.file names (.msh, .vol or .vtu)",
      what));
}

class OwnMesher final : public coarse::CoarseMesher {
 public:
  explicit OwnMesher(const geometry::LoadedModel& model) : model_(model) {}

  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const cut::CutTree& planes) const override
  {
    surface::CoarseSurface surface = model_.mesh_surface(options, planes);
    if (surface.num_domains() > 0) refuse("mesh a CAD model");
    return surface;
  }

  [[nodiscard]] surface::DomainTets fill_domain(const surface::DomainSkin& /*skin*/,
                                                const surface::CoarseOptions&) const override
  {
    refuse("mesh a CAD model");
  }

 private:
  const geometry::LoadedModel& model_;
};

std::unique_ptr<geometry::LoadedModel> load_any(const ModelSource& source)
{
  require_reader(source.format);
  if (source.format == model::Format::stl) return std::make_unique<geometry::StlModel>(source);
  return geometry::load_own_mesh(source, load_any);
}

// Of the kernels only NETGEN's calls it.
class NoKernel final : public fill::Kernel {
 public:
  [[nodiscard]] fill::FillOutput fill(const fill::FillInput& /*input*/,
                                      const fill::KernelSettings& /*settings*/) const override
  {
    refuse("fill with fill.kernel = \"netgen\"");
  }
};

}  // namespace

void require_reader(model::Format format)
{
  if (format == model::Format::csg || format == model::Format::occ) refuse("read such a CAD model");
}

void load_library() {}  // There is none.

ModelSource import_model(const std::filesystem::path& file, const ImportOptions& options,
                         model::StepReader reader)
{
  require_model_file(file);
  if (format_of(file) == model::Format::stl) return geometry::import_stl(file, options, {});
  return geometry::import_own_mesh(
      file, options, [&](const std::filesystem::path& cad, const ImportOptions& of_cad) {
        return import_model(cad, of_cad, reader);
      });
}

std::unique_ptr<model::Model> load_model(const ModelSource& source) { return load_any(source); }

model::ModelDescription describe_model(const model::Model& model, surface::SurfaceMesher mesher)
{
  return geometry::as_loaded(model).describe(mesher);
}

coarse::ModelFigures measure_model(const model::Model& model)
{
  return geometry::as_loaded(model).figures();
}

void name_curves(const model::Model& model, mesh::CoarseMesh& mesh)
{
  geometry::name_curves(model, mesh);
}

std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(const model::Model& model)
{
  return std::make_unique<OwnMesher>(geometry::as_loaded(model));
}

std::unique_ptr<fill::Kernel> make_fill_kernel() { return std::make_unique<NoKernel>(); }

bool skin_overlaps(const fill::FillInput& skin)
{
  surface::PatchSurface triangles;
  for (std::size_t v = 0; v < skin.vertex_xyz.size() / 3; ++v) {
    triangles.vertex_xyz.push_back(point_at(std::span(skin.vertex_xyz), v));
  }
  for (std::size_t c = 0; c < skin.triangle_vertices.size(); c += 3) {
    const LocalIndex* const v = &skin.triangle_vertices[c];
    triangles.triangles.push_back({v[0], v[1], v[2]});
  }
  return !surface::find_overlaps(triangles).empty();
}

std::string netgen_version() { return "none"; }

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/stl_model.hpp"

#include <memory>

#include "cad/unite_shells.hpp"
#include "netgen/loaders.hpp"
#include "netgen/model_mesher.hpp"
#include "netgen/surface/stl_mesher.hpp"

namespace tessera::netgen {
namespace {

// An STL model that NETGEN's STL mesher can mesh as well.
class NetgenStlModel final : public NetgenModel<geometry::StlModel> {
 public:
  using NetgenModel::NetgenModel;

  using NetgenModel::mesh_whole;
  [[nodiscard]] surface::CoarseSurface mesh_whole(const surface::CoarseOptions& options,
                                                  const NetgenSurfaceUser& use) const override
  {
    if (options.surface_mesher == surface::SurfaceMesher::remesh)
      return StlModel::mesh_whole(options);
    return mesh_stl_surface(surface(), features(), options, name(), use);
  }
};

}  // namespace

model::ModelSource import_stl(const std::filesystem::path& file,
                              const model::ImportOptions& options, model::StepReader reader)
{
  const bool is_plain = reader == model::StepReader::plain;
  return geometry::import_stl(file, options,
                              is_plain ? geometry::ShellUniter() : cad::unite_flat_contacts);
}

std::unique_ptr<geometry::LoadedModel> load_stl(const model::ModelSource& source)
{
  return std::make_unique<NetgenStlModel>(source);
}

}  // namespace tessera::netgen

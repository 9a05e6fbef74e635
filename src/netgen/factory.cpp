// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/netgen/factory.hpp"

#include <utility>

#include "tessera/base/error.hpp"

#include "geometry/loaded_model.hpp"
#include "geometry/own_mesh_model.hpp"
#include "netgen/door.hpp"
#include "netgen/fill/fill_kernel.hpp"
#include "netgen/fill/skin_overlap.hpp"
#include "netgen/loaders.hpp"
#include "netgen/model_file.hpp"
#include "netgen/model_mesher.hpp"

namespace tessera::netgen {
namespace {

namespace fs = std::filesystem;
using model::ImportOptions;
using model::ModelSource;

class NetgenDoor final : public Door {
 public:
  [[nodiscard]] ModelSource import_model(const fs::path& file, const ImportOptions& options,
                                         model::StepReader reader) const override
  {
    require_model_file(file);
    switch (format_of(file)) {
      case model::Format::csg:
        return import_csg(file, options.assembly);
      case model::Format::stl:
        return import_stl(file, options, reader);
      case model::Format::own:
        return geometry::import_own_mesh(file, options,
                                         [&](const fs::path& cad, const ImportOptions& of_cad) {
                                           return import_model(cad, of_cad, reader);
                                         });
      default:
        return import_cad(file, options, reader);
    }
  }

  [[nodiscard]] std::unique_ptr<model::Model> load_model(const ModelSource& source) const override
  {
    return load_any_model(source);
  }

  [[nodiscard]] model::ModelDescription describe_model(const model::Model& model,
                                                       surface::SurfaceMesher mesher) const override
  {
    return geometry::as_loaded(model).describe(mesher);
  }

  [[nodiscard]] coarse::ModelFigures measure_model(const model::Model& model) const override
  {
    return geometry::as_loaded(model).figures();
  }

  void name_curves(const model::Model& model, mesh::CoarseMesh& mesh) const override
  {
    geometry::name_curves(model, mesh);
  }

  [[nodiscard]] std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(
      const model::Model& model) const override
  {
    return std::make_unique<ModelMesher>(geometry::as_loaded(model));
  }

  [[nodiscard]] std::unique_ptr<fill::Kernel> make_fill_kernel() const override
  {
    return make_netgen_kernel();
  }

  [[nodiscard]] bool skin_overlaps(const fill::FillInput& skin) const override
  {
    return cuts_itself(skin);
  }
};

}  // namespace

std::unique_ptr<geometry::LoadedModel> load_any_model(const ModelSource& source)
{
  switch (source.format) {
    case model::Format::csg:
      return load_csg(source);
    case model::Format::stl:
      return load_stl(source);
    case model::Format::occ:
      return load_cad(source);
    case model::Format::own:
      return geometry::load_own_mesh(source, load_any_model);
    default:
      throw InputError(source.file_name + ": unknown format of model");
  }
}

}  // namespace tessera::netgen

const tessera::netgen::Door* tessera_netgen_door()
{
  static const tessera::netgen::NetgenDoor door;
  return &door;
}

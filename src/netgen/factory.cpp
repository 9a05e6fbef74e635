// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/netgen/factory.hpp"

#include <set>
#include <utility>

#include "tessera/base/error.hpp"

#include "netgen/door.hpp"
#include "netgen/fill_kernel.hpp"
#include "netgen/gmsh_mesher.hpp"
#include "netgen/loaded_model.hpp"
#include "netgen/model_file.hpp"
#include "netgen/skin_overlap.hpp"

namespace tessera::netgen {
namespace {

namespace fs = std::filesystem;
using model::ImportOptions;
using model::ModelSource;

// What load_model() made, seen as a mesher; the model stays the caller's.
class MesherOfModel final : public coarse::CoarseMesher {
 public:
  explicit MesherOfModel(const LoadedModel& model) : model_(model) {}

  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const cut::CutTree& planes) const override
  {
    if (options.mesher == surface::Mesher::netgen) return model_.mesh_surface(options, planes);
    if (planes.num_parts > 0) {
      throw ConfigError(
          "coarse.mesher = \"gmsh\" meshes whole models only; with decompose.method = "
          "\"geometry\" leave it out");
    }
    return {.mesh = mesh_with_gmsh(model_, options)};
  }

  [[nodiscard]] surface::DomainTets fill_domain(
      const surface::DomainSkin& skin, const surface::CoarseOptions& options) const override
  {
    return model_.fill_domain(skin, options);
  }

  [[nodiscard]] surface::DomainTets improve_domain(const surface::DomainSkin& skin,
                                                   surface::DomainTets tets) const override
  {
    return model_.improve_domain(skin, std::move(tets));
  }

 private:
  const LoadedModel& model_;
};

const LoadedModel& loaded(const model::Model& model)
{
  const auto* loaded = dynamic_cast<const LoadedModel*>(&model);
  if (loaded == nullptr) throw MeshError("this needs a model of load_model()");
  return *loaded;
}

class NetgenDoor final : public Door {
 public:
  [[nodiscard]] ModelSource import_model(const fs::path& file, const ImportOptions& options,
                                         StepReader reader) const override
  {
    require_model_file(file);
    switch (format_of(file)) {
      case model::Format::csg:
        return import_csg(file);
      case model::Format::stl:
        return import_stl(file, options, reader);
      case model::Format::own:
        return import_own_mesh(file, options, reader);
      default:
        return import_occ(file, options, reader);
    }
  }

  [[nodiscard]] std::unique_ptr<model::Model> load_model(const ModelSource& source) const override
  {
    return load_any_model(source);
  }

  [[nodiscard]] model::ModelDescription describe_model(const model::Model& model,
                                                       surface::SurfaceMesher mesher) const override
  {
    return loaded(model).describe(mesher);
  }

  [[nodiscard]] coarse::ModelFigures measure_model(const model::Model& model) const override
  {
    return loaded(model).figures();
  }

  void name_curves(const model::Model& model, mesh::CoarseMesh& mesh) const override
  {
    const std::set<LocalIndex> curves(mesh.segment_curve.begin(), mesh.segment_curve.end());
    mesh.curves.clear();
    for (const LocalIndex curve : curves) {
      if (curve != kNoIndex) mesh.curves.push_back(loaded(model).named_curve(curve));
    }
  }

  [[nodiscard]] std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(
      const model::Model& model) const override
  {
    return std::make_unique<MesherOfModel>(loaded(model));
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

void LoadedModel::write_brep(const fs::path& /*file*/) const
{
  throw ConfigError("coarse.mesher = \"gmsh\" is for .step, .iges and .brep; leave it out");
}

std::unique_ptr<LoadedModel> load_any_model(const ModelSource& source)
{
  switch (source.format) {
    case model::Format::csg:
      return load_csg(source);
    case model::Format::stl:
      return load_stl(source);
    case model::Format::occ:
      return load_occ(source);
    case model::Format::own:
      return load_own_mesh(source);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/netgen/factory.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/model/options.hpp"

#include "netgen/gmsh_mesher.hpp"
#include "netgen/loaded_model.hpp"

namespace tessera::netgen {
namespace {

namespace fs = std::filesystem;
using model::ImportOptions;
using model::ModelSource;

struct FileKind {
  std::string_view extension;  // Lower case.
  ModelSource (*import)(const fs::path& file, const ImportOptions& options, StepReader reader);
};

constexpr FileKind kFileKinds[] = {
    {".geo",
     [](const fs::path& file, const ImportOptions&, StepReader) { return import_csg(file); }},
    {".stl", import_stl},
    {".step", import_occ},
    {".stp", import_occ},
    {".iges", import_occ},
    {".igs", import_occ},
    {".brep", import_occ},
    {".msh", import_own_mesh},
    {".vol", import_own_mesh},
    {".vtu", import_own_mesh},
};

[[noreturn]] void throw_unknown_kind(const fs::path& file)
{
  std::string allowed;
  for (const FileKind& kind : kFileKinds) {
    allowed += (allowed.empty() ? "" : " ") + std::string(kind.extension);
  }
  throw InputError(
      fmt::format("{}: not a kind of CAD file that is known by its extension; known are {}",
                  file.string(), allowed));
}

const FileKind* find_kind(const fs::path& file)
{
  const auto* const kind =
      std::ranges::find(kFileKinds, model::lower_case_extension(file), &FileKind::extension);
  return kind == std::ranges::end(kFileKinds) ? nullptr : kind;
}

const FileKind& kind_of(const fs::path& file)
{
  const FileKind* const kind = find_kind(file);
  if (kind == nullptr) throw_unknown_kind(file);
  return *kind;
}

// Says what is wrong before a reader of NETGEN or OpenCASCADE, whose words help less, sees the
// file.
void require_readable(const fs::path& file)
{
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    throw InputError(file.string() + ": no such file; check geometry.file, which is relative to the "
                     "case file's folder");
  }
  if (status.type() == fs::file_type::directory) {
    throw InputError(file.string() + ": is a folder; name a CAD file in it");
  }
  if (fs::is_other(status) && status.type() != fs::file_type::unknown) {
    throw InputError(file.string() + ": is a pipe or a device; name a CAD file");
  }
  if (!std::ifstream(file, std::ios::binary)) {
    throw InputError(file.string() + ": cannot be read; check its permissions");
  }
  if (fs::file_size(file, error) == 0 && !error) {
    throw InputError(file.string() + ": is empty; export the model again");
  }
}

// What load_model() made, seen as a mesher; the model stays the caller's.
class MesherOfModel final : public coarse::CoarseMesher {
 public:
  explicit MesherOfModel(const LoadedModel& model) : model_(model) {}

  [[nodiscard]] coarse::CoarseSurface mesh_surface(const coarse::CoarseOptions& options,
                                                   const cut::CutTree& planes) const override
  {
    if (options.mesher == coarse::Mesher::netgen) return model_.mesh_surface(options, planes);
    if (planes.num_parts > 0) {
      throw ConfigError(
          "coarse.mesher = \"gmsh\" meshes whole models only; with decompose.method = "
          "\"geometry\" leave it out");
    }
    return {.mesh = mesh_with_gmsh(model_, options)};
  }

  [[nodiscard]] coarse::DomainTets fill_domain(const coarse::DomainSkin& skin,
                                               const coarse::CoarseOptions& options) const override
  {
    return model_.fill_domain(skin, options);
  }

  [[nodiscard]] coarse::DomainTets improve_domain(const coarse::DomainSkin& skin,
                                                  coarse::DomainTets tets) const override
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

}  // namespace

void LoadedModel::write_brep(const fs::path& /*file*/) const
{
  throw ConfigError("coarse.mesher = \"gmsh\" is for .step, .iges and .brep; leave it out");
}

void require_model_file(const fs::path& file)
{
  static_cast<void>(kind_of(file));
  require_readable(file);
}

bool is_model_name(const fs::path& file) { return find_kind(file) != nullptr; }

model::ModelSource import_model(const fs::path& file, const ImportOptions& options,
                                StepReader reader)
{
  require_model_file(file);
  return kind_of(file).import(file, options, reader);
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

std::unique_ptr<model::Model> load_model(const ModelSource& source)
{
  return load_any_model(source);
}

coarse::ModelFigures measure_model(const model::Model& model) { return loaded(model).figures(); }

model::ModelDescription describe_model(const model::Model& model, coarse::SurfaceMesher mesher)
{
  return loaded(model).describe(mesher);
}

void name_curves(const model::Model& model, mesh::CoarseMesh& mesh)
{
  const std::set<LocalIndex> curves(mesh.segment_curve.begin(), mesh.segment_curve.end());
  mesh.curves.clear();
  for (const LocalIndex curve : curves) {
    if (curve != kNoIndex) mesh.curves.push_back(loaded(model).named_curve(curve));
  }
}

std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(const model::Model& model)
{
  return std::make_unique<MesherOfModel>(loaded(model));
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/door.hpp"

#include <string>

#ifdef TESSERA_NETGEN_LIBRARY  // Not if libtessera is static: then all is in one file.
#include <dlfcn.h>
#endif

#include "tessera/base/error.hpp"

#include "netgen/model_file.hpp"

namespace tessera::netgen {
namespace {

#ifdef TESSERA_NETGEN_LIBRARY

const Door& open_door()
{
  void* const library = ::dlopen(TESSERA_NETGEN_LIBRARY, RTLD_LAZY | RTLD_LOCAL);
  void* const door = library == nullptr ? nullptr : ::dlsym(library, "tessera_netgen_door");
  if (door == nullptr) {
    throw ConfigError(std::string("the part of tessera that holds NETGEN and OpenCASCADE cannot be "
                                  "loaded: ")
                      + ::dlerror() + "; it belongs beside libtessera: install tessera again");
  }
  return *reinterpret_cast<decltype(&tessera_netgen_door)>(door)();
}

#else

const Door& open_door() { return *tessera_netgen_door(); }

#endif

const Door& door()
{
  static const Door& opened = open_door();
  return opened;
}

}  // namespace

void require_reader(model::Format /*format*/) {}  // All can be read.

void load_library() { static_cast<void>(door()); }

model::ModelSource import_model(const std::filesystem::path& file,
                                const model::ImportOptions& options, model::StepReader reader)
{
  return door().import_model(file, options, reader);
}

std::unique_ptr<model::Model> load_model(const model::ModelSource& source)
{
  return door().load_model(source);
}

model::ModelDescription describe_model(const model::Model& model, surface::SurfaceMesher mesher)
{
  return door().describe_model(model, mesher);
}

coarse::ModelFigures measure_model(const model::Model& model)
{
  return door().measure_model(model);
}

void name_curves(const model::Model& model, mesh::CoarseMesh& mesh)
{
  door().name_curves(model, mesh);
}

std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(const model::Model& model)
{
  return door().make_coarse_mesher(model);
}

std::unique_ptr<fill::Kernel> make_fill_kernel() { return door().make_fill_kernel(); }

bool skin_overlaps(const fill::FillInput& skin) { return door().skin_overlaps(skin); }

std::string netgen_version() { return TESSERA_NETGEN_VERSION; }

}  // namespace tessera::netgen

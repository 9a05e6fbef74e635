// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "tessera/netgen/factory.hpp"

namespace tessera::testing {

/// @brief One of our own models in configs/geometry.
[[nodiscard]] inline std::filesystem::path own_model(const std::string& name)
{
  return std::filesystem::path(TESSERA_GEOMETRY_DIR) / name;
}

[[nodiscard]] inline std::unique_ptr<model::Model> load_own(const std::string& name)
{
  return netgen::load_model(netgen::import_model(own_model(name), {}));
}

[[nodiscard]] inline mesh::CoarseMesh coarse_mesh_of(
    const model::Model& model, double max_size,
    surface::SurfaceMesher mesher = surface::SurfaceMesher::netgen)
{
  surface::CoarseOptions options;
  options.max_size = max_size;
  options.surface_mesher = mesher;
  return netgen::make_coarse_mesher(model)->generate(options);
}

}  // namespace tessera::testing

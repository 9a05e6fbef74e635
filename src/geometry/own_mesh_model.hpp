// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "tessera/model/model.hpp"
#include "tessera/model/options.hpp"

#include "geometry/loaded_model.hpp"

namespace tessera::geometry {

/// @brief Reads and loads the CAD model that a mesh is of.
using CadImporter =
    std::function<model::ModelSource(const std::filesystem::path&, const model::ImportOptions&)>;
using CadLoader = std::function<std::unique_ptr<LoadedModel>(const model::ModelSource&)>;

/// @brief Reads a mesh of the user's by its extension (.msh .vol .vtu), with `options.cad` if that
/// names a model, and checks it. Local. @throws InputError, and as `import_cad`.
[[nodiscard]] model::ModelSource import_own_mesh(const std::filesystem::path& file,
                                                 const model::ImportOptions& options,
                                                 const CadImporter& import_cad);

/// @brief Loads what import_own_mesh() read. Local. @throws As `load_cad`.
[[nodiscard]] std::unique_ptr<LoadedModel> load_own_mesh(const model::ModelSource& source,
                                                         const CadLoader& load_cad);

}  // namespace tessera::geometry

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "tessera/model/model.hpp"
#include "tessera/model/options.hpp"

#include "geometry/loaded_model.hpp"

namespace tessera::netgen {

/// @brief load_model(), as what it is. @throws As load_model().
[[nodiscard]] std::unique_ptr<geometry::LoadedModel> load_any_model(
    const model::ModelSource& source);

// One pair of functions a format; the contracts are those of import_model() and load_model().
[[nodiscard]] model::ModelSource import_csg(const std::filesystem::path& file,
                                            const model::AssemblyOptions& options);
[[nodiscard]] std::unique_ptr<geometry::LoadedModel> load_csg(const model::ModelSource& source);

[[nodiscard]] model::ModelSource import_stl(
    const std::filesystem::path& file, const model::ImportOptions& options,
    model::StepReader reader = model::StepReader::with_names);
[[nodiscard]] std::unique_ptr<geometry::LoadedModel> load_stl(const model::ModelSource& source);

[[nodiscard]] model::ModelSource import_cad(const std::filesystem::path& file,
                                            const model::ImportOptions& options,
                                            model::StepReader reader);
[[nodiscard]] std::unique_ptr<geometry::LoadedModel> load_cad(const model::ModelSource& source);

}  // namespace tessera::netgen

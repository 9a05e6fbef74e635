// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/model/model.hpp"

namespace tessera::netgen {

/// @brief A loaded model of any format: projection, and one try at a coarse mesh.
class LoadedModel : public model::Model, public coarse::CoarseMesher {};

// One pair of functions a format; the contracts are those of import_model() and load_model().
[[nodiscard]] model::ModelSource import_csg(const std::filesystem::path& file);
[[nodiscard]] std::unique_ptr<LoadedModel> load_csg(const model::ModelSource& source);

[[nodiscard]] model::ModelSource import_stl(const std::filesystem::path& file,
                                            const model::ImportOptions& options);
[[nodiscard]] std::unique_ptr<LoadedModel> load_stl(const model::ModelSource& source);

[[nodiscard]] model::ModelSource import_occ(const std::filesystem::path& file);
[[nodiscard]] std::unique_ptr<LoadedModel> load_occ(const model::ModelSource& source);

}  // namespace tessera::netgen

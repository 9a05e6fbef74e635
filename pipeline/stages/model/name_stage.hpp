// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <tuple>

#include "tessera/base/bytes.hpp"
#include "tessera/config/case.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/model.hpp"
#include "tessera/model/part_names.hpp"
#include "tessera/surface/options.hpp"

#include "pipeline/jobs/run_job.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Runs a describe_request(), and a second one if NETGEN fails on a CSG model: triangles of
/// OpenCASCADE's solids give the same numbers and names.
/// @note Local.
/// @param[in] run_describe Runs a job by its name and request.
/// @returns What has ended well, else what the first one has ended with.
[[nodiscard]] JobResult<model::ModelDescription> describe_in_jobs(
    model::Format format,
    const std::function<JobResult<model::ModelDescription>(const std::string&, const Bytes&)>&
        run_describe);

/// @brief What the model holds by NETGEN's triangles, file length unit.
/// @note For rank 0: runs a job of it. @throws what the job fails for.
[[nodiscard]] model::ModelDescription describe_model(const config::Case& given,
                                                     RunContext& context);

/// @brief What the case says of parts of the model.
struct PartsOfCase {
  model::NamedParts named{};
  surface::KeptParts kept{};  ///< Named by [[geometry.name]], or as the shape of a [[size.region]].

  std::vector<surface::PeriodicPatches> periodic{};  ///< Of [[periodic]], output length unit.

  static auto fields(auto& self) { return std::tie(self.named, self.kept, self.periodic); }
};

/// @brief Whether the case gives names, names what could be merged, or has sides or embedded faces
/// that are found by their names: then the model is to be asked. Local.
[[nodiscard]] bool names_parts(const config::Case& given, model::Format format);

/// @brief Which faces, solids and curves of the model the case names.
/// @note Collective: the model is described in a job of rank 0.
/// @throws ConfigError on every rank if a name of [[geometry.name]] fits nothing, or two fit the
/// same.
[[nodiscard]] PartsOfCase run_name_stage(const config::Case& given, model::Format format,
                                         RunContext& context);

}  // namespace tessera::pipeline

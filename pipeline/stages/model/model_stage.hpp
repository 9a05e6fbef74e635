// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tessera/base/bytes.hpp"
#include "tessera/config/case.hpp"
#include "tessera/model/model.hpp"

#include "pipeline/jobs/run_job.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Reads the CAD file on rank 0, in a job, and loads what was read in the workers of all
/// ranks.
/// @note Collective.
/// @throws InputError, GeometryError on every rank if the file is no model that can be meshed.
[[nodiscard]] model::ModelSource run_model_stage(const config::Case& run_case, RunContext& context);

/// @brief Reads a CAD file in a job. Where OpenCASCADE's reader of STEP dies, its plain reader is
/// tried in a second job, which loses names; the model's repairs say so. Local.
/// @param[in] run_import Runs a job of that name with that request, and keeps it if it failed.
/// @throws As require_read(), of the first job.
[[nodiscard]] model::ModelSource import_in_jobs(
    const std::filesystem::path& file, const model::ImportOptions& options,
    const std::function<JobResult<model::ModelSource>(const std::string& name,
                                                      const Bytes& request)>& run_import);

/// @brief require_ok() for a job or load that reads the model. Whatever makes the reader fail, the
/// error says that the file is bad, not the program. Local.
void require_read(const jobs::JobEnd& end, const std::filesystem::path& file);

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/improve/region_mesh.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"

#include "pipeline/jobs/run_job.hpp"

/// What a run leaves in DIR/failure of jobs that failed, for `tessera replay` and for people.
namespace tessera::pipeline {

/// @brief A job as it can be run again, in any process: what was loaded before it, and its request.
struct RecordedJob {
  std::string name{};
  std::vector<Bytes> loads{};  ///< In the order in which they are to be loaded.
  Bytes request{};
};

/// @brief Puts a failed job into a folder of its own under DIR/failure: `job.bin` (its request, and
/// which files of DIR/failure/inputs it needs), `log.txt` (what happened and what the job said).
///
/// What cannot be written is a warning and no error: the run has its own trouble. A rank keeps a
/// few jobs only. Local.
/// @param[in] request  In place of the job's own, if that would write into the run's folder.
/// @return The job's folder; empty if it was not kept.
std::filesystem::path keep_failed_job(const JobRequest& job, const Bytes& request,
                                      const jobs::JobEnd& end, RunContext& context);

/// @brief Keeps a job as it was if it failed; not one that was cancelled. Local.
void keep_if_failed(const JobRequest& job, const jobs::JobEnd& end, RunContext& context);

/// @brief Adds to a kept fill job what it was about: its subdomain's skin, as `skin.vtu`, which a
/// job makes, and for all of them DIR/failure/coarse.vtu. Local; warns as keep_failed_job().
void keep_meshes_of_failed_fill(const std::filesystem::path& kept, LocalIndex subdomain,
                                const mesh::CoarseMesh& coarse,
                                const mesh::Decomposition& decomposition,
                                const jobs::JobRunner::WaitCallback& on_wait, RunContext& context);

/// @brief Adds to a kept job of the improvement what it was about: the tets of its region, as
/// `region.vtu`, and for all jobs DIR/failure/coarse.vtu. Local; warns as keep_failed_job().
/// @param[in] extract Takes the region out of its pieces; not called if the job was not kept.
void keep_meshes_of_failed_region(const std::filesystem::path& kept,
                                  const std::function<improve::RegionMesh()>& extract,
                                  const mesh::CoarseMesh& coarse,
                                  const mesh::Decomposition& decomposition, RunContext& context);

/// @brief Of a run whose STL file bounds no body: DIR/failure/places.vtu, .png and .html, which
/// show where. A job finds the places; if there are none, nothing is written. Local; warns as
/// keep_failed_job().
/// @param[in] message Why the run failed.
void keep_places(const std::filesystem::path& file, const std::string& message,
                 RunContext& context);

/// @brief Reads a kept job. Local.
/// @throws InputError naming the file: missing, truncated, of another version of the program.
[[nodiscard]] RecordedJob read_failed_job(const std::filesystem::path& folder);

}  // namespace tessera::pipeline

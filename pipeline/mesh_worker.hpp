// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "tessera/base/bytes.hpp"
#include "tessera/coarse/options.hpp"
#include "tessera/fill/kernel.hpp"
#include "tessera/jobs/job_runner.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/damping.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/model/model.hpp"

/// Everything that runs in job processes because it calls NETGEN or OpenCASCADE, and the messages
/// that start it. A job's result is the bytes that the stage reads back.
namespace tessera::pipeline {

/// @brief Makes the worker of the program's job processes.
[[nodiscard]] std::unique_ptr<jobs::Worker> make_mesh_worker();

/// @brief load: the model. `scale`: output length units per file length unit.
[[nodiscard]] Bytes load_model_message(const model::ModelSource& source, double scale);

/// @brief load: coarse mesh and decomposition, the number of levels, and where pieces go.
[[nodiscard]] Bytes load_mesh_message(const mesh::CoarseMesh& coarse,
                                      const mesh::Decomposition& decomposition, int levels,
                                      const std::filesystem::path& piece_folder);

/// @brief load: the finished plan.
[[nodiscard]] Bytes load_plan_message(const mesh::Damping& damping);

/// @brief run: reads a CAD file; result: bytes of a ModelSource. Needs no load.
[[nodiscard]] Bytes import_request(const std::filesystem::path& file,
                                   const model::ImportOptions& options);

/// @brief run: result: the diagonal of the model's box, output length unit, a double. Needs the
/// model.
[[nodiscard]] Bytes box_request();

/// @brief run: one try at the coarse mesh; result: bytes of a CoarseMesh. Needs the model.
[[nodiscard]] Bytes coarse_request(const coarse::CoarseOptions& options);

/// @brief run: tests one subdomain for folds under the given dampings; result: bytes of a Damping
/// with the new, smaller factors. Needs model and mesh.
[[nodiscard]] Bytes plan_request(LocalIndex subdomain, const mesh::Damping& damping);

/// @brief run: refines, fills and checks one subdomain and stores the piece; result: bytes of a
/// FillResult. A piece whose smallest dihedral angle does not beat `angle_to_beat_deg` is an error
/// and leaves the store as it was. Needs model, mesh and plan.
[[nodiscard]] Bytes fill_request(LocalIndex subdomain, const fill::FillTry& settings,
                                 double angle_to_beat_deg);

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/stages/fill/fill_stage.hpp"
#include "pipeline/store/piece_store.hpp"

namespace tessera::pipeline {

struct RunResult;

/// @brief What one file will hold.
struct GatheredFile {
  subdomain::PieceFile file;
  std::vector<Hash128> digests{};  ///< Of its pieces, in the order of subdomains.
};

/// @brief Reads the pieces of one file from the store, one after the other. Local.
/// @throws InputError if a record is damaged.
[[nodiscard]] GatheredFile gather_file(const subdomain::SubdomainRange& range,
                                       const io::OutputOptions& options,
                                       const subdomain::WriteContext& mesh,
                                       const PieceStore& pieces);

/// @brief gather_file(), and writes it. Local.
/// @return Their digests, in the order of subdomains.
/// @throws OutputError (disk full, permission); InputError if a record is damaged.
std::vector<Hash128> write_file(const subdomain::SubdomainRange& range,
                                const io::OutputOptions& options,
                                const subdomain::WriteContext& mesh, const PieceStore& pieces);

/// @brief Turns the pieces of the store into files. Each range gets mesh/piece_NNNNNN.vtu and
/// boundary/piece_NNNNNN.vtu.
/// @return Digests of the pieces, as `filled` has these.
/// @note Collective.
/// @throws OutputError on every rank (disk full, permission).
[[nodiscard]] std::vector<Hash128> run_write_stage(
    const config::Case& run_case, const std::vector<subdomain::SubdomainRange>& files,
    const subdomain::WriteContext& mesh, const FilledPieces& filled, RunContext& context);

/// @brief The files that have boundary triangles, relative to the output folder. Local.
[[nodiscard]] std::vector<std::filesystem::path> boundary_files(
    const std::vector<subdomain::SubdomainRange>& files,
    const std::vector<subdomain::PieceSummary>& pieces);

/// @brief Writes the indices mesh.pvtu and boundary.pvtu, and lines.pvtu if there are lines: from
/// now on there is a mesh. If it is known which files share points (RunResult::files), mesh.pvtu
/// says so.
/// @note Collective. @throws OutputError on every rank.
void write_indices(const RunResult& run, const std::vector<subdomain::SubdomainRange>& files,
                   const subdomain::WriteContext& mesh, RunContext& context);

}  // namespace tessera::pipeline

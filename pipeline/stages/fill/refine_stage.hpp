// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"
#include "tessera/subdomain/refine_piece.hpp"

#include "pipeline/runtime/run_context.hpp"
#include "pipeline/store/filled_pieces.hpp"

namespace tessera::pipeline {

/// @brief What the refine stage works on. Borrowed.
struct RefineWork {
  const subdomain::PartitionedMesh& cut;
  const std::vector<fill::KernelKind>& kernels;  ///< As the case wants them, by subdomain.
  const subdomain::PieceSplit& split;
  const std::vector<subdomain::SubdomainRange>& ranges;  ///< What each job makes: one file, or
                                                         ///< one piece for the store.
  bool has_files = true;
  const std::string& length_unit;
};

/// @brief Splits the pieces of the store further, in closed form, and smooths them, or gives their
/// tets nodes of second order: jobs of all ranks, which write the files themselves. Where tets fold
/// although they were smoothed, or are not certainly valid when they are curved, points are held
/// back from the geometry, and the pieces around them are made again.
/// @return The figures of the pieces as they are now, and the limits with the new ones.
/// @note Collective.
/// @throws MeshError on every rank if a piece cannot be split; OutputError; Interrupted.
[[nodiscard]] LimitedPieces run_refine_stage(const config::Case& run_case, const RefineWork& work,
                                             LimitedPieces before, RunContext& context);

}  // namespace tessera::pipeline

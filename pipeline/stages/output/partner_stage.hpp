// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Tells points of periodic sides in the boundary files whose images they are.
/// @note Collective. @throws MeshError on every rank if a point of an image matches none; else as
/// subdomain::add_periodic_partners().
void run_partner_stage(const RunResult& run, const std::vector<subdomain::SubdomainRange>& files,
                       RunContext& context);

}  // namespace tessera::pipeline

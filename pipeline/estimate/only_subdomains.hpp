// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/subdomain/piece_file.hpp"

/// What `--only-subdomains` needs. Part of a mesh has ids only if the number of all other tets is
/// known without making them. So every subdomain must be subdivided. And each subdomain is a file
/// of its own.
namespace tessera::pipeline {

/// @brief Refuses what the case alone rules out; to ask before anything is done. Local.
/// @throws ConfigError naming the keys.
void require_only_subdomains_possible(const config::Case& given);

/// @brief The files of a run of some subdomains: one for each. Local.
/// @param[in] only Ascending, not empty. @param[in] kernels Shape (num_subdomains).
/// @throws ConfigError if a kernel is in the way, or if there is no such subdomain.
[[nodiscard]] std::vector<subdomain::SubdomainRange> ranges_of_only(
    const std::vector<LocalIndex>& only, const std::vector<fill::KernelKind>& kernels);

}  // namespace tessera::pipeline

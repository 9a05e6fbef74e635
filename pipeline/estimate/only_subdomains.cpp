// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/estimate/only_subdomains.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "pipeline/estimate/run_outline.hpp"

namespace tessera::pipeline {
namespace {

[[noreturn]] void refuse_kernels()
{
  throw ConfigError(
      fmt::format("--only-subdomains needs fill.kernel = \"{}\", and no fill.region with another "
                  "kernel",
                  word_of(fill::KernelKind::subdivide)));
}

}  // namespace

void require_only_subdomains_possible(const config::Case& given)
{
  if (given.output.files != 0 || given.output.parts != 0) {
    throw ConfigError("--only-subdomains excludes output.files and output.parts");
  }
  if (given.fill.split_corners == true) {
    throw ConfigError("--only-subdomains excludes fill.split_corners");
  }
  // Only the model tells whether the regions are all there is.
  std::vector<fill::KernelKind> named{given.fill.kernel};
  for (const fill::FillRegion& region : given.fill.regions) named.push_back(region.kernel);
  if (std::ranges::count(named, fill::KernelKind::subdivide) == 0) refuse_kernels();
}

std::vector<subdomain::SubdomainRange> ranges_of_only(const std::vector<LocalIndex>& only,
                                                      const std::vector<fill::KernelKind>& kernels)
{
  if (!are_counts_known(kernels)) refuse_kernels();
  if (at(only.back()) >= kernels.size()) {
    throw ConfigError(fmt::format("--only-subdomains: there is no subdomain {}, the last one is {}",
                                  only.back(), kernels.size() - 1));
  }
  return subdomain::single_ranges(only);
}

}  // namespace tessera::pipeline

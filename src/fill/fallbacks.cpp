// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/fallbacks.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"

namespace tessera::fill {

bool splits_corners(const FillOptions& options, KernelKind kernel)
{
  return options.split_corners.value_or(kernel != KernelKind::subdivide);
}

int fill_levels(const FillOptions& options, int levels)
{
  constexpr int kSplitByItself = 2;
  const int wanted =
      options.levels == 0 ? std::max(levels - kSplitByItself, kSplitByItself) : options.levels;
  return std::min(wanted, levels);
}

namespace {

std::vector<FillTry> tries_of(const FillOptions& options, KernelKind kernel)
{
  const FillTry subdivision{.kernel = KernelKind::subdivide};
  if (kernel == KernelKind::subdivide) return {subdivision};
  if (kernel == KernelKind::optimize) return {{.kernel = KernelKind::optimize}, subdivision};
  const FillTry asked{
      .settings = {.grading = options.grading, .optimize_steps = options.optimize_steps}};
  FillTry anew = asked;
  anew.start = FillStart::skin;
  FillTry reordered = anew;
  reordered.settings.point_order_seed = 1;
  const FillTry relaxed{.start = FillStart::skin,
                        .settings = {.grading = std::min(1.0, 2.0 * options.grading),
                                     .optimize_steps = std::min(1, options.optimize_steps),
                                     .point_order_seed = 2}};
  return {asked, anew, reordered, relaxed, subdivision};
}

}  // namespace

std::vector<FillTry> fallback_sequence(const FillOptions& options, KernelKind kernel)
{
  std::vector<FillTry> tries = tries_of(options, kernel);
  const auto is_substitute = [&](const FillTry& how) {
    const bool is_other = how.kernel != kernel;
    return is_left_out(is_other ? Repair::subdivided_fills : Repair::fill_tries);
  };
  tries.erase(std::remove_if(tries.begin() + 1, tries.end(), is_substitute), tries.end());
  for (FillTry& how : tries) how.split_corners = splits_corners(options, kernel);
  return tries;
}

std::vector<KernelKind> kernels_of(const FillOptions& options,
                                   const std::vector<std::string>& material_names,
                                   std::span<const LocalIndex> materials)
{
  std::vector<KernelKind> by_material(material_names.size(), options.kernel);
  for (const FillRegion& region : options.regions) {
    if (std::ranges::find(material_names, region.material) == material_names.end()) {
      std::string text =
          fmt::format("fill.region: the model has no material \"{}\"; it has", region.material);
      for (const std::string& name : material_names) text += fmt::format(" \"{}\"", name);
      throw ConfigError(text);
    }
    for (std::size_t m = 0; m < material_names.size(); ++m) {
      if (material_names[m] == region.material) by_material[m] = region.kernel;
    }
  }
  std::vector<KernelKind> kernels;
  kernels.reserve(materials.size());
  for (const LocalIndex material : materials) {
    kernels.push_back(by_material[at(material - 1)]);
  }
  return kernels;
}

}  // namespace tessera::fill

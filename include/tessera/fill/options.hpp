// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tessera/base/enum_words.hpp"

namespace tessera::fill {

/// @brief What puts tets into a skin.
enum class KernelKind : int {
  netgen,     ///< NETGEN, which begins with the children of the coarse tets; then as `optimize`.
  subdivide,  ///< The children as they are.
  optimize,   ///< The children, made better by the module `optimize`.
};
[[nodiscard]] constexpr KernelKind last_value(KernelKind /*type*/) { return KernelKind::optimize; }

/// @brief Words of `fill.kernel`, and of the reports.
constexpr auto enum_words(KernelKind /*tag*/)
{
  return std::to_array<EnumWord<KernelKind>>({
      {KernelKind::netgen, "netgen"},
      {KernelKind::optimize, "optimize"},
      {KernelKind::subdivide, "subdivide"},
  });
}

/// @brief The kernel for the subdomains of one material; table `[[fill.region]]` of a case file.
struct FillRegion {
  std::string material{};  ///< Its name in the model, not empty.
  KernelKind kernel = KernelKind::netgen;

  friend bool operator==(const FillRegion&, const FillRegion&) = default;
};

/// @brief More levels than there ever are.
inline constexpr int kAllLevels = 10;

/// @brief Options of the fill; table `[fill]` of a case file.
struct FillOptions {
  KernelKind kernel = KernelKind::netgen;
  std::vector<FillRegion> regions{};  ///< In place of `kernel`; no material twice.
  int levels = 0;  ///< Of the refinement's, >= 1: on these subdomains are filled, and their tets
                   ///< are split for the others. 0 stands for "auto".
  double timeout_s = 0.0;   ///< CPU seconds a job, or of sleep (at most 120); 0: many times what
                            ///< its predicted tets take.
  double memory_gib = 4.0;  ///< Resident memory of a job, GiB, > 0.
  int optimize_steps = 1;   ///< NETGEN's rounds of swaps, or of all its steps where it
                            ///< meshes a skin, >= 0.
  double grading = 0.3;     ///< Growth of the size away from the skin, in (0, 1].

  /// Whether tets with several faces on the geometry are divided once they are filled. Then the
  /// improvement of seams makes none. None stands for "auto": see splits_corners().
  std::optional<bool> split_corners{};

  friend bool operator==(const FillOptions&, const FillOptions&) = default;
};

/// @brief Whether tets of subdomains of that kernel that have several faces on the geometry are
/// divided. "auto" leaves alone what is subdivided: its ids are known before it is made.
[[nodiscard]] bool splits_corners(const FillOptions& options, KernelKind kernel);

/// @brief How many of `levels` subdomains are filled on. "auto" leaves two for the split, but fills
/// on two at least: measured on eleven models, the split mesh is then as good as one that was
/// filled on all levels.
[[nodiscard]] int fill_levels(const FillOptions& options, int levels);

}  // namespace tessera::fill

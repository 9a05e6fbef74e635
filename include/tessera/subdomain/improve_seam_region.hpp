// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/improve/improve_region.hpp"
#include "tessera/improve/seam_regions.hpp"

namespace tessera::subdomain {

/// @brief What the improvement of one seam region has ended with.
struct RegionRecord {
  bool is_improved = false;
  bool has_failed = false;   ///< The job died, or what it found was not valid.
  bool was_limited = false;  ///< It died for time or memory: not reproducible.
  std::string reason{};      ///< Why the region keeps its tets; empty if it is improved.
  /// By piece, in the order of the region's subdomains; empty unless it is improved.
  std::vector<improve::PieceUpdate> updates{};

  static auto fields(auto& self)
  {
    return std::tie(self.is_improved, self.has_failed, self.was_limited, self.reason, self.updates);
  }
};

/// @brief Optimises the tets of one region and judges the result.
/// @note Local; a pure function. It takes a while: call it in a job process.
/// @throws MeshError if the try failed.
[[nodiscard]] RegionRecord improve_tets(const improve::RegionMesh& mesh, int rounds,
                                        const improve::Optimizer& optimizer);

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <tuple>
#include <vector>

#include "tessera/base/fields.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::quality {

/// @brief A tet of bad shape, and where it is.
struct WorstTet {
  LocalIndex subdomain = kNoIndex;
  Vec3 centre{};  ///< Mean of the corners, output length unit.
  double mean_ratio = 1.0;
  double min_dihedral_deg = 180.0;
  double max_dihedral_deg = 0.0;

  static auto fields(auto& self)
  {
    return std::tie(self.subdomain, self.centre, self.mean_ratio, self.min_dihedral_deg,
                    self.max_dihedral_deg);
  }

  friend bool operator==(const WorstTet&, const WorstTet&) = default;
};

/// @brief The tets of lowest mean ratio, the worst first; of equal ones those of the lower
/// subdomain, then those that were added first. So it does not matter which rank has which
/// subdomain.
class WorstTets {
 public:
  static constexpr std::size_t kMost = 10;

  /// @brief Whether a tet of that mean ratio has a place behind those of one subdomain that are
  /// here.
  [[nodiscard]] bool takes(double mean_ratio) const
  {
    return tets_.size() < kMost || mean_ratio < tets_.back().mean_ratio;
  }

  void add(const WorstTet& tet);
  void add(const WorstTets& other);

  /// @brief At most kMost.
  [[nodiscard]] const std::vector<WorstTet>& tets() const { return tets_; }

  void require_sound() const;  ///< @throws InputError if there are too many.

 private:
  friend struct tessera::FieldAccess;
  static auto fields(auto& self) { return std::tie(self.tets_); }

  std::vector<WorstTet> tets_{};
};

}  // namespace tessera::quality

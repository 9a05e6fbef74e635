// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

namespace tessera::mesh {

/// @brief Edge lengths wanted at some points.
struct SizePoints {
  std::vector<double> xyz{};   ///< Shape (num_points, 3).
  std::vector<double> size{};  ///< Shape (num_points); the same unit.

  static auto fields(auto& self) { return std::tie(self.xyz, self.size); }

  /// @brief The same in another unit.
  [[nodiscard]] SizePoints scaled(double factor) const
  {
    SizePoints result = *this;
    for (double& x : result.xyz) x *= factor;
    for (double& h : result.size) h *= factor;
    return result;
  }

  friend bool operator==(const SizePoints&, const SizePoints&) = default;
};

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/prism.hpp"

namespace tessera::mesh {
namespace {

double det(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(cross(a, b), c); }

}  // namespace

bool is_positive_prism(const std::array<Vec3, 3>& low, const std::array<Vec3, 3>& high)
{
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const Vec3 low_j = low[j] - low[i];
    const Vec3 low_k = low[k] - low[i];
    const Vec3 high_j = high[j] - high[i];
    const Vec3 high_k = high[k] - high[i];
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 column = high[c] - low[c];
      if (column == Vec3{}) continue;
      const bool is_good = det(low_j, low_k, column) > 0.0 && det(high_j, high_k, column) > 0.0
                           && det(low_j, high_k, column) + det(low_j, column, high_j - low_j) > 0.0
                           && det(high_j, low_k, column) - det(low_k, column, high_k - low_k) > 0.0;
      if (!is_good) return false;
    }
  }
  return true;
}

}  // namespace tessera::mesh

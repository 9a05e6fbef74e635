// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/prism.hpp"

#include <algorithm>
#include <cstddef>

namespace tessera::mesh {
namespace {

using Triangle = std::array<Vec3, 3>;

double det(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(cross(a, b), c); }

// Whether all tets are positive that can stand on a column at a corner of a triangle like `low`
// and `high`, wherever it is and however large. The volumes are linear in the column.
bool is_positive_on(const Triangle& low, const Triangle& high, const Vec3& column)
{
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const Vec3 low_j = low[j] - low[i];
    const Vec3 low_k = low[k] - low[i];
    const Vec3 high_j = high[j] - high[i];
    const Vec3 high_k = high[k] - high[i];
    const bool is_good = det(low_j, low_k, column) > 0.0 && det(high_j, high_k, column) > 0.0
                         && det(low_j, high_k, column) + det(low_j, column, high_j - low_j) > 0.0
                         && det(high_j, low_k, column) - det(low_k, column, high_k - low_k) > 0.0;
    if (!is_good) return false;
  }
  return true;
}

bool is_positive_on(const Triangle& low, const Triangle& high, const Triangle& columns)
{
  return std::ranges::all_of(columns, [&](const Vec3& column) {
    return column == Vec3{} || is_positive_on(low, high, column);
  });
}

Triangle columns_of(const Triangle& low, const Triangle& high)
{
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

// What is left of a triangle on one side of the median from corner `i`: the part with corner `j`,
// in the order of the triangle.
Triangle half(const Triangle& triangle, std::size_t i, std::size_t j)
{
  Triangle part = triangle;
  const std::size_t other = 3 - i - j;
  part[other] = midpoint(triangle[j], triangle[other]);
  return part;
}

}  // namespace

bool is_positive_prism(const Triangle& low, const Triangle& high)
{
  return is_positive_on(low, high, columns_of(low, high));
}

bool has_positive_parts(const Triangle& low, const Triangle& high)
{
  const Triangle columns = columns_of(low, high);
  if (!is_positive_on(low, high, columns)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
      if (!is_positive_on(half(low, i, j), half(high, i, j), columns)) return false;
    }
  }
  return true;
}

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace tessera {

/// @brief Point or vector in space; unit: the output length unit unless said otherwise.
using Vec3 = std::array<double, 3>;

/// @brief Stands for a point that was not given.
inline constexpr Vec3 kNoPoint{std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity()};

[[nodiscard]] constexpr Vec3 operator+(const Vec3& a, const Vec3& b) noexcept
{
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

[[nodiscard]] constexpr Vec3 operator-(const Vec3& a, const Vec3& b) noexcept
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

[[nodiscard]] constexpr Vec3 operator*(double s, const Vec3& a) noexcept
{
  return {s * a[0], s * a[1], s * a[2]};
}

[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) noexcept
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) noexcept
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline double norm(const Vec3& a) noexcept { return std::sqrt(dot(a, a)); }

/// @brief Of length 1 with this direction; zero stays zero.
[[nodiscard]] inline Vec3 unit(const Vec3& a) noexcept
{
  const double length = norm(a);
  return length > 0.0 ? (1.0 / length) * a : a;
}

/// @brief Radians, in [0, pi]; exact where arc cosines are not, near 0 and pi. Zero if a vector is.
[[nodiscard]] inline double angle_between(const Vec3& a, const Vec3& b) noexcept
{
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

[[nodiscard]] inline double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) noexcept
{
  return 0.5 * norm(cross(b - a, c - a));
}

[[nodiscard]] constexpr Vec3 midpoint(const Vec3& a, const Vec3& b) noexcept
{
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

/// @brief Signed volume of the tet (a, b, c, d); positive in VTK's vertex order.
[[nodiscard]] constexpr double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c,
                                          const Vec3& d) noexcept
{
  return dot(cross(b - a, c - a), d - a) / 6.0;
}

/// @brief Row `i` of a flat (n, 3) array. @pre 0 <= i < n.
template <class Index>
[[nodiscard]] constexpr Vec3 point_at(std::span<const double> xyz, Index i) noexcept
{
  const auto at = 3 * static_cast<std::size_t>(i);
  return {xyz[at], xyz[at + 1], xyz[at + 2]};
}

}  // namespace tessera

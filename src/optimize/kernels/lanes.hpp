// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Part of kernels/code.hpp: vectors of four doubles.

using Lanes = double __attribute__((vector_size(32)));
using LaneMask = long long __attribute__((vector_size(32)));
using LaneIds = LocalIndex __attribute__((vector_size(16)));

inline Lanes all(double value) { return Lanes{value, value, value, value}; }

inline Lanes load(const Point& p)
{
  Lanes lanes;
  __builtin_memcpy(&lanes, &p, sizeof lanes);
  return lanes;
}

inline void store(Point& p, Lanes lanes) { __builtin_memcpy(&p, &lanes, sizeof lanes); }

inline Lanes square_root(Lanes a)
{
  return Lanes{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]),
               __builtin_sqrt(a[3])};
}

inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }

inline double sum_of(Lanes a) { return (a[0] + a[1]) + (a[2] + a[3]); }

inline bool all_positive(Lanes a) { return a[0] > 0.0 && a[1] > 0.0 && a[2] > 0.0 && a[3] > 0.0; }

inline bool all_within(Lanes a, double limit)
{
  return a[0] <= limit && a[1] <= limit && a[2] <= limit && a[3] <= limit;
}

// Four vectors of space, one a lane.
struct Vectors {
  Lanes x, y, z;
};

inline Vectors operator-(const Vectors& a, const Vectors& b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline Vectors operator+(const Vectors& a, const Vectors& b)
{
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline Vectors operator*(Lanes s, const Vectors& a) { return {s * a.x, s * a.y, s * a.z}; }

inline Lanes dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Vectors cross(const Vectors& a, const Vectors& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Rows (x, y, z, unused) to columns.
inline Vectors transposed(const Lanes rows[4])
{
  const Lanes xz01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6);
  const Lanes y01 = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Lanes xz23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6);
  const Lanes y23 = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  return {__builtin_shufflevector(xz01, xz23, 0, 1, 4, 5),
          __builtin_shufflevector(y01, y23, 0, 1, 4, 5),
          __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7)};
}

constexpr double kFactor = 1.0 / 432.0;
constexpr double kHuge = 1e150;

inline Lanes energy_of(Lanes squares, Lanes w)
{
  return kFactor * (squares * squares * squares) / (w * w);
}

// Sum of the six squared edges of tets with corners 0, a, b and c.
inline Lanes sum_of_squares(const Vectors& a, const Vectors& b, const Vectors& c)
{
  const Vectors sum = a + b + c;
  return 4.0 * (dot(a, a) + dot(b, b) + dot(c, c)) - dot(sum, sum);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/expansion.hpp"

#include <cmath>
#include <cstddef>

namespace tessera::delaunay {
namespace {

// What an operation gave, and what rounding took from it: both together are exact.
struct Rounded {
  double value = 0.0;
  double error = 0.0;
};

Rounded sum(double a, double b)
{
  const double value = a + b;
  const double part_of_b = value - a;
  const double part_of_a = value - part_of_b;
  return {value, (a - part_of_a) + (b - part_of_b)};
}

// @pre |a| >= |b|, or a is zero.
Rounded sum_of_ordered(double a, double b)
{
  const double value = a + b;
  return {value, b - (value - a)};
}

// The upper 26 bits and the rest, which has 26 as well: products of such halves are exact.
Rounded halves(double a)
{
  constexpr double kSplitter = 0x1p27 + 1.0;
  const double large = kSplitter * a;
  const double upper = large - (large - a);
  return {upper, a - upper};
}

Rounded product(double a, const Rounded& halves_of_b, double b)
{
  const double value = a * b;
  const Rounded of_a = halves(a);
  const double rest = ((value - of_a.value * halves_of_b.value) - of_a.error * halves_of_b.value)
                      - of_a.value * halves_of_b.error;
  return {value, of_a.error * halves_of_b.error - rest};
}

}  // namespace

Expansion Expansion::difference(double a, double b)
{
  const Rounded result = sum(a, -b);
  Expansion expansion;
  expansion.append(result.error);
  expansion.append(result.value);
  return expansion;
}

int Expansion::sign() const
{
  if (parts_.empty()) return 0;
  return parts_.back() > 0.0 ? 1 : -1;
}

// All parts in the order of their magnitudes are added up; the errors are the result.
Expansion operator+(const Expansion& a, const Expansion& b)
{
  const std::size_t size_a = a.parts_.size();
  const std::size_t size_b = b.parts_.size();
  if (size_a == 0) return b;
  if (size_b == 0) return a;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto next = [&] {
    const bool from_a =
        j == size_b || (i < size_a && std::abs(a.parts_[i]) < std::abs(b.parts_[j]));
    return from_a ? a.parts_[i++] : b.parts_[j++];
  };
  Expansion result;
  result.parts_.reserve(size_a + size_b);
  double total = next();
  Rounded step = sum_of_ordered(next(), total);
  while (true) {
    result.append(step.error);
    total = step.value;
    if (i + j == size_a + size_b) break;
    step = sum(total, next());
  }
  result.append(total);
  return result;
}

Expansion operator-(const Expansion& a, const Expansion& b) { return a + b.negative(); }

Expansion operator*(const Expansion& a, const Expansion& b)
{
  Expansion result;
  for (const double part : b.parts_) result = result + a.scaled(part);
  return result;
}

Expansion Expansion::scaled(double factor) const
{
  const Rounded halves_of_factor = halves(factor);
  Expansion result;
  result.parts_.reserve(2 * parts_.size());
  double total = 0.0;
  for (const double part : parts_) {
    const Rounded one = product(part, halves_of_factor, factor);
    const Rounded low = sum(total, one.error);
    result.append(low.error);
    const Rounded high = sum_of_ordered(one.value, low.value);
    result.append(high.error);
    total = high.value;
  }
  result.append(total);
  return result;
}

Expansion Expansion::negative() const
{
  Expansion result = *this;
  for (double& part : result.parts_) part = -part;
  return result;
}

}  // namespace tessera::delaunay

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/delaunay/predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "delaunay/expansion.hpp"

namespace tessera::delaunay {
namespace {

// Error bounds. Let u = 2^-53 be the unit of rounding. A determinant is a sum of monomials, and
// what is computed is the same sum with each monomial times k factors 1 + d, |d| <= u, at most: one
// for every rounding that it goes through. So the error is at most ((1 + u)^k - 1) times the sum of
// the magnitudes, which is at most the number of monomials times the largest they can have.
//
// Here k counts roundings of differences, products and sums; nothing underflows: see
// kLeastCoordinate. The bounds are themselves computed with roundings, for which the constants are
// raised by more than 2 %.

// 6 monomials: 3 differences, 2 products, 1 sum in a 2x2 minor, 2 sums: k = 8; 6 * 8 u = 48 u.
constexpr double kOrientError = 50 * 0x1p-53;

// 24 monomials with a factor that is a sum of 3 squares: 3 + 2 differences, 1 square, 2 sums of
// squares, 1 product and 1 sum in a 2x2 minor, 1 product and 2 sums in a 3x3 minor, 1 product and 2
// sums of all: k = 16; 24 * 16 u = 384 u.
constexpr double kSphereError = 400 * 0x1p-53;

__extension__ using Int128 = __int128;

// A point as seen from another one. `Number`: double, which rounds; Expansion, which is exact; or
// Int128, which is as well if the offsets are small.
template <class Number>
struct Offset {
  Number x{};
  Number y{};
  Number z{};
};

Offset<double> rounded_offset(const Vec3& p, const Vec3& from)
{
  return {p[0] - from[0], p[1] - from[1], p[2] - from[2]};
}

Offset<Expansion> exact_offset(const Vec3& p, const Vec3& from)
{
  return {Expansion::difference(p[0], from[0]), Expansion::difference(p[1], from[1]),
          Expansion::difference(p[2], from[2])};
}

// Four offsets in units of some power of two, if they have no more than 24 bits. On a lattice that
// is so, and Int128 takes a tenth of the time of Expansion. Then no determinant overflows:
// 6 * 2^72 in a 3x3 minor, 3 * 2^48 in a square, 4 products: less than 2^127.
std::optional<std::array<Offset<Int128>, 4>> integer_offsets(const std::array<const Vec3*, 4>& tet,
                                                             const Vec3& from)
{
  constexpr int kBits = 24;
  std::array<double, 12> values{};
  double largest = 0.0;
  bool is_exact = true;
  for (std::size_t i = 0; i < 12; ++i) {
    const double x = (*tet[i / 3])[i % 3];
    const double y = from[i % 3];
    values[i] = x - y;
    const double part_of_y = x - values[i];
    is_exact = is_exact && part_of_y == y && values[i] + part_of_y == x;
    largest = std::max(largest, std::abs(values[i]));
  }
  if (!is_exact) return std::nullopt;
  const double scale = std::ldexp(1.0, kBits - 1 - std::ilogb(largest));
  std::array<std::int64_t, 12> whole{};
  for (std::size_t i = 0; i < 12; ++i) {
    whole[i] = static_cast<std::int64_t>(scale * values[i]);
    if (static_cast<double>(whole[i]) != scale * values[i]) return std::nullopt;
  }
  std::array<Offset<Int128>, 4> offsets{};
  for (std::size_t c = 0; c < 4; ++c) {
    offsets[c] = {whole[3 * c], whole[3 * c + 1], whole[3 * c + 2]};
  }
  return offsets;
}

template <class Number>
Number minor_xy(const Offset<Number>& a, const Offset<Number>& b)
{
  return a.x * b.y - b.x * a.y;
}

template <class Number>
Number orient_determinant(const Offset<Number>& a, const Offset<Number>& b, const Offset<Number>& c)
{
  return (a.z * minor_xy(b, c) + b.z * minor_xy(c, a)) + c.z * minor_xy(a, b);
}

template <class Number>
Number squared_length(const Offset<Number>& a)
{
  return (a.x * a.x + a.y * a.y) + a.z * a.z;
}

// Positive if the origin is inside of the sphere through a positive tet.
template <class Number>
Number sphere_determinant(const Offset<Number>& a, const Offset<Number>& b, const Offset<Number>& c,
                          const Offset<Number>& d)
{
  const Number ab = minor_xy(a, b);
  const Number bc = minor_xy(b, c);
  const Number cd = minor_xy(c, d);
  const Number da = minor_xy(d, a);
  const Number ac = minor_xy(a, c);
  const Number bd = minor_xy(b, d);
  const Number abc = (a.z * bc - b.z * ac) + c.z * ab;
  const Number bcd = (b.z * cd - c.z * bd) + d.z * bc;
  const Number cda = (c.z * da + d.z * ac) + a.z * cd;
  const Number dab = (d.z * ab + a.z * bd) + b.z * da;
  return (squared_length(c) * dab - squared_length(d) * abc)
         + (squared_length(a) * bcd - squared_length(b) * cda);
}

double largest(double a, double b, double c)
{
  return std::max(std::max(std::abs(a), std::abs(b)), std::abs(c));
}

int sign_of(double value) { return value > 0.0 ? 1 : -1; }

[[gnu::noinline]] int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return orient_determinant(exact_offset(b, a), exact_offset(c, a), exact_offset(d, a)).sign();
}

[[gnu::noinline]] int exact_insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                                     const Vec3& e)
{
  if (const auto whole = integer_offsets({&a, &b, &c, &d}, e)) {
    const Int128 determinant =
        sphere_determinant((*whole)[0], (*whole)[1], (*whole)[2], (*whole)[3]);
    return (determinant > 0 ? 1 : 0) - (determinant < 0 ? 1 : 0);
  }
  return sphere_determinant(exact_offset(a, e), exact_offset(b, e), exact_offset(c, e),
                            exact_offset(d, e))
      .sign();
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Offset<double> ab = rounded_offset(b, a);
  const Offset<double> ac = rounded_offset(c, a);
  const Offset<double> ad = rounded_offset(d, a);
  const double determinant = orient_determinant(ab, ac, ad);
  const double error = kOrientError * largest(ab.x, ac.x, ad.x) * largest(ab.y, ac.y, ad.y)
                       * largest(ab.z, ac.z, ad.z);
  if (std::abs(determinant) > error) return sign_of(determinant);
  return exact_orient3d(a, b, c, d);
}

int insphere(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e)
{
  const Offset<double> ea = rounded_offset(a, e);
  const Offset<double> eb = rounded_offset(b, e);
  const Offset<double> ec = rounded_offset(c, e);
  const Offset<double> ed = rounded_offset(d, e);
  const double determinant = sphere_determinant(ea, eb, ec, ed);
  const double x = std::max(largest(ea.x, eb.x, ec.x), std::abs(ed.x));
  const double y = std::max(largest(ea.y, eb.y, ec.y), std::abs(ed.y));
  const double z = std::max(largest(ea.z, eb.z, ec.z), std::abs(ed.z));
  const double error = kSphereError * (x * y * z) * (x * x + y * y + z * z);
  if (std::abs(determinant) > error) return sign_of(determinant);
  return exact_insphere(a, b, c, d, e);
}

int insphere_untied(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e)
{
  if (const int side = insphere(a, b, c, d, e); side != 0) return side;
  // If a corner is lifted, the sphere at e is lifted by e's barycentric coordinate of that corner.
  // So e comes to lie inside if the tet with e in the corner's place is positive.
  const std::array<const Vec3*, 4> tet{&a, &b, &c, &d};
  std::array<std::size_t, 4> corners{0, 1, 2, 3};
  std::ranges::sort(corners, [&](std::size_t i, std::size_t j) { return *tet[i] > *tet[j]; });
  for (const std::size_t corner : corners) {
    if (*tet[corner] < e) break;
    std::array<const Vec3*, 4> other = tet;
    other[corner] = &e;
    const int side = orient3d(*other[0], *other[1], *other[2], *other[3]);
    if (side != 0) return side;
  }
  return -1;  // e itself is lifted, and so comes to lie outside.
}

bool are_collinear(const Vec3& a, const Vec3& b, const Vec3& c)
{
  for (const auto& [x, y] : {std::array{0, 1}, std::array{1, 2}, std::array{2, 0}}) {
    const auto i = static_cast<std::size_t>(x);
    const auto j = static_cast<std::size_t>(y);
    const Expansion area = Expansion::difference(b[i], a[i]) * Expansion::difference(c[j], a[j])
                           - Expansion::difference(c[i], a[i]) * Expansion::difference(b[j], a[j]);
    if (area.sign() != 0) return false;
  }
  return true;
}

}  // namespace tessera::delaunay

// SPDX-License-Identifier: BSD-3-Clause
// Points, connected by Delaunay tets, or refused.
//
// The first byte says how points are read: whole numbers of a byte each, so that many lie on one
// plane or sphere, or doubles, or whole numbers with a last bit changed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/delaunay/predicates.hpp"
#include "tessera/delaunay/tetrahedralize.hpp"

#include "fuzz_target.hpp"

namespace tessera {
namespace {

// More would take long, as each is tested with each face of the hull.
constexpr std::size_t kMostPoints = 300;

std::vector<double> read_doubles(std::span<const std::uint8_t> bytes)
{
  std::vector<double> xyz(std::min(bytes.size() / sizeof(double) / 3, kMostPoints) * 3);
  if (!xyz.empty()) std::memcpy(xyz.data(), bytes.data(), xyz.size() * sizeof(double));
  return xyz;
}

std::vector<double> read_whole_numbers(std::span<const std::uint8_t> bytes, int most, bool change)
{
  std::vector<double> xyz;
  for (std::size_t i = 0; i < std::min(bytes.size() / 3, kMostPoints) * 3; ++i) {
    const double x = bytes[i] % most;
    xyz.push_back(change && bytes[i] > 200 ? std::nextafter(x, 1e9) : x);
  }
  return xyz;
}

std::vector<double> read_points(std::span<const std::uint8_t> bytes)
{
  if (bytes.empty()) return {};
  const unsigned kind = bytes[0] % 4;
  bytes = bytes.subspan(1);
  if (kind == 0) return read_doubles(bytes);
  return read_whole_numbers(bytes, kind == 1 ? 5 : 64, kind == 3);
}

void promise_delaunay(const std::vector<double>& xyz, const delaunay::Tetrahedralization& tets)
{
  const auto corner_at = [&](std::size_t i) {
    return point_at(std::span(xyz), tets.tet_vertices[i]);
  };
  for (std::size_t i = 0; i < tets.tet_vertices.size(); ++i) {
    const std::size_t first = i / 4 * 4;
    std::array<Vec3, 4> p{corner_at(first), corner_at(first + 1), corner_at(first + 2),
                          corner_at(first + 3)};
    fuzz::promise(delaunay::orient3d(p[0], p[1], p[2], p[3]) == 1);
    for (std::size_t q = 0; q < xyz.size() / 3; ++q) {
      const Vec3 point = point_at(std::span(xyz), q);
      fuzz::promise(delaunay::insphere(p[0], p[1], p[2], p[3], point) <= 0);
      if (tets.tet_neighbours[i] != kNoIndex) continue;
      p[i % 4] = point;  // The hull is convex.
      fuzz::promise(delaunay::orient3d(p[0], p[1], p[2], p[3]) >= 0);
      p[i % 4] = corner_at(i);
    }
  }
}

}  // namespace
}  // namespace tessera

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::vector<double> xyz = tessera::read_points({data, size});
  try {
    tessera::promise_delaunay(xyz, tessera::delaunay::tetrahedralize(xyz));
  } catch (const tessera::MeshError&) {
  }
  return 0;
}

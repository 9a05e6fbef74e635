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

// More would take long, as each is tested with each tet.
constexpr std::size_t kMostPoints = 80;

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

// The point is not inside of the tet's sphere, and not beyond those of its faces that are of the
// hull.
void promise_outside(const Vec3& point, std::array<Vec3, 4> tet,
                     std::span<const LocalIndex> neighbours)
{
  fuzz::promise(delaunay::insphere(tet[0], tet[1], tet[2], tet[3], point) <= 0);
  for (std::size_t c = 0; c < 4; ++c) {
    if (neighbours[c] != kNoIndex) continue;
    const Vec3 corner = tet[c];
    tet[c] = point;
    fuzz::promise(delaunay::orient3d(tet[0], tet[1], tet[2], tet[3]) >= 0);
    tet[c] = corner;
  }
}

void promise_delaunay(const std::vector<double>& xyz, const delaunay::Tetrahedralization& tets)
{
  for (std::size_t i = 0; i < tets.tet_vertices.size(); i += 4) {
    std::array<Vec3, 4> tet{};
    for (std::size_t c = 0; c < 4; ++c) {
      tet[c] = point_at(std::span(xyz), tets.tet_vertices[i + c]);
    }
    fuzz::promise(delaunay::orient3d(tet[0], tet[1], tet[2], tet[3]) == 1);
    for (std::size_t q = 0; q < xyz.size() / 3; ++q) {
      promise_outside(point_at(std::span(xyz), q), tet,
                      std::span(tets.tet_neighbours).subspan(i, 4));
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

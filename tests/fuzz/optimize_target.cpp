// SPDX-License-Identifier: BSD-3-Clause
// A cube of tets that the input bends, cuts and numbers wrongly: optimised, or refused.
//
// Bytes, in order: what to do (bits below), size of the cube, number of steps, the steps, then
// three a vertex that move it, then changes of the arrays until the input ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/optimize/optimize.hpp"

#include "fuzz_target.hpp"

namespace tessera {
namespace {

constexpr unsigned kUntangle = 1;
constexpr unsigned kNeighbours = 2;
constexpr unsigned kMoveBoundary = 4;
constexpr unsigned kFixSome = 8;

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  [[nodiscard]] bool is_at_end() const { return next_ == size_; }
  unsigned next() { return is_at_end() ? 0 : data_[next_++]; }
  double next_double()
  {
    std::array<std::uint8_t, 8> bytes;
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(next());
    double value = 0.0;
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t next_ = 0;
};

// n^3 cells of six tets around their diagonals; the vertices are moved by the bytes.
optimize::TetMesh read_cube(Bytes& bytes, int n, bool move_boundary)
{
  optimize::TetMesh mesh;
  const auto add = [&](int i, bool is_inner) {
    const double moved = (static_cast<double>(bytes.next()) - 128.0) / 128.0;
    mesh.vertex_xyz.push_back(i + (is_inner || move_boundary ? moved : 0.0));
  };
  const auto is_inside = [n](int i) { return i > 0 && i < n; };
  for (int z = 0; z <= n; ++z) {
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) {
        const bool is_inner = is_inside(x) && is_inside(y) && is_inside(z);
        for (const int i : {x, y, z}) add(i, is_inner);
      }
    }
  }
  const std::array<int, 3> strides{1, n + 1, (n + 1) * (n + 1)};
  for (int cell = 0; cell < n * n * n; ++cell) {
    const int corner =
        cell % n * strides[0] + cell / n % n * strides[1] + cell / (n * n) * strides[2];
    std::array<std::size_t, 3> axes{0, 1, 2};
    bool is_even = true;  // std::next_permutation() goes even, odd, odd, even, even, odd.
    for (int i = 0; i < 6; ++i, std::next_permutation(axes.begin(), axes.end())) {
      is_even = i == 0 || i == 3 || i == 4;
      const int a = corner + strides[axes[0]];
      const int b = a + strides[axes[1]];
      const int d = b + strides[axes[2]];
      const std::array<int, 4> tet{corner, a, is_even ? b : d, is_even ? d : b};
      mesh.tet_vertices.insert(mesh.tet_vertices.end(), tet.begin(), tet.end());
    }
  }
  return mesh;
}

void give_neighbours(optimize::TetMesh& mesh)
{
  mesh.tet_neighbours.assign(mesh.tet_vertices.size(), kNoIndex);
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
    if (triangle.tets[1] == kNoIndex) continue;
    for (const std::size_t side : {0U, 1U}) {
      mesh.tet_neighbours[at(4 * triangle.tets[side] + triangle.corners[side])] =
          4 * triangle.tets[1 - side] + triangle.corners[1 - side];
    }
  }
}

// Spoils one entry of an array.
void change(Bytes& bytes, optimize::TetMesh& mesh)
{
  const unsigned what = bytes.next();
  const std::size_t where = bytes.next() + 256 * bytes.next();
  const auto spoil = [&](std::vector<LocalIndex>& values) {
    if (!values.empty()) values[where % values.size()] = static_cast<LocalIndex>(bytes.next()) - 4;
  };
  switch (what % 5) {
    case 0:
      return spoil(mesh.tet_vertices);
    case 1:
      return spoil(mesh.tet_neighbours);
    case 2:
      mesh.vertex_xyz[where % mesh.vertex_xyz.size()] = bytes.next_double();
      return;
    case 3:
      return mesh.tet_vertices.resize(where % (mesh.tet_vertices.size() + 1));
    default:
      std::swap(mesh.tet_vertices[0], mesh.tet_vertices[where % mesh.tet_vertices.size()]);
  }
}

double mean_size(const std::vector<double>& xyz)
{
  double sum = 0.0;
  for (const double x : xyz) sum += std::abs(x);
  return sum / static_cast<double>(xyz.size() + 1);
}

struct Figures {
  double volume = 0.0;
  double least_volume = 1.0;
  std::vector<std::array<Vec3, 3>> boundary{};  // Each by ascending position; ascending.
};

Figures figures_of(const std::vector<double>& xyz, const std::vector<LocalIndex>& tet_vertices)
{
  Figures figures;
  const auto corner = [&](std::size_t i) { return point_at(std::span(xyz), tet_vertices[i]); };
  for (std::size_t i = 0; i < tet_vertices.size(); i += 4) {
    const double volume = tet_volume(corner(i), corner(i + 1), corner(i + 2), corner(i + 3));
    figures.volume += volume;
    figures.least_volume = std::min(figures.least_volume, volume);
  }
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = point_at(std::span(xyz), triangle.vertices[k]);
    }
    std::sort(corners.begin(), corners.end());
    figures.boundary.push_back(corners);
  }
  std::sort(figures.boundary.begin(), figures.boundary.end());
  return figures;
}

void promise_sound(const optimize::TetMesh& mesh, const optimize::OptimizeResult& result)
{
  const Figures before = figures_of(mesh.vertex_xyz, mesh.tet_vertices);
  const Figures after = figures_of(result.vertex_xyz, result.tet_vertices);
  fuzz::promise(before.boundary == after.boundary);
  const double size = mean_size(mesh.vertex_xyz);
  // Elsewhere volumes cannot be told in double precision.
  if (size < 1e-3 || size > 1e3) return;
  fuzz::promise(after.least_volume > 0.0);
  fuzz::promise(std::abs(after.volume - before.volume) <= 1e-9 * (1.0 + std::abs(before.volume)));
}

void run(Bytes& bytes)
{
  const unsigned flags = bytes.next();
  const int n = static_cast<int>(bytes.next() % 4) + 1;
  std::string steps;
  for (unsigned i = bytes.next() % 12; i > 0; --i) steps.push_back("mwsct"[bytes.next() % 5]);
  optimize::TetMesh mesh = read_cube(bytes, n, (flags & kMoveBoundary) != 0);
  if ((flags & kNeighbours) != 0) give_neighbours(mesh);
  if ((flags & kFixSome) != 0) {
    mesh.vertex_fixed.resize(mesh.vertex_xyz.size() / 3);
    for (std::uint8_t& is_fixed : mesh.vertex_fixed) is_fixed = bytes.next() % 2 != 0;
  }
  while (!bytes.is_at_end() && !mesh.tet_vertices.empty()) change(bytes, mesh);
  promise_sound(mesh, optimize::optimize(mesh, {.steps = optimize::parse_steps(steps)},
                                         {.untangle = (flags & kUntangle) != 0}));
}

}  // namespace
}  // namespace tessera

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  tessera::Bytes bytes(data, size);
  try {
    tessera::run(bytes);
  } catch (const tessera::MeshError&) {
  }
  return 0;
}

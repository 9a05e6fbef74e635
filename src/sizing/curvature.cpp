// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstddef>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/sorted_rows.hpp"
#include "tessera/sizing/coarse_sizes.hpp"

namespace tessera::sizing {
namespace {

constexpr double kShareOfHeights = 0.4;

// A side of a triangle of the surface.
struct Side {
  std::array<LocalIndex, 2> vertices{};  // Ascending.
  LocalIndex patch = kNoIndex;
  LocalIndex opposite = kNoIndex;  // The triangle's third vertex.

  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sorted_sides(const mesh::CoarseMesh& coarse)
{
  std::vector<Side> sides;
  sides.reserve(3 * at(coarse.num_faces()));
  for (LocalIndex f = 0; f < coarse.num_faces(); ++f) {
    if (coarse.is_wake(coarse.face_patch[at(f)])) continue;
    const LocalIndex* v = &coarse.face_vertices[3 * at(f)];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(v[(c + 1) % 3], v[(c + 2) % 3]);
      sides.push_back({{low, high}, coarse.face_patch[at(f)], v[c]});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

double curvature_across(const mesh::CoarseMesh& coarse, const Side& one, const Side& other)
{
  const Vec3 origin = coarse.position(one.vertices[0]);
  const Vec3 along = coarse.position(one.vertices[1]) - origin;
  const Vec3 normal = cross(along, coarse.position(one.opposite) - origin);
  const Vec3 beside = cross(coarse.position(other.opposite) - origin, along);
  const double angle = angle_between(normal, beside);
  return angle * norm(along) / (kShareOfHeights * (norm(normal) + norm(beside)));
}

}  // namespace

std::vector<double> lengths_in_radii(const mesh::CoarseMesh& coarse,
                                     std::span<const LocalIndex> edge_vertices)
{
  std::vector<double> curvature(edge_vertices.size() / 2, 0.0);
  const auto raise = [&](LocalIndex a, LocalIndex b, double value) {
    double& of_edge = curvature[at(mesh::find_edge_row(edge_vertices, a, b))];
    of_edge = std::max(of_edge, value);
  };
  const std::vector<Side> sides = sorted_sides(coarse);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side& one = sides[i - 1];
    const Side& other = sides[i];
    if (one.vertices != other.vertices || one.patch != other.patch) continue;
    const double value = curvature_across(coarse, one, other);
    raise(one.vertices[0], one.vertices[1], value);
    for (const LocalIndex end : one.vertices) {
      raise(end, one.opposite, value);
      raise(end, other.opposite, value);
    }
  }
  for (std::size_t e = 0; e < curvature.size(); ++e) {
    curvature[e] *=
        norm(coarse.position(edge_vertices[2 * e + 1]) - coarse.position(edge_vertices[2 * e]));
  }
  return curvature;
}

}  // namespace tessera::sizing

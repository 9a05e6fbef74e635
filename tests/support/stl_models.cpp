// SPDX-License-Identifier: BSD-3-Clause
#include "support/stl_models.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace tessera::testing {
namespace {

using Corners = std::array<Vec3, 3>;

void add(model::TriangleSoup& soup, const Corners& corners)
{
  for (const Vec3& p : corners) soup.corner_xyz.insert(soup.corner_xyz.end(), p.begin(), p.end());
  soup.triangle_solid.push_back(0);
}

std::ptrdiff_t corner_at(LocalIndex t) { return 9 * std::ptrdiff_t{t}; }

std::string text_of(const double* p)
{
  std::array<char, 100> text{};
  std::snprintf(text.data(), text.size(), "%.17g %.17g %.17g", p[0], p[1], p[2]);
  return text.data();
}

void append_little_endian(std::string& bytes, std::uint32_t value)
{
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((value >> (8 * i)) & 0xFFU));
}

Vec3 on_unit_sphere(const Vec3& p) { return (1.0 / norm(p)) * p; }

}  // namespace

model::TriangleSoup cube_soup(const Vec3& low, double side)
{
  model::TriangleSoup soup;
  soup.solid_names = {""};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 u{};
    Vec3 v{};
    Vec3 w{};
    u[(axis + 1) % 3] = side;
    v[(axis + 2) % 3] = side;
    w[axis] = side;
    add(soup, {low, low + v, low + v + u});
    add(soup, {low, low + v + u, low + u});
    add(soup, {low + w, low + w + u, low + w + u + v});
    add(soup, {low + w, low + w + u + v, low + w + v});
  }
  return soup;
}

model::TriangleSoup sphere_soup(int levels)
{
  const Vec3 x{1.0, 0.0, 0.0};
  const Vec3 y{0.0, 1.0, 0.0};
  const Vec3 z{0.0, 0.0, 1.0};
  const auto minus = [](const Vec3& p) { return -1.0 * p; };
  std::vector<Corners> triangles{{x, y, z},
                                 {y, minus(x), z},
                                 {minus(x), minus(y), z},
                                 {minus(y), x, z},
                                 {y, x, minus(z)},
                                 {minus(x), y, minus(z)},
                                 {minus(y), minus(x), minus(z)},
                                 {x, minus(y), minus(z)}};
  for (int level = 0; level < levels; ++level) {
    std::vector<Corners> finer;
    for (const auto& [a, b, c] : triangles) {
      const Vec3 ab = on_unit_sphere(midpoint(a, b));
      const Vec3 bc = on_unit_sphere(midpoint(b, c));
      const Vec3 ca = on_unit_sphere(midpoint(c, a));
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  model::TriangleSoup soup;
  soup.solid_names = {""};
  for (const Corners& corners : triangles) add(soup, corners);
  for (double& coordinate : soup.corner_xyz) coordinate += 0.0;
  return soup;
}

model::TriangleSoup joined(const model::TriangleSoup& a, const model::TriangleSoup& b)
{
  model::TriangleSoup both = a;
  both.corner_xyz.insert(both.corner_xyz.end(), b.corner_xyz.begin(), b.corner_xyz.end());
  both.solid_names.insert(both.solid_names.end(), b.solid_names.begin(), b.solid_names.end());
  for (const LocalIndex solid : b.triangle_solid) {
    both.triangle_solid.push_back(solid + static_cast<LocalIndex>(a.solid_names.size()));
  }
  return both;
}

void turn_triangle(model::TriangleSoup& soup, LocalIndex t)
{
  const auto at = soup.corner_xyz.begin() + corner_at(t);
  std::swap_ranges(at + 3, at + 6, at + 6);
}

void remove_triangle(model::TriangleSoup& soup, LocalIndex t)
{
  const auto at = soup.corner_xyz.begin() + corner_at(t);
  soup.corner_xyz.erase(at, at + 9);
  soup.triangle_solid.erase(soup.triangle_solid.begin() + t);
}

std::string ascii_stl(const model::TriangleSoup& soup)
{
  std::string text;
  for (std::size_t s = 0; s < soup.solid_names.size(); ++s) {
    text += "solid " + soup.solid_names[s] + "\n";
    for (LocalIndex t = 0; t < soup.num_triangles(); ++t) {
      if (soup.triangle_solid[static_cast<std::size_t>(t)] != static_cast<LocalIndex>(s)) continue;
      text += "facet normal 0 0 0\n outer loop\n";
      for (std::ptrdiff_t c = 0; c < 3; ++c) {
        text += "  vertex " + text_of(soup.corner_xyz.data() + corner_at(t) + 3 * c) + "\n";
      }
      text += " endloop\nendfacet\n";
    }
    text += "endsolid " + soup.solid_names[s] + "\n";
  }
  return text;
}

std::string binary_stl(const model::TriangleSoup& soup, const std::string& header)
{
  std::string bytes = header;
  bytes.resize(80, '\0');
  append_little_endian(bytes, static_cast<std::uint32_t>(soup.num_triangles()));
  for (std::size_t i = 0; i < soup.corner_xyz.size(); ++i) {
    if (i % 9 == 0) bytes.append(12, '\0');
    append_little_endian(bytes,
                         std::bit_cast<std::uint32_t>(static_cast<float>(soup.corner_xyz[i])));
    if (i % 9 == 8) bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace tessera::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/verify/seams.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

namespace tessera::verify {
namespace {

// One vertex as both sides of a seam must see it. No padding: all bytes are hashed.
struct VertexImage {
  mesh::Unit unit;
  LocalIndex index;
  double xyz[3];

  friend bool operator<(const VertexImage& a, const VertexImage& b)
  {
    return a.unit != b.unit ? a.unit < b.unit : a.index < b.index;
  }
};
static_assert(sizeof(VertexImage) == 32);

struct TriangleImage {
  std::array<VertexImage, 3> vertices;
  bool is_even = true;
};

TriangleImage image_of(const mesh::Skin& skin, LocalIndex triangle)
{
  TriangleImage image;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t v = at(skin.triangle_vertices[3 * at(triangle) + c]);
    VertexImage& vertex = image.vertices[c];
    vertex.unit = skin.vertex_unit[v];
    vertex.index = skin.vertex_index[v];
    std::memcpy(vertex.xyz, &skin.vertex_xyz[3 * v], sizeof(vertex.xyz));
  }
  const auto& [a, b, c] = image.vertices;
  image.is_even = (a < b) + (b < c) + (c < a) == 2;
  std::sort(image.vertices.begin(), image.vertices.end());
  return image;
}

}  // namespace

std::vector<SeamHash> seam_hashes(const mesh::Skin& skin, const mesh::Skeleton& skeleton)
{
  std::map<LocalIndex, Hash128> sums;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    const LocalIndex parent = skin.triangle_parent[at(t)];
    if (!skeleton.is_inside(parent)) continue;
    const TriangleImage image = image_of(skin, t);
    const Hash128 hash = hash_bytes(std::as_bytes(std::span(image.vertices)));
    if (image.is_even) {
      sums[parent] += hash;
    } else {
      sums[parent] -= hash;
    }
  }
  std::vector<SeamHash> hashes;
  for (const auto& [triangle, hash] : sums) hashes.push_back({triangle, hash});
  return hashes;
}

std::optional<std::string> first_open_seam(const std::vector<Hash128>& sums,
                                           const mesh::Skeleton& skeleton,
                                           const std::vector<char>& is_made)
{
  const auto has_piece = [&](std::size_t side) {
    return is_made.empty() || is_made[at(skeleton.triangle_subdomains[side])] != 0;
  };
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    if (!skeleton.is_inside(t) || sums[at(t)] == Hash128{}) continue;
    if (!has_piece(2 * at(t)) || !has_piece(2 * at(t) + 1)) continue;
    return "subdomains " + std::to_string(skeleton.triangle_subdomains[2 * at(t)]) + " and "
           + std::to_string(skeleton.triangle_subdomains[2 * at(t) + 1])
           + " do not meet on coarse triangle " + std::to_string(t);
  }
  return std::nullopt;
}

}  // namespace tessera::verify

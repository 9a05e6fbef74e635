// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/verify/seams.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::verify {
namespace {

// One vertex as both sides of a seam must see it. No padding: all bytes are hashed.
struct VertexImage {
  mesh::HostPoint name;
  double xyz[3];

  friend bool operator<(const VertexImage& a, const VertexImage& b) { return a.name < b.name; }
};
static_assert(sizeof(VertexImage) == 32);

// Signed: what one side adds, the other one takes away.
class SignedSum {
 public:
  void add(std::array<VertexImage, 3> triangle)
  {
    const auto& [a, b, c] = triangle;
    const bool is_even = (a < b) + (b < c) + (c < a) == 2;
    std::sort(triangle.begin(), triangle.end());
    const Hash128 hash = hash_bytes(std::as_bytes(std::span(triangle)));
    if (is_even) {
      sum_ += hash;
    } else {
      sum_ -= hash;
    }
  }

  [[nodiscard]] const Hash128& sum() const { return sum_; }

 private:
  Hash128 sum_{};
};

VertexImage image(const mesh::HostPoint& name, const double* xyz)
{
  VertexImage vertex{.name = name, .xyz = {}};
  std::memcpy(vertex.xyz, xyz, sizeof(vertex.xyz));
  return vertex;
}

std::array<VertexImage, 3> triangle_of(const mesh::Skin& skin, LocalIndex triangle)
{
  std::array<VertexImage, 3> images;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t v = at(skin.triangle_vertices[3 * at(triangle) + c]);
    images[c] = image({skin.vertex_host[v], skin.vertex_index[v]}, &skin.vertex_xyz[3 * v]);
  }
  return images;
}

}  // namespace

std::vector<SeamHash> seam_hashes(const mesh::Skin& skin, const mesh::Skeleton& skeleton)
{
  std::map<LocalIndex, SignedSum> sums;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    const LocalIndex parent = skin.triangle_parent[at(t)];
    if (skeleton.is_inside(parent)) sums[parent].add(triangle_of(skin, t));
  }
  std::vector<SeamHash> hashes;
  for (const auto& [triangle, sum] : sums) hashes.push_back({triangle, sum.sum()});
  return hashes;
}

Hash128 surface_hash(const mesh::Piece& piece)
{
  std::vector<LocalIndex> numbers(at(piece.num_vertices()));
  std::iota(numbers.begin(), numbers.end(), 0);
  return surface_hash(piece, numbers);
}

Hash128 surface_hash(const mesh::Piece& part, std::span<const LocalIndex> inner_names)
{
  std::vector<VertexImage> vertices;
  for (LocalIndex v = 0; v < part.num_vertices(); ++v) {
    const bool is_shared = v < part.num_skin_vertices();
    const mesh::HostPoint name =
        is_shared ? part.skin_point(v)
                  : mesh::HostPoint{.host = kNoIndex, .index = inner_names[at(v)]};
    vertices.push_back(image(name, &part.vertex_xyz[3 * at(v)]));
  }
  SignedSum sum;
  for (LocalIndex t = 0; t < part.num_tets(); ++t) {
    const LocalIndex* v = &part.tet_vertices[4 * at(t)];
    for (const auto& [a, b, c] : mesh::kTetFaceCorners) {
      sum.add({vertices[at(v[a])], vertices[at(v[b])], vertices[at(v[c])]});
    }
  }
  return sum.sum();
}

Hash128 surface_hash(const mesh::Skin& skin)
{
  SignedSum sum;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) sum.add(triangle_of(skin, t));
  return sum.sum();
}

Hash128 outside_hash(const mesh::Skin& skin, const mesh::Skeleton& skeleton)
{
  SignedSum sum;
  for (LocalIndex t = 0; t < skin.num_triangles(); ++t) {
    if (!skeleton.is_inside(skin.triangle_parent[at(t)])) sum.add(triangle_of(skin, t));
  }
  return sum.sum();
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
    return fmt::format("subdomains {} and {} do not meet on coarse triangle {}",
                       skeleton.triangle_subdomains[2 * at(t)],
                       skeleton.triangle_subdomains[2 * at(t) + 1], t);
  }
  return std::nullopt;
}

}  // namespace tessera::verify

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/surface_match.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {
namespace {

using Triangle = std::array<LocalIndex, 3>;

// Hash of a triangle by its ascending vertices.
std::uint64_t hash_of(const Triangle& t)
{
  const auto word = [](LocalIndex i) { return static_cast<std::uint64_t>(i); };
  std::uint64_t x = (word(t[0]) << 32 | word(t[1])) * 0x9e3779b97f4a7c15U + word(t[2]);
  x ^= x >> 30;  // From here the finaliser of splitmix64: a good bijection.
  x *= 0xbf58476d1ce4e5b9U;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

// The surface's triangles by their vertices, and the tet found behind each. Open addressing: most
// faces of tets are looked up, so it has to be quick.
class TriangleTable {
 public:
  explicit TriangleTable(std::span<const LocalIndex> triangle_vertices)
      : triangle_vertices_(triangle_vertices),
        triangle_tet_(triangle_vertices.size() / 3, kNoIndex),
        slots_(std::bit_ceil(2 * triangle_tet_.size() + 1), kNoIndex)
  {
    for (LocalIndex t = 0; t < static_cast<LocalIndex>(triangle_tet_.size()); ++t) {
      slots_[slot_of(sorted(t))] = t;
    }
  }

  // Takes the face of a tet as the surface's. False if the surface has no such triangle, if the
  // face is the wrong way round, or if another tet is behind that triangle already.
  bool take(const Triangle& face, bool is_even, LocalIndex tet)
  {
    const LocalIndex t = slots_[slot_of(face)];
    if (t == kNoIndex || triangle_tet_[at(t)] != kNoIndex) return false;
    const LocalIndex* v = &triangle_vertices_[3 * at(t)];
    if (is_even_triangle(v[0], v[1], v[2]) != is_even) return false;
    triangle_tet_[at(t)] = tet;
    return true;
  }

  [[nodiscard]] std::vector<LocalIndex> triangle_tet() && { return std::move(triangle_tet_); }

 private:
  [[nodiscard]] Triangle sorted(LocalIndex t) const
  {
    const LocalIndex* v = &triangle_vertices_[3 * at(t)];
    return sorted_triangle(v[0], v[1], v[2]);
  }

  // Where the triangle stands, or the free place where it would.
  [[nodiscard]] std::size_t slot_of(const Triangle& triangle) const
  {
    std::size_t slot = hash_of(triangle) & (slots_.size() - 1);
    while (slots_[slot] != kNoIndex && sorted(slots_[slot]) != triangle) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }

  std::span<const LocalIndex> triangle_vertices_;
  std::vector<LocalIndex> triangle_tet_;
  std::vector<LocalIndex> slots_;
};

}  // namespace

SurfaceMatch match_surface(std::span<const LocalIndex> triangle_vertices,
                           LocalIndex num_surface_vertices,
                           std::span<const LocalIndex> tet_vertices)
{
  TriangleTable table(triangle_vertices);
  std::uint64_t unmatched = 0;
  for (std::size_t t = 0; 4 * t < tet_vertices.size(); ++t) {
    const SortedTet tet = sorted_tet(tet_vertices.subspan(4 * t).first<4>());
    const auto& v = tet.vertices;
    const std::array<Triangle, 4> faces{
        {{v[1], v[2], v[3]}, {v[0], v[2], v[3]}, {v[0], v[1], v[3]}, {v[0], v[1], v[2]}}};
    // As is_even_face() says. Without a branch, as none could be foretold.
    const std::uint64_t sign = tet.is_even ? 1 : ~std::uint64_t{0};
    if (v[2] >= num_surface_vertices) {  // Most tets: no face of theirs is on the surface.
      unmatched +=
          sign * (hash_of(faces[0]) - hash_of(faces[1]) + hash_of(faces[2]) - hash_of(faces[3]));
      continue;
    }
    for (std::size_t f = 0; f < 4; ++f) {
      if (faces[f][2] < num_surface_vertices
          && table.take(faces[f], tet.is_even_face(f), static_cast<LocalIndex>(t))) {
        continue;
      }
      unmatched += f % 2 == 0 ? sign * hash_of(faces[f]) : 0 - sign * hash_of(faces[f]);
    }
  }
  return {std::move(table).triangle_tet(), unmatched == 0};
}

}  // namespace tessera::mesh

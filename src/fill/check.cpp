// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/check.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::fill {
namespace {

// Sums in the fill and of the skin differ by rounding only.
constexpr double kVolumeTolerance = 1e-9;

void require_whole_rows(const FillOutput& tets)
{
  if (tets.vertex_xyz.size() % 3 != 0 || tets.tet_vertices.size() % 4 != 0) {
    throw MeshError("the fill's arrays end in the middle of a vertex or tet");
  }
}

void require_skin_kept(const FillInput& skin, const FillOutput& tets)
{
  const std::size_t size = skin.vertex_xyz.size();
  if (tets.vertex_xyz.size() < size
      || std::memcmp(tets.vertex_xyz.data(), skin.vertex_xyz.data(), size * sizeof(double)) != 0) {
    throw MeshError("the fill moved or lost vertices of the skin");
  }
}

void require_vertices_used(const FillOutput& tets)
{
  const std::size_t num_vertices = tets.vertex_xyz.size() / 3;
  std::vector<char> used(num_vertices, 0);
  for (const LocalIndex v : tets.tet_vertices) {
    if (v < 0 || at(v) >= num_vertices) {
      throw MeshError("a tet names vertex " + std::to_string(v) + " of "
                      + std::to_string(num_vertices));
    }
    used[at(v)] = 1;
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end()) {
    throw MeshError("vertex " + std::to_string(unused - used.begin()) + " belongs to no tet");
  }
}

double volume_of(const FillOutput& tets, std::size_t t)
{
  const std::span<const double> xyz(tets.vertex_xyz);
  const LocalIndex* v = &tets.tet_vertices[4 * t];
  return tet_volume(point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]),
                    point_at(xyz, v[3]));
}

double positive_volume(const FillOutput& tets)
{
  double sum = 0.0;
  for (std::size_t t = 0; 4 * t < tets.tet_vertices.size(); ++t) {
    const double volume = volume_of(tets, t);
    if (!(volume > 0.0)) {  // Written so that a NaN counts.
      std::ostringstream text;
      text << "tet " << t << " has volume " << volume;
      throw MeshError(text.str());
    }
    sum += volume;
  }
  return sum;
}

using Triangle = std::array<LocalIndex, 3>;

// Hash of a triangle by its ascending vertices.
std::uint64_t hash_of(const Triangle& t)
{
  const auto mixed = [](std::uint64_t x) {  // The finaliser of splitmix64: a good bijection.
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9U;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  };
  const auto word = [](LocalIndex i) { return static_cast<std::uint64_t>(i); };
  return mixed(mixed(word(t[0]) << 32 | word(t[1])) + word(t[2]));
}

// The skin's triangles by their vertices, and the tet found behind each. Open addressing: most
// faces of tets are looked up, so it has to be quick.
class SkinTable {
 public:
  explicit SkinTable(const FillInput& skin)
      : skin_(skin),
        triangle_tet_(skin.triangle_vertices.size() / 3, kNoIndex),
        slots_(std::bit_ceil(2 * triangle_tet_.size() + 1), kNoIndex)
  {
    for (LocalIndex t = 0; t < static_cast<LocalIndex>(triangle_tet_.size()); ++t) {
      slots_[slot_of(sorted(t))] = t;
    }
  }

  /// Takes the face of a tet as the skin's. False if it is not in the skin, if it is the wrong way
  /// round, or if another tet is behind that triangle already.
  bool take(const Triangle& face, bool is_even, LocalIndex tet)
  {
    const LocalIndex t = slots_[slot_of(face)];
    if (t == kNoIndex || triangle_tet_[at(t)] != kNoIndex) return false;
    const LocalIndex* v = &skin_.triangle_vertices[3 * at(t)];
    if (mesh::is_even_triangle(v[0], v[1], v[2]) != is_even) return false;
    triangle_tet_[at(t)] = tet;
    return true;
  }

  [[nodiscard]] std::vector<LocalIndex> triangle_tet() && { return std::move(triangle_tet_); }

 private:
  [[nodiscard]] Triangle sorted(LocalIndex t) const
  {
    const LocalIndex* v = &skin_.triangle_vertices[3 * at(t)];
    return mesh::sorted_triangle(v[0], v[1], v[2]);
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

  const FillInput& skin_;
  std::vector<LocalIndex> triangle_tet_;
  std::vector<LocalIndex> slots_;
};

// Every face of a tet is a triangle of the skin, seen from the right side, or one of two that face
// each other: those are hashed with opposite signs and must cancel. Together with positive tets of
// the skin's volume that leaves no room for gaps or overlaps.
std::vector<LocalIndex> match_boundary(const FillInput& skin, const FillOutput& tets)
{
  SkinTable table(skin);
  const auto num_skin_vertices = static_cast<LocalIndex>(skin.vertex_xyz.size() / 3);
  std::uint64_t unmatched = 0;
  for (std::size_t t = 0; 4 * t < tets.tet_vertices.size(); ++t) {
    const LocalIndex* v = &tets.tet_vertices[4 * t];
    for (const auto& [a, b, c] : mesh::kTetFaceCorners) {
      const Triangle face = mesh::sorted_triangle(v[a], v[b], v[c]);
      const bool is_even = mesh::is_even_triangle(v[a], v[b], v[c]);
      const bool may_be_skin = face[2] < num_skin_vertices;
      if (may_be_skin && table.take(face, is_even, static_cast<LocalIndex>(t))) continue;
      unmatched += is_even ? hash_of(face) : 0 - hash_of(face);
    }
  }
  std::vector<LocalIndex> triangle_tet = std::move(table).triangle_tet();
  const auto bare = std::find(triangle_tet.begin(), triangle_tet.end(), kNoIndex);
  if (bare != triangle_tet.end()) {
    throw MeshError("the fill's boundary is not the skin: no tet is behind skin triangle "
                    + std::to_string(bare - triangle_tet.begin()));
  }
  if (unmatched != 0) {
    throw MeshError("the fill's boundary is not the skin: there are faces off it on one tet only");
  }
  return triangle_tet;
}

}  // namespace

double enclosed_volume(const FillInput& skin)
{
  const std::span<const double> xyz(skin.vertex_xyz);
  if (xyz.empty()) return 0.0;
  const Vec3 origin = point_at(xyz, 0);  // Near the body: less cancellation.
  double sum = 0.0;
  for (std::size_t t = 0; 3 * t < skin.triangle_vertices.size(); ++t) {
    const LocalIndex* v = &skin.triangle_vertices[3 * t];
    sum += tet_volume(origin, point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]));
  }
  return sum;
}

bool all_positive(const FillOutput& tets)
{
  for (std::size_t t = 0; 4 * t < tets.tet_vertices.size(); ++t) {
    if (!(volume_of(tets, t) > 0.0)) return false;
  }
  return true;
}

FillFacts check_fill(const FillInput& skin, const FillOutput& tets)
{
  require_whole_rows(tets);
  require_skin_kept(skin, tets);
  require_vertices_used(tets);
  FillFacts facts{match_boundary(skin, tets), positive_volume(tets)};
  const double enclosed = enclosed_volume(skin);
  if (!(std::abs(facts.volume - enclosed) <= kVolumeTolerance * std::abs(enclosed))) {
    std::ostringstream text;
    text.precision(12);
    text << "the tets' volume " << facts.volume << " is not the skin's volume " << enclosed;
    throw MeshError(text.str());
  }
  return facts;
}

}  // namespace tessera::fill

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>

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

double positive_volume(const FillOutput& tets)
{
  const std::span<const double> xyz(tets.vertex_xyz);
  double sum = 0.0;
  for (std::size_t t = 0; 4 * t < tets.tet_vertices.size(); ++t) {
    const LocalIndex* v = &tets.tet_vertices[4 * t];
    const double volume = tet_volume(point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]),
                                     point_at(xyz, v[3]));
    if (!(volume > 0.0)) {  // Written so that a NaN counts.
      std::ostringstream text;
      text << "tet " << t << " has volume " << volume;
      throw MeshError(text.str());
    }
    sum += volume;
  }
  return sum;
}

// A triangle by its sorted vertices, which side its normal is on, and where it comes from.
struct SidedTriangle {
  std::array<LocalIndex, 3> vertices;
  bool is_even;
  LocalIndex origin;
};

SidedTriangle sided(LocalIndex a, LocalIndex b, LocalIndex c, LocalIndex origin)
{
  return {mesh::sorted_triangle(a, b, c), mesh::is_even_triangle(a, b, c), origin};
}

bool by_vertices(const SidedTriangle& a, const SidedTriangle& b) { return a.vertices < b.vertices; }

// Outside triangles of the tets, ascending; their normals point outwards.
std::vector<SidedTriangle> outside_triangles(const std::vector<LocalIndex>& tet_vertices)
{
  std::vector<SidedTriangle> outside;
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    const LocalIndex* v = &tet_vertices[4 * at(triangle.tets[0])];
    const auto& face = mesh::kTetFaceCorners[at(triangle.corners[0])];
    outside.push_back(sided(v[face[0]], v[face[1]], v[face[2]], triangle.tets[0]));
  }
  return outside;
}

std::vector<SidedTriangle> skin_triangles(const FillInput& skin)
{
  std::vector<SidedTriangle> triangles;
  triangles.reserve(skin.triangle_vertices.size() / 3);
  for (std::size_t t = 0; 3 * t < skin.triangle_vertices.size(); ++t) {
    const LocalIndex* v = &skin.triangle_vertices[3 * t];
    triangles.push_back(sided(v[0], v[1], v[2], static_cast<LocalIndex>(t)));
  }
  std::sort(triangles.begin(), triangles.end(), by_vertices);
  return triangles;
}

std::vector<LocalIndex> match_boundary(const FillInput& skin, const FillOutput& tets)
{
  const std::vector<SidedTriangle> wanted = skin_triangles(skin);
  const std::vector<SidedTriangle> found = outside_triangles(tets.tet_vertices);
  const auto same = [](const SidedTriangle& a, const SidedTriangle& b) {
    return a.vertices == b.vertices && a.is_even == b.is_even;
  };
  const auto [w, f] = std::mismatch(wanted.begin(), wanted.end(), found.begin(), found.end(), same);
  if (w != wanted.end() || f != found.end()) {
    throw MeshError("the fill's boundary is not the skin: " + std::to_string(found.size())
                    + " outside triangles for " + std::to_string(wanted.size())
                    + (w == wanted.end()
                           ? std::string()
                           : ", first at skin triangle " + std::to_string(w->origin)));
  }
  std::vector<LocalIndex> triangle_tet(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    triangle_tet[at(wanted[i].origin)] = found[i].origin;
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

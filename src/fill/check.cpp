// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/enclosed_volume.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/surface_match.hpp"

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
      throw MeshError(fmt::format("a tet names vertex {} of {}", v, num_vertices));
    }
    used[at(v)] = 1;
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end()) {
    throw MeshError(fmt::format("vertex {} belongs to no tet", unused - used.begin()));
  }
}

double volume_of(const FillOutput& tets, std::size_t t)
{
  return tet_volume(corners_at<4>(tets.vertex_xyz, tets.tet_vertices, t));
}

double positive_volume(const FillOutput& tets)
{
  double sum = 0.0;
  for (std::size_t t = 0; 4 * t < tets.tet_vertices.size(); ++t) {
    const double volume = volume_of(tets, t);
    if (!(volume > 0.0)) {  // Written so that a NaN counts.
      throw MeshError(fmt::format("tet {} has volume {:g}", t, volume));
    }
    sum += volume;
  }
  return sum;
}

// Together with positive tets of the skin's volume a matching boundary leaves no room for gaps or
// overlaps.
std::vector<LocalIndex> match_boundary(const FillInput& skin, const FillOutput& tets)
{
  const auto num_skin_vertices = static_cast<LocalIndex>(skin.vertex_xyz.size() / 3);
  mesh::SurfaceMatch match =
      mesh::match_surface(skin.triangle_vertices, num_skin_vertices, tets.tet_vertices);
  const auto& triangle_tet = match.triangle_tet;
  const auto bare = std::find(triangle_tet.begin(), triangle_tet.end(), kNoIndex);
  if (bare != triangle_tet.end()) {
    throw MeshError(
        fmt::format("the fill's boundary is not the skin: no tet is behind skin triangle {}",
                    bare - triangle_tet.begin()));
  }
  if (!match.is_closed) {
    throw MeshError("the fill's boundary is not the skin: there are faces off it on one tet only");
  }
  return std::move(match.triangle_tet);
}

}  // namespace

double enclosed_volume(const FillInput& skin)
{
  return tessera::enclosed_volume(skin.vertex_xyz, skin.triangle_vertices);
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
    throw MeshError(fmt::format("the tets' volume {:.12g} is not the skin's volume {:.12g}",
                                facts.volume, enclosed));
  }
  return facts;
}

}  // namespace tessera::fill

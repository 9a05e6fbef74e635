// SPDX-License-Identifier: BSD-3-Clause
#include "layers/flatten_wakes.hpp"

#include <algorithm>
#include <map>

#include "tessera/base/tet.hpp"
#include "tessera/quality/tet_quality.hpp"

namespace tessera::layers {
namespace {

// A tet keeps this mean ratio, or half of its own if that is less, as where layers grow.
constexpr double kLeastRatio = 0.2;

// If a vertex cannot go all the way, it goes a quarter less each time.
constexpr int kTries = 4;

double ratio_of(const mesh::CoarseMesh& mesh, LocalIndex tet)
{
  return quality::mean_ratio(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, tet));
}

void move(LocalIndex vertex, const Vec3& to, std::span<const LocalIndex> tets,
          mesh::CoarseMesh& mesh)
{
  const Vec3 from = mesh.position(vertex);
  std::vector<double> least;
  for (const LocalIndex tet : tets) {
    least.push_back(std::min(kLeastRatio, 0.5 * ratio_of(mesh, tet)));
  }
  for (int left = kTries; left >= 0; --left) {
    const double part = static_cast<double>(left) / kTries;
    std::ranges::copy(from + part * (to - from), &mesh.vertex_xyz[3 * at(vertex)]);
    bool are_good = true;
    for (std::size_t i = 0; i < tets.size(); ++i) {
      are_good = are_good && ratio_of(mesh, tets[i]) >= least[i];
    }
    if (are_good) return;
  }
}

}  // namespace

void flatten_wakes(std::span<const RidgeVertex> wakes, const IndexLists& tets_at,
                   std::span<const char> is_on_surface, mesh::CoarseMesh& mesh)
{
  std::map<LocalIndex, std::vector<Vec3>> wanted;
  for (const RidgeVertex& one : wakes) {
    for (const LocalIndex v : one.way) {
      if (is_on_surface[at(v)] != 0) continue;
      const Vec3 here = mesh.position(v);
      const double off = dot(here - mesh.position(one.vertex), one.normal);
      wanted[v].push_back(here - off * one.normal);
    }
  }
  for (const auto& [v, places] : wanted) {
    Vec3 mean{};
    for (const Vec3& place : places) {
      mean = mean + (1.0 / static_cast<double>(places.size())) * place;
    }
    move(v, mean, tets_at[v], mesh);
  }
}

}  // namespace tessera::layers

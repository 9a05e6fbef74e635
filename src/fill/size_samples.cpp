// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/size_samples.hpp"

#include <array>
#include <cmath>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_grading.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::fill {
namespace {

// Calls visit(weights) for the barycentric middle of each upright child of an n-fold split tet.
template <class Visit>
void for_each_sample(LocalIndex n, Visit&& visit)
{
  const double width = 1.0 / n;
  for (LocalIndex k = 0; k < n; ++k) {
    for (LocalIndex j = 0; j + k < n; ++j) {
      for (LocalIndex i = 0; i + j + k < n; ++i) {
        const std::array<LocalIndex, 4> corner{n - 1 - i - j - k, i, j, k};
        std::array<double, 4> weights;
        for (std::size_t c = 0; c < 4; ++c) weights[c] = width * (corner[c] + 0.25);
        visit(weights);
      }
    }
  }
}

}  // namespace

std::vector<double> vertex_sizes(const mesh::CoarseMesh& coarse, const mesh::EdgeLevels& levels)
{
  std::vector<double> sum(at(coarse.num_vertices()), 0.0);
  std::vector<double> count(sum.size(), 0.0);
  // An edge counts once for every tet around it: the tets' sizes are what is averaged.
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    const auto tet = coarse.tet(t);
    for (const auto& [a, b] : mesh::kTetEdgeCorners) {
      const double length = std::ldexp(norm(coarse.position(tet[b]) - coarse.position(tet[a])),
                                       -levels.of(tet[a], tet[b]));
      for (const LocalIndex v : {tet[a], tet[b]}) {
        sum[at(v)] += length;
        count[at(v)] += 1.0;
      }
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (count[v] > 0.0) sum[v] /= count[v];
  }
  return sum;
}

void add_size_samples(const mesh::CoarseMesh& coarse, std::span<const LocalIndex> tets,
                      std::span<const double> vertex_size, const mesh::EdgeLevels& levels,
                      FillInput& input)
{
  for (const LocalIndex t : tets) {
    const LocalIndex n = mesh::tet_grading(coarse, levels, t).intervals();
    const auto tet = coarse.tet(t);
    for_each_sample(n, [&](const std::array<double, 4>& weights) {
      Vec3 point{};
      double size = 0.0;
      for (std::size_t c = 0; c < 4; ++c) {
        point = point + weights[c] * coarse.position(tet[c]);
        size += weights[c] * vertex_size[at(tet[c])];
      }
      input.size_xyz.insert(input.size_xyz.end(), point.begin(), point.end());
      input.size_h.push_back(size);
    });
  }
}

}  // namespace tessera::fill

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/size_samples.hpp"

#include <array>
#include <cmath>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::fill {
namespace {

// Barycentric weights of the sample points of one coarse tet: its middle, and halfway to each
// corner.
constexpr std::array<std::array<double, 4>, 5> kSampleWeights{{{0.25, 0.25, 0.25, 0.25},
                                                               {0.625, 0.125, 0.125, 0.125},
                                                               {0.125, 0.625, 0.125, 0.125},
                                                               {0.125, 0.125, 0.625, 0.125},
                                                               {0.125, 0.125, 0.125, 0.625}}};

double mean_edge_length(const std::array<Vec3, 4>& corners)
{
  double sum = 0.0;
  for (const auto& [a, b] : mesh::kTetEdgeCorners) sum += norm(corners[b] - corners[a]);
  return sum / 6.0;
}

}  // namespace

void add_size_samples(const mesh::CoarseMesh& coarse, const mesh::Decomposition& decomposition,
                      LocalIndex subdomain, int levels, FillInput& input)
{
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    if (decomposition.tet_subdomain[static_cast<std::size_t>(t)] != subdomain) continue;
    std::array<Vec3, 4> corners;
    for (std::size_t c = 0; c < 4; ++c) corners[c] = coarse.position(coarse.tet(t)[c]);
    const double size = std::ldexp(mean_edge_length(corners), -levels);
    for (const auto& weights : kSampleWeights) {
      Vec3 point{};
      for (std::size_t c = 0; c < 4; ++c) point = point + weights[c] * corners[c];
      input.size_xyz.insert(input.size_xyz.end(), point.begin(), point.end());
      input.size_h.push_back(size);
    }
  }
}

}  // namespace tessera::fill

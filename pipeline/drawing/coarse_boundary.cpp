// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/coarse_boundary.hpp"

#include <utility>

namespace tessera::pipeline {
namespace {

LocalIndex row_of_patch(LocalIndex patch, const mesh::CoarseMesh& coarse)
{
  if (patch == kNoIndex) return coarse.num_patches();  // Where the made part ends.
  return coarse.patch_row.empty() ? patch : coarse.patch_row[at(patch)];
}

}  // namespace

std::vector<CoarseTriangle> coarse_boundary(const subdomain::PartitionedMesh& cut,
                                            const std::vector<char>& is_made)
{
  const mesh::Skeleton& skeleton = cut.skeleton;
  const auto is_there = [&](LocalIndex s) { return s != kNoIndex && is_made[at(s)] != 0; };
  std::vector<CoarseTriangle> triangles;
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const LocalIndex* const sides = &skeleton.triangle_subdomains[2 * at(t)];
    if (cut.coarse.is_wake(skeleton.triangle_patch[at(t)])) continue;
    const bool is_between = is_there(sides[0]) && is_there(sides[1]);
    if (is_between ? skeleton.triangle_patch[at(t)] == kNoIndex
                   : !is_there(sides[0]) && !is_there(sides[1])) {
      continue;
    }
    CoarseTriangle triangle{.subdomain = is_there(sides[0]) ? sides[0] : sides[1],
                            .patch = row_of_patch(skeleton.triangle_patch[at(t)], cut.coarse),
                            .is_between = is_between};
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = skeleton.triangle_vertices[3 * at(t) + c];
      triangle.vertices[c] = skeleton.vertex_coarse[at(v)];
    }
    if (!is_there(sides[0])) std::swap(triangle.vertices[1], triangle.vertices[2]);
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace tessera::pipeline

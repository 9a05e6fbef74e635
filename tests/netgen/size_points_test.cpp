// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/coarse/sharp_tets.hpp"
#include "tessera/mesh/tet_edges.hpp"

#include "support/temporary_file.hpp"

#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

using testing::load_own;
using testing::own_model;

struct NearAndFar {
  double shortest_near = std::numeric_limits<double>::infinity();
  double longest_near = 0.0;
  double longest = 0.0;
};

// Edges whose middle is within `reach` of a point, and all.
NearAndFar edges_around(const Vec3& point, double reach, const mesh::CoarseMesh& mesh)
{
  NearAndFar found;
  mesh::for_each_edge(mesh.tet_vertices, mesh.num_vertices(), [&](LocalIndex a, LocalIndex b) {
    const double length = norm(mesh.position(b) - mesh.position(a));
    found.longest = std::max(found.longest, length);
    if (norm(0.5 * (mesh.position(a) + mesh.position(b)) - point) > reach) return;
    found.longest_near = std::max(found.longest_near, length);
    found.shortest_near = std::min(found.shortest_near, length);
  });
  return found;
}

Vec3 middle_of_box(const mesh::CoarseMesh& mesh)
{
  Vec3 low = mesh.position(0);
  Vec3 high = low;
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], mesh.position(v)[i]);
      high[i] = std::max(high[i], mesh.position(v)[i]);
    }
  }
  return 0.5 * (low + high);
}

// The vertex that is farthest from the middle of the model's box.
Vec3 outermost_vertex(const mesh::CoarseMesh& mesh)
{
  const Vec3 middle = middle_of_box(mesh);
  Vec3 outermost = mesh.position(0);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (norm(mesh.position(v) - middle) > norm(outermost - middle)) outermost = mesh.position(v);
  }
  return outermost;
}

class SizePoints : public ::testing::TestWithParam<std::string> {};

TEST_P(SizePoints, AreFollowedAtASurfaceAndElsewhereSizesStay)
{
  const auto model = load_own(GetParam());
  const auto mesher = netgen::make_coarse_mesher(*model);
  surface::CoarseOptions options;
  options.max_size = 1e6;
  const mesh::CoarseMesh coarsest = mesher->generate(options);
  const Vec3 place = outermost_vertex(coarsest);
  options.max_size = edges_around(place, 0.0, coarsest).longest;
  const mesh::CoarseMesh without = mesher->generate(options);

  const double wanted = options.max_size / 40.0;
  options.points.xyz.assign(place.begin(), place.end());
  options.points.size = {wanted};
  const mesh::CoarseMesh with = mesher->generate(options);

  const double reach = 2.0 * wanted;
  EXPECT_GT(edges_around(place, options.max_size, without).shortest_near, 2.0 * wanted);
  EXPECT_LT(edges_around(place, reach, with).longest_near, 4.0 * wanted);
  EXPECT_LT(edges_around(place, reach, with).shortest_near, 2.0 * wanted);
  EXPECT_GT(edges_around(place, reach, with).longest, 10.0 * wanted);
}

INSTANTIATE_TEST_SUITE_P(OfEveryKernel, SizePoints,
                         ::testing::Values("brick.geo", "shaft.geo", "bracket.step",
                                           "cylinder.step", "bracket.stl", "plate_with_hole.stl"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace tessera

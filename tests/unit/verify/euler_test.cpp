// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/verify/euler.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "support/curved_meshes.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::verify {
namespace {

std::vector<LocalIndex> one_part(const mesh::CoarseMesh& mesh)
{
  return std::vector<LocalIndex>(static_cast<std::size_t>(mesh.num_tets()), 0);
}

// The tets of kuhn_cube(n) whose middle, in cells, `keep` says yes to.
template <class Keep>
std::vector<LocalIndex> cells_of_cube(int n, const Keep& keep)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(n);
  std::vector<LocalIndex> kept;
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    Vec3 middle{};
    for (const LocalIndex v : cube.tet(t)) middle = middle + 0.25 * cube.position(v);
    std::array<int, 3> cell;
    for (std::size_t d = 0; d < 3; ++d) cell[d] = static_cast<int>(n * middle[d]);
    const auto tet = cube.tet(t);
    if (keep(cell)) kept.insert(kept.end(), tet.begin(), tet.end());
  }
  return kept;
}

std::vector<GlobalIndex> euler_of(const FlatArray<LocalIndex>& tets)
{
  return euler_characteristics(tets, std::vector<LocalIndex>(tets.size() / 4, 0));
}

TEST(EulerCharacteristic, OfABallIsOne)
{
  EXPECT_EQ(euler_of({0, 1, 2, 3}), std::vector<GlobalIndex>{1});
  for (const int n : {1, 2, 4}) {
    const mesh::CoarseMesh ball = testing::ball(n);
    EXPECT_EQ(euler_characteristics(ball.tet_vertices, one_part(ball)),
              std::vector<GlobalIndex>{1});
  }
}

TEST(EulerCharacteristic, OfAShellIsTwo)
{
  const mesh::CoarseMesh shell = testing::shell();
  EXPECT_EQ(euler_characteristics(shell.tet_vertices, one_part(shell)),
            std::vector<GlobalIndex>{2});
}

TEST(EulerCharacteristic, FallsByOneWithEveryHole)
{
  const auto torus = cells_of_cube(3, [](const auto& c) { return !(c[0] == 1 && c[1] == 1); });
  EXPECT_EQ(euler_of(torus), std::vector<GlobalIndex>{0});
  const auto eight = cells_of_cube(5, [](const auto& c) { return !(c[0] % 2 == 1 && c[1] == 2); });
  EXPECT_EQ(euler_of(eight), std::vector<GlobalIndex>{-1});
}

TEST(EulerCharacteristic, AddsSeparateBodies)
{
  const auto two = cells_of_cube(3, [](const auto& c) { return c[0] != 1; });
  EXPECT_EQ(euler_of(two), std::vector<GlobalIndex>{2});
}

TEST(EulerCharacteristic, CountsSharedEntitiesInEveryPart)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(4);
  const auto parts = testing::slabs(cube, 4).tet_subdomain;
  EXPECT_EQ(euler_characteristics(cube.tet_vertices, parts), (std::vector<GlobalIndex>(4, 1)));
}

TEST(EulerCharacteristic, SeesATetThatIsMissingInside)
{
  const FlatArray<LocalIndex> tets = testing::kuhn_cube(4).tet_vertices;
  const auto cavity = cells_of_cube(4, [](const auto& c) {
    return !(c == std::array<int, 3>{1, 1, 1});
  });
  EXPECT_EQ(euler_of(tets), std::vector<GlobalIndex>{1});
  EXPECT_EQ(euler_of(cavity), std::vector<GlobalIndex>{2});
}

TEST(EulerCharacteristic, OfNothingIsNothing) { EXPECT_TRUE(euler_of({}).empty()); }

}  // namespace
}  // namespace tessera::verify

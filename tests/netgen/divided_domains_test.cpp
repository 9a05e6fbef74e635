// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/netgen/factory.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "support/surfaces.hpp"
#include "support/temporary_file.hpp"

namespace tessera {
namespace {

// A bar of two materials with a hole along it: planes across it meet an outline and a hole.
constexpr const char* kBar =
    "algebraic3d\nsolid bar = orthobrick (0, 0, 0; 8, 1, 1);\n"
    "solid hole = cylinder (0, 0.5, 0.5; 8, 0.5, 0.5; 0.25);\n"
    "solid half = plane (4, 0, 0; 1, 0, 0);\n"
    "solid left = bar and not hole and half;\nsolid right = bar and not hole and not half;\n"
    "tlo left;\ntlo right;\n";
constexpr double kSize = 0.12;

struct Bar {
  Bar()
  {
    const testing::TemporaryFile file("bar.geo", kBar);
    model = netgen::load_model(netgen::import_model(file.path(), {}));
    mesher = netgen::make_coarse_mesher(*model);
    options.max_size = kSize;
    surface = mesher->mesh_surface(options, {});
  }

  [[nodiscard]] coarse::DividedSurface divide(double tets_per_piece) const
  {
    const auto membrane = [&](const coarse::DomainSkin& skin,
                              const coarse::MembraneBorder& border) {
      return mesher->mesh_membrane(skin, border, options);
    };
    return coarse::divide_domains(surface, membrane, tets_per_piece);
  }

  std::unique_ptr<model::Model> model{};
  std::unique_ptr<coarse::CoarseMesher> mesher{};
  coarse::CoarseOptions options{};
  coarse::CoarseSurface surface{};
};

TEST(DividedDomains, PiecesOfEachDomainFillIt)
{
  const Bar bar;
  const coarse::DividedSurface divided = bar.divide(2500.0);
  ASSERT_EQ(divided.num_pieces.size(), 2U);
  LocalIndex piece = 0;
  for (LocalIndex d = 1; d <= 2; ++d) {
    EXPECT_GE(divided.num_pieces[at(d - 1)], 3) << d;
    const coarse::DomainSkin whole = coarse::skin_of(bar.surface, d);
    double volume = 0.0;
    for (LocalIndex p = 0; p < divided.num_pieces[at(d - 1)]; ++p) {
      const coarse::DomainSkin skin = coarse::skin_of(divided.surface, ++piece);
      EXPECT_EQ(testing::topology_of(skin.triangle_vertices).num_unmatched_edges, 0);
      volume += testing::volume_inside(skin.vertex_xyz, skin.triangle_vertices);
    }
    EXPECT_NEAR(volume, testing::volume_inside(whole.vertex_xyz, whole.triangle_vertices), 1e-9);
  }
}

// Triangles of membranes are as large as those of the surface where the size is the same.
TEST(DividedDomains, MembranesHaveTheSizeThatIsWanted)
{
  const Bar bar;
  const coarse::DividedSurface divided = bar.divide(2500.0);
  const mesh::CoarseMesh& mesh = divided.surface.mesh;
  double shortest = 1.0;
  double longest = 0.0;
  LocalIndex num_edges = 0;
  for (LocalIndex f = bar.surface.mesh.num_faces(); f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    for (std::size_t c = 0; c < 3; ++c) {
      const double edge = norm(mesh.position(v[(c + 1) % 3]) - mesh.position(v[c]));
      shortest = std::min(shortest, edge);
      longest = std::max(longest, edge);
      ++num_edges;
    }
  }
  EXPECT_GT(num_edges, 300);
  EXPECT_GT(shortest, 0.3 * kSize);
  EXPECT_LT(longest, 2.5 * kSize);
}

std::vector<double> mean_ratios(const std::vector<double>& xyz, const std::vector<LocalIndex>& tets)
{
  std::vector<double> ratios;
  for (std::size_t c = 0; c < tets.size(); c += 4) {
    const auto corner = [&](std::size_t k) { return point_at(std::span(xyz), tets[c + k]); };
    ratios.push_back(quality::mean_ratio({corner(0), corner(1), corner(2), corner(3)}));
  }
  std::ranges::sort(ratios);
  return ratios;
}

TEST(DividedDomains, TetsAreAsGoodAsThoseOfADomainInOnePiece)
{
  const Bar bar;
  const coarse::DividedSurface divided = bar.divide(7000.0);
  ASSERT_EQ(divided.num_pieces.front(), 2);
  std::vector<coarse::DomainTets> pieces;
  for (LocalIndex p = 1; p <= divided.surface.num_domains(); ++p) {
    pieces.push_back(bar.mesher->fill_domain(skin_of_piece(divided, p), bar.options));
  }
  const auto joined = bar.mesher->join_domains(bar.surface, divided, pieces);
  ASSERT_EQ(joined.size(), 2U);
  const auto whole = bar.mesher->mesh_domain(coarse::skin_of(bar.surface, 1), bar.options);
  const auto of_pieces = mean_ratios(joined[0].vertex_xyz, joined[0].tet_vertices);
  const auto of_whole = mean_ratios(whole.vertex_xyz, whole.tet_vertices);
  EXPECT_NEAR(static_cast<double>(of_pieces.size()), static_cast<double>(of_whole.size()),
              0.1 * static_cast<double>(of_whole.size()));
  EXPECT_GT(of_pieces[of_pieces.size() / 2], of_whole[of_whole.size() / 2] - 0.01);
  EXPECT_GT(of_pieces[of_pieces.size() / 100], of_whole[of_whole.size() / 100] - 0.03);
  EXPECT_GT(of_pieces.front(), 0.7 * of_whole.front());
  EXPECT_EQ(coarse::fill_surface(bar.surface, joined).mesh.num_faces(),
            bar.surface.mesh.num_faces());
}

}  // namespace
}  // namespace tessera

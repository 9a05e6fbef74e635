// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/enclosed_volume.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "support/meshes.hpp"
#include "support/surfaces.hpp"
#include "support/temporary_file.hpp"

#include "skins.hpp"

namespace tessera {
namespace {

constexpr const char* kBall = "algebraic3d\nsolid ball = sphere (1, 2, 3; 2);\ntlo ball;\n";
constexpr const char* kNotched =
    "algebraic3d\nsolid block = orthobrick (0, 0, 0; 3, 2, 2);\n"
    "solid notch = orthobrick (1, 1, -1; 2, 3, 3);\n"
    "solid part = block and not notch;\ntlo part;\n";

// Loaded, with the mesher that refers to it.
struct Loaded {
  std::unique_ptr<model::Model> model{};
  std::unique_ptr<coarse::CoarseMesher> mesher{};

  explicit Loaded(const std::string& text)
  {
    const testing::TemporaryFile file("model.geo", text);
    model = netgen::load_model(netgen::import_model(file.path(), {}));
    mesher = netgen::make_coarse_mesher(*model);
  }
};

surface::CoarseOptions options_of(double max_size)
{
  surface::CoarseOptions options;
  options.max_size = max_size;
  return options;
}

struct Measures {
  double volume = 0.0;
  double mean_ratio = 0.0;
  double worst = 1.0;
};

Measures measures_of(const surface::DomainTets& tets)
{
  Measures measures;
  const auto num_tets = static_cast<double>(tets.tet_vertices.size() / 4);
  for (std::size_t i = 0; i < tets.tet_vertices.size(); i += 4) {
    std::array<Vec3, 4> p{};
    for (std::size_t c = 0; c < 4; ++c) {
      p[c] = point_at(std::span(tets.vertex_xyz), tets.tet_vertices[i + c]);
    }
    const double ratio = quality::mean_ratio(p);
    measures.volume += tet_volume(p[0], p[1], p[2], p[3]);
    measures.mean_ratio += ratio / num_tets;
    measures.worst = std::min(measures.worst, ratio);
  }
  return measures;
}

class LatticeDomain : public ::testing::TestWithParam<const char*> {};

TEST_P(LatticeDomain, IsFilledWithGoodTets)
{
  const Loaded loaded(GetParam());
  const surface::CoarseOptions options = options_of(0.3);
  const surface::CoarseSurface surface = loaded.mesher->mesh_surface(options, {});
  ASSERT_EQ(surface.num_domains(), 1);
  const surface::DomainSkin skin = surface::skin_of(surface, 1);
  EXPECT_EQ(testing::topology_of(skin.triangle_vertices).num_unmatched_edges, 0);
  static_cast<void>(take_noted_repairs());
  const surface::DomainTets tets = loaded.mesher->mesh_domain(skin, options);
  EXPECT_EQ(take_noted_repairs()[Repair::netgen_tets], 0);
  const Measures measures = measures_of(tets);
  EXPECT_GT(measures.mean_ratio, 0.85);
  EXPECT_GT(measures.worst, 0.0);
  const double volume = enclosed_volume(skin.vertex_xyz, skin.triangle_vertices);
  EXPECT_NEAR(measures.volume, volume, 1e-9 * volume);
  EXPECT_NO_THROW(mesh::validate(surface::fill_surface(surface, {tets}).mesh));
}

INSTANTIATE_TEST_SUITE_P(Models, LatticeDomain, ::testing::Values(kBall, kNotched),
                         [](const auto& of) {
                           return std::string(of.index == 0 ? "Ball" : "NotchedBlock");
                         });

void append(surface::DomainSkin& skin, const fill::FillInput& other, const Vec3& offset)
{
  const auto first = static_cast<LocalIndex>(skin.vertex_xyz.size() / 3);
  for (std::size_t v = 0; v < other.vertex_xyz.size() / 3; ++v) {
    const Vec3 p = point_at(std::span(other.vertex_xyz), v) + offset;
    skin.vertex_xyz.insert(skin.vertex_xyz.end(), p.begin(), p.end());
  }
  for (const LocalIndex v : other.triangle_vertices) skin.triangle_vertices.push_back(first + v);
}

// Two cubes with one corner at the same place: only one of its vertices is of Delaunay tets.
surface::DomainSkin touching_cubes()
{
  const fill::FillInput cube = testing::cube_skin(3);
  surface::DomainSkin skin;
  append(skin, cube, {0, 0, 0});
  append(skin, cube, {1, 1, 1});
  skin.vertex.resize(skin.vertex_xyz.size() / 3);
  std::iota(skin.vertex.begin(), skin.vertex.end(), 0);
  skin.triangle_patch.assign(skin.triangle_vertices.size() / 3, 0);
  skin.max_size = 0.5;
  skin.model_box = {Vec3{0, 0, 0}, Vec3{2, 2, 2}};
  return skin;
}

// NETGEN, but for holes.
class GivesUpOnHoles : public coarse::CoarseMesher {
 public:
  explicit GivesUpOnHoles(const coarse::CoarseMesher& mesher) : mesher_(mesher) {}

  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const cut::CutTree& planes) const override
  {
    return mesher_.mesh_surface(options, planes);
  }
  [[nodiscard]] surface::DomainTets fill_domain(
      const surface::DomainSkin& skin, const surface::CoarseOptions& options) const override
  {
    if (skin.is_hole) throw NetgenError("a hole");
    return mesher_.fill_domain(skin, options);
  }

 private:
  const coarse::CoarseMesher& mesher_;
};

void expect_two_cubes(const surface::DomainTets& tets)
{
  const Measures measures = measures_of(tets);
  EXPECT_NEAR(measures.volume, 2.0, 1e-9);
  EXPECT_GT(measures.worst, 0.0);
}

TEST(LatticeDomains, NetgenFillsTheHoleWhereASkinTouchesItself)
{
  const Loaded loaded(kBall);
  static_cast<void>(take_noted_repairs());
  expect_two_cubes(loaded.mesher->mesh_domain(touching_cubes(), options_of(0.5)));
  const RepairCounts repairs = take_noted_repairs();
  EXPECT_EQ(repairs[Repair::netgen_tets], 0);
  EXPECT_EQ(repairs[Repair::lattice_holes], 1);
}

TEST(LatticeDomains, NetgenFillsADomainWhoseHolesCannotBeFilled)
{
  const Loaded loaded(kBall);
  static_cast<void>(take_noted_repairs());
  const GivesUpOnHoles mesher(*loaded.mesher);
  expect_two_cubes(mesher.mesh_domain(touching_cubes(), options_of(0.5)));
  const RepairCounts repairs = take_noted_repairs();
  EXPECT_EQ(repairs[Repair::netgen_tets], 1);
  EXPECT_EQ(repairs[Repair::lattice_holes], 0);
}

}  // namespace
}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
// What the rules promise.
#include "tessera/cut/choose_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "sample_models.hpp"

namespace tessera::cut {
namespace {

CutChoice choose_checked(const model::ModelDescription& model, const CutOptions& options)
{
  CutChoice choice = choose_planes(model, options);
  EXPECT_NO_THROW(choice.tree.require_sound());
  EXPECT_EQ(choice.tree.num_parts, static_cast<LocalIndex>(choice.report.parts.size()));
  EXPECT_EQ(choice.tree.solid_root.size(), model.solids.size());
  std::vector<double> volume(model.solids.size(), 0.0);
  LocalIndex num_missing = 0;
  for (const CutPart& part : choice.report.parts) {
    EXPECT_GT(part.volume, 0.0);
    EXPECT_EQ(part.whole_because.empty(), part.num_wanted == 1);
    volume[at(part.solid)] += part.volume;
    num_missing += part.num_wanted - 1;
  }
  for (std::size_t s = 0; s < volume.size(); ++s) {
    EXPECT_NEAR(volume[s], model.solids[s].volume, 1e-9 * model.solids[s].volume);
  }
  EXPECT_EQ(choice.tree.num_parts + num_missing,
            std::max(options.parts, static_cast<LocalIndex>(model.solids.size())));
  return choice;
}

std::vector<model::ModelDescription> samples()
{
  return {testing::box(3, 2, 1),         testing::l_shape(),
          testing::cylinder(1, 2, 24),   testing::torus(2.0, 0.7, 16),
          testing::plate(3, 2, {}, 0.5), testing::two_cubes()};
}

double smallest_clearance(const CutReport& report)
{
  double clearance = std::numeric_limits<double>::infinity();
  for (const PlaneJudgement& plane : report.planes) {
    clearance = std::min(clearance, plane.clearance);
  }
  return clearance;
}

// The same solid, its triangles and points in another order.
model::ModelDescription shuffled(const model::ModelDescription& model)
{
  model::ModelDescription result = model;
  std::mt19937 generator(7);
  std::vector<std::size_t> triangles(model.triangle_face.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  std::ranges::shuffle(triangles, generator);
  std::vector<LocalIndex> places(model.vertex_xyz.size() / 3);
  std::iota(places.begin(), places.end(), 0);
  std::ranges::shuffle(places, generator);
  for (std::size_t v = 0; v < places.size(); ++v) {
    std::copy_n(&model.vertex_xyz[3 * v], 3, &result.vertex_xyz[3 * at(places[v])]);
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    result.triangle_face[i] = model.triangle_face[triangles[i]];
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = model.triangle_vertices[3 * triangles[i] + (c + i) % 3];
      result.triangle_vertices[3 * i + c] = places[at(v)];
    }
  }
  return result;
}

TEST(ChoosePlanes, GivesAnyNumberOfParts)
{
  for (const model::ModelDescription& model : samples()) {
    for (const auto& [rule, word] : kEnumWords<PlaneRule>) {
      for (LocalIndex parts = 1; parts <= 33; ++parts) {
        SCOPED_TRACE(::testing::Message() << model.triangle_face.size() << " triangles, " << word
                                          << ", " << parts << " parts");
        const CutChoice choice =
            choose_checked(model, {.rule = rule, .parts = parts, .coarse_size = 0.1});
        EXPECT_GE(choice.tree.num_parts, parts);
      }
    }
  }
}

TEST(ChoosePlanes, PartsAreOfSimilarVolume)
{
  for (const model::ModelDescription& model : samples()) {
    for (const LocalIndex parts : {2, 3, 5, 8, 13, 32}) {
      const CutChoice clear = choose_checked(model, {.parts = parts, .coarse_size = 0.1});
      EXPECT_LT(clear.report.balance, 2.0) << parts << " parts";
      const CutChoice pca =
          choose_checked(model, {.rule = PlaneRule::pca, .parts = parts, .coarse_size = 0.1});
      EXPECT_LT(pca.report.balance, 1.6) << parts << " parts";
    }
  }
}

TEST(ChoosePlanes, PartsHaveTheVolumeOfTheirPoints)
{
  const model::ModelDescription model = testing::box(3, 2, 1);
  const CutChoice choice = choose_checked(model, {.parts = 7, .coarse_size = 0.2});
  // Points that fill the box evenly, in no layers.
  constexpr int kNumPoints = 1'000'000;
  constexpr Vec3 kSteps{0.8191725134, 0.6710436067, 0.5497004779};
  const Vec3 size{3.0, 2.0, 1.0};
  std::vector<double> volume(at(choice.tree.num_parts), 0.0);
  for (int i = 0; i < kNumPoints; ++i) {
    Vec3 p{};
    for (std::size_t d = 0; d < 3; ++d) {
      p[d] = size[d] * (i * kSteps[d] - std::floor(i * kSteps[d]));
    }
    volume[at(choice.tree.part_of(0, p))] += 6.0 / kNumPoints;
  }
  for (std::size_t p = 0; p < volume.size(); ++p) {
    EXPECT_NEAR(volume[p], choice.report.parts[p].volume, 0.005);
  }
}

TEST(ChoosePlanes, PcaHalvesABoxAcrossItsLength)
{
  const CutChoice choice = choose_checked(testing::box(1, 5, 2),
                                          {.rule = PlaneRule::pca, .parts = 2, .coarse_size = 0.3});
  const Plane& plane = choice.tree.nodes.front().plane;
  EXPECT_LT(norm(plane.normal - Vec3{0, 1, 0}), 1e-9);
  EXPECT_NEAR(plane.offset, 2.5, 1e-9);
  EXPECT_NEAR(choice.report.balance, 1.0, 1e-9);
  EXPECT_NEAR(choice.report.planes.front().area, 2.0, 1e-9);
  EXPECT_NEAR(choice.report.planes.front().angle_deg, 90.0, 1e-6);
}

TEST(ChoosePlanes, TheOrderOfTrianglesChangesNoBit)
{
  for (const model::ModelDescription& model : samples()) {
    const model::ModelDescription other = shuffled(model);
    for (const auto& [rule, word] : kEnumWords<PlaneRule>) {
      const CutOptions options{.rule = rule, .parts = 6, .coarse_size = 0.2};
      EXPECT_EQ(choose_checked(model, options).tree, choose_checked(other, options).tree) << word;
    }
  }
}

// The plane through the centre of mass leaves a slice of 0.01 beside the hole, or cuts off one.
TEST(ChoosePlanes, ClearKeepsAwayFromAHoleThatPcaGrazes)
{
  constexpr double kRadius = 0.3;
  for (const double beside : {0.01, -0.01}) {
    const testing::Cell cell{
        .side_x = 4.0, .side_y = 1.0, .hole = {2.0 + kRadius + beside, 0.5}, .radius = kRadius};
    const model::ModelDescription bar = testing::plate(1, 1, cell, 1.0);
    const auto distance_from_touching = [&](const CutChoice& choice) {
      const Plane& plane = choice.tree.nodes.front().plane;
      const double height = std::abs(plane.height({cell.hole[0], cell.hole[1], 0.5}));
      const double radius = kRadius * std::hypot(plane.normal[0], plane.normal[1]);
      return std::abs(height - radius);
    };
    const CutOptions options{.parts = 2, .coarse_size = 0.2};
    CutOptions thesis = options;
    thesis.rule = PlaneRule::pca;
    const CutChoice pca = choose_checked(bar, thesis);
    EXPECT_LT(distance_from_touching(pca), 0.05);
    EXPECT_LT(pca.report.planes.front().clearance, 0.25);
    const CutChoice clear = choose_checked(bar, options);
    ASSERT_EQ(clear.tree.num_parts, 2);
    EXPECT_GT(distance_from_touching(clear), 0.15);
    EXPECT_GT(clear.report.planes.front().clearance, 0.75);
    EXPECT_LT(clear.report.balance, 1.2);
  }
}

TEST(ChoosePlanes, ClearCutsARingAcross)
{
  const CutChoice choice =
      choose_checked(testing::torus(2.0, 0.5, 24), {.parts = 4, .coarse_size = 0.3});
  EXPECT_EQ(choice.tree.num_parts, 4);
  for (const PlaneJudgement& plane : choice.report.planes) {
    EXPECT_GT(plane.angle_deg, 60.0);
    EXPECT_GT(plane.clearance, 0.9);
    EXPECT_LT(plane.area, 2.0);
  }
}

TEST(ChoosePlanes, ClearPassesBetweenHoles)
{
  const CutChoice choice =
      choose_checked(testing::plate(4, 4, {.radius = 0.3}, 0.3), {.parts = 4, .coarse_size = 0.2});
  EXPECT_EQ(choice.tree.num_parts, 4);
  EXPECT_GT(smallest_clearance(choice.report), 0.9);
  EXPECT_LT(choice.report.balance, 1.1);
}

TEST(ChoosePlanes, ClearLeavesWholeWhatIsSmallerThanTheCoarseSize)
{
  const CutChoice choice = choose_checked(testing::box(1, 1, 1), {.parts = 64, .coarse_size = 4.0});
  EXPECT_LT(choice.tree.num_parts, 64);
  EXPECT_EQ(choice.report.num_wanted, 64);
  const auto& parts = choice.report.parts;
  EXPECT_TRUE(
      std::ranges::any_of(parts, [](const CutPart& p) { return !p.whole_because.empty(); }));
}

TEST(ChoosePlanes, SolidsGetPartsByVolume)
{
  const CutChoice choice = choose_checked(testing::two_cubes(),
                                          {.rule = PlaneRule::pca, .parts = 7, .coarse_size = 0.2});
  const std::vector<LocalIndex> solids = choice.tree.part_solid();
  EXPECT_EQ(std::ranges::count(solids, 0), 4);
  EXPECT_EQ(std::ranges::count(solids, 1), 3);
  EXPECT_TRUE(std::ranges::is_sorted(solids));
}

TEST(ChoosePlanes, ASolidWhoseTrianglesDoNotCloseStaysWhole)
{
  model::ModelDescription model = testing::box(1, 1, 1);
  model.triangle_face.resize(10);
  model.triangle_vertices.resize(30);
  const CutChoice choice = choose_planes(model, {.parts = 4, .coarse_size = 0.2});
  EXPECT_EQ(choice.tree.num_parts, 1);
  EXPECT_EQ(choice.report.parts.front().whole_because, "its triangles do not close");
}

TEST(ChoosePlanes, ASolidWithoutTrianglesStaysWhole)
{
  model::ModelDescription model = testing::box(1, 1, 1);
  model.solids.push_back({.name = "ghost", .volume = 1.0});
  const CutChoice choice = choose_planes(model, {.parts = 4, .coarse_size = 0.1});
  EXPECT_EQ(choice.tree.part_solid().back(), 1);
  EXPECT_EQ(choice.tree.num_parts, 4);
}

TEST(ChoosePlanes, RefusesWrongOptionsAndDamagedModels)
{
  const model::ModelDescription model = testing::box(1, 1, 1);
  const auto choose = [](const model::ModelDescription& from, const CutOptions& options) {
    static_cast<void>(choose_planes(from, options));
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(choose(model, {.parts = 0, .coarse_size = 1.0}), ConfigError);
  EXPECT_THROW(choose(model, {.parts = 2, .coarse_size = 0.0}), ConfigError);
  EXPECT_THROW(choose(model, {.parts = 2, .coarse_size = kNan}), ConfigError);
  EXPECT_THROW(choose(model, {.coarse_size = 1.0, .given = {{{0, 0, 0}, 1.0}}}), ConfigError);
  EXPECT_THROW(choose(model, {.coarse_size = 1.0, .given = {{{1, 0, 0}, kNan}}}), ConfigError);
  model::ModelDescription damaged = model;
  damaged.triangle_vertices.back() = 1000;
  EXPECT_THROW(choose(damaged, {.parts = 2, .coarse_size = 1.0}), InputError);
}

}  // namespace
}  // namespace tessera::cut

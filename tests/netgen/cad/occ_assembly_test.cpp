// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include <BRepTools.hxx>
#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

#include "support/temporary_folder.hpp"

#include "netgen/cad/assemblies.hpp"
#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;
using model::Overlap;
using testing::AssemblyModel;

constexpr double kRounding = 1e-6;  // Of volumes and areas of round bodies, by OpenCASCADE.

// Imports an assembly from a file.
class OccAssembly : public ::testing::Test {
 protected:
  [[nodiscard]] model::ModelSource read(const AssemblyModel& assembly,
                                        const model::AssemblyOptions& options = {}) const
  {
    const fs::path file = folder_.path() / "assembly.brep";
    BRepTools::Write(testing::compound_of(assembly), file.c_str());
    return netgen::import_model(file, {.assembly = options});
  }

  [[nodiscard]] std::string refusal_of(const AssemblyModel& assembly,
                                       const model::AssemblyOptions& options = {}) const
  {
    try {
      (void)read(assembly, options);
    } catch (const Error& error) {
      return error.what();
    }
    ADD_FAILURE() << assembly.name << " was not refused";
    return {};
  }

  testing::TemporaryFolder folder_{};
};

model::ModelDescription description_of(const model::ModelSource& source)
{
  return netgen::describe_model(*netgen::load_model(source));
}

double volume_of(const model::ModelDescription& description, std::size_t first, std::size_t last)
{
  double volume = 0.0;
  for (std::size_t i = first; i < last; ++i) volume += description.solids[i].volume;
  return volume;
}

using Areas = std::map<std::array<int, 2>, double>;

Areas common_areas(const model::ModelDescription& description)
{
  Areas areas;
  for (const model::FaceDescription& face : description.faces) {
    if (face.solids.size() == 2) areas[{face.solids[0], face.solids[1]}] += face.area;
  }
  return areas;
}

void expect_touches(const AssemblyModel& assembly, const model::ModelDescription& description)
{
  const Areas areas = common_areas(description);
  EXPECT_EQ(areas.size(), assembly.touches.size()) << assembly.name;
  for (const testing::Meeting& touch : assembly.touches) {
    const auto found = areas.find(touch.bodies);
    ASSERT_NE(found, areas.end()) << assembly.name;
    EXPECT_NEAR(found->second, touch.measure, kRounding * touch.measure) << assembly.name;
  }
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST_F(OccAssembly, SharesTheFacesWhereSolidsTouchAndKeepsTheirVolumes)
{
  for (const AssemblyModel& assembly : testing::assemblies()) {
    if (!assembly.overlaps.empty()) continue;
    const model::ModelSource source = read(assembly);
    const model::ModelDescription description = description_of(source);
    ASSERT_EQ(description.solids.size(), assembly.bodies.size()) << assembly.name;
    for (std::size_t i = 0; i < assembly.bodies.size(); ++i) {
      const double volume = assembly.bodies[i].volume;
      EXPECT_NEAR(description.solids[i].volume, volume, kRounding * volume) << assembly.name;
    }
    expect_touches(assembly, description);
    EXPECT_EQ(source.assembly.tolerance > 0.0, !assembly.touches.empty()) << assembly.name;
    EXPECT_LT(source.assembly.tolerance, 1e-5) << assembly.name;
  }
}

TEST_F(OccAssembly, IsRefusedIfSolidsOverlapWithBothAndTheVolumeAndThePlace)
{
  EXPECT_TRUE(contains(refusal_of(testing::assembly("overlapping_corners")),
                       "solids overlap: solid 1 and solid 2 have a volume of 1 in common, within "
                       "(1, 1, 1) to (2, 2, 2)"));
  const std::string three = refusal_of(testing::assembly("three_overlaps"));
  EXPECT_TRUE(contains(three, "solid 1 and solid 2 have a volume of 4")) << three;
  EXPECT_TRUE(contains(three, "solid 1 and solid 3 have a volume of 3")) << three;
  EXPECT_TRUE(contains(three, "solid 2 and solid 3 have a volume of 3")) << three;
  for (const AssemblyModel& assembly : testing::assemblies()) {
    if (assembly.overlaps.empty()) continue;
    EXPECT_TRUE(contains(refusal_of(assembly), "geometry.overlap")) << assembly.name;
  }
}

TEST_F(OccAssembly, OfStepNamesTheSolidsThatOverlap)
{
  const fs::path file = folder_.path() / "assembly.step";
  testing::write_step(testing::assembly("pin_through_plate"), file);
  try {
    (void)netgen::import_model(file, {});
    FAIL() << "was not refused";
  } catch (const GeometryError& error) {
    EXPECT_TRUE(contains(error.what(), "solid 1 'plate' and solid 2 'pin'")) << error.what();
  }
}

TEST_F(OccAssembly, OfStepKeepsNamesAndColours)
{
  const fs::path file = folder_.path() / "assembly.step";
  for (const char* name : {"stairs", "pin_in_hole", "ball_in_block"}) {
    const AssemblyModel assembly = testing::assembly(name);
    testing::write_step(assembly, file);
    const model::ModelDescription description = description_of(netgen::import_model(file, {}));
    ASSERT_EQ(description.solids.size(), assembly.bodies.size()) << name;
    for (std::size_t i = 0; i < assembly.bodies.size(); ++i) {
      EXPECT_EQ(description.solids[i].name, assembly.bodies[i].name) << name;
    }
    for (const model::FaceDescription& face : description.faces) EXPECT_NE(face.colour, "") << name;
    expect_touches(assembly, description);
  }
}

// Volumes of what the solids have after common parts went to the first, or to the last.
struct Shares {
  const char* name;
  std::vector<double> with_first{};
  std::vector<double> with_last{};
};

TEST_F(OccAssembly, GivesWhatSolidsHaveInCommonToTheFirstOrTheLast)
{
  constexpr double kPin = 3.14159265358979 * 0.49;
  constexpr double kBall = 4.0 / 3.0 * 3.14159265358979;
  const std::vector<Shares> all{
      {"overlapping_corners", {8, 7}, {7, 8}},
      {"pin_through_plate", {16, kPin / 2, kPin / 2}, {16 - kPin, 2 * kPin}},
      {"inclusion", {64}, {64 - kBall, kBall}},
      {"twice", {1}, {1}},
      {"three_overlaps", {8, 4, 4}, {3, 5, 8}}};
  for (const Shares& shares : all) {
    for (const auto& [rule, volumes] : {std::pair(Overlap::first, shares.with_first),
                                        std::pair(Overlap::last, shares.with_last)}) {
      const model::ModelSource source = read(testing::assembly(shares.name), {.overlap = rule});
      const model::ModelDescription description = description_of(source);
      ASSERT_EQ(description.solids.size(), volumes.size()) << shares.name;
      for (std::size_t i = 0; i < volumes.size(); ++i) {
        EXPECT_NEAR(description.solids[i].volume, volumes[i], kRounding * volumes[i])
            << shares.name;
      }
      EXPECT_EQ(source.assembly.overlaps.size(), testing::assembly(shares.name).overlaps.size());
      EXPECT_EQ(common_areas(description).empty(), volumes.size() == 1) << shares.name;
    }
  }
}

TEST_F(OccAssembly, CutsCommonPartsOffIfItIsToldTo)
{
  const model::ModelSource source =
      read(testing::assembly("overlapping_corners"), {.overlap = Overlap::cut});
  const model::ModelDescription description = description_of(source);
  ASSERT_EQ(description.solids.size(), 3U);
  EXPECT_NEAR(volume_of(description, 0, 3), 15.0, kRounding);
}

TEST_F(OccAssembly, ListsWhatOverlapsWithItsVolumeAndBox)
{
  for (const AssemblyModel& assembly : testing::assemblies()) {
    if (assembly.overlaps.empty()) continue;
    const auto found = read(assembly, {.overlap = Overlap::first}).assembly.overlaps;
    ASSERT_EQ(found.size(), assembly.overlaps.size()) << assembly.name;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto& [bodies, volume] = assembly.overlaps[i];
      EXPECT_EQ(found[i].solids.numbers[0], bodies[0]) << assembly.name;
      EXPECT_EQ(found[i].solids.numbers[1], bodies[1]) << assembly.name;
      EXPECT_NEAR(found[i].volume, volume, kRounding * volume) << assembly.name;
      const Vec3 size = found[i].high - found[i].low;
      EXPECT_GE(size[0] * size[1] * size[2], (1.0 - kRounding) * volume) << assembly.name;
    }
  }
}

TEST_F(OccAssembly, ClosesGapsBelowTheToleranceAndListsThem)
{
  const AssemblyModel rounding = testing::boxes_with_gap(1e-6);
  const AssemblyModel gap = testing::boxes_with_gap(1e-3);
  EXPECT_TRUE(common_areas(description_of(read(rounding, {.gap = 0.0}))).empty());
  EXPECT_TRUE(common_areas(description_of(read(gap))).empty());
  for (const auto& [assembly, width, options] :
       {std::tuple(rounding, 1e-6, model::AssemblyOptions{}),
        std::tuple(gap, 1e-3, model::AssemblyOptions{.gap = 2e-3})}) {
    const model::ModelSource source = read(assembly, options);
    const Areas areas = common_areas(description_of(source));
    ASSERT_EQ(areas.size(), 1U) << width;
    EXPECT_NEAR(areas.begin()->second, 0.64, 2.0 * width) << width;
    ASSERT_EQ(source.assembly.gaps.size(), 1U) << width;
    EXPECT_NEAR(source.assembly.gaps[0].width, width, 1e-3 * width);
    EXPECT_NEAR(source.assembly.gaps[0].place[2], 1.0, 2.0 * width);
    EXPECT_GE(source.assembly.tolerance, 0.5 * width);
    EXPECT_TRUE(contains(source.repairs.front(),
                         "gaps between solids were closed: solid 1 and "
                         "solid 2 were"))
        << source.repairs.front();
  }
}

TEST_F(OccAssembly, TakesASolidOnceThatIsThereTwiceAndSaysSo)
{
  AssemblyModel assembly = testing::assembly("offset_boxes");
  assembly.bodies.push_back(assembly.bodies[1]);
  const model::ModelSource source = read(assembly);
  EXPECT_EQ(description_of(source).solids.size(), 2U);
  EXPECT_TRUE(contains(source.repairs.front(), "twice at the same place were taken once: 1"))
      << source.repairs.front();
}

TEST_F(OccAssembly, TakesAwayWhatASolidHasOnBothSidesOfAFaceOfAnother)
{
  const model::ModelSource source = read(testing::assembly("lead_with_flap"));
  EXPECT_TRUE(contains(source.repairs.back(), "1 faces bounded a solid from both sides"))
      << source.repairs.back();
}

}  // namespace
}  // namespace tessera

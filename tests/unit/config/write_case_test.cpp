// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "config/key_table.hpp"

namespace tessera::config {
namespace {

Case complete_case()
{
  Case wanted;
  wanted.geometry = {
      .file = "/m \"q\" \\ ü\t.step", .scale = 1.0 / 3.0, .assembly = {model::Overlap::cut, 1e-9}};
  wanted.splits = {.patches = {{"cr\"ack*"}}, .contacts = {{"st\"ep", "[12]"}, {"a", "b"}}};
  wanted.periodic = {{.from = "a*", .to = "\"b\"", .translation = {1.0 / 3.0, 0.0, -2.0}},
                     {.from = "c", .to = "d", .axis = {0.0, 0.0, 1.0}, .angle_deg = 0.1}};
  wanted.size = {.min = 1e-3,
                 .max = 1.0 / 7.0,
                 .grading = 0.2,
                 .field = "/s \"i\" ze.vti",
                 .field_array = "h \"x\"",
                 .regions = {{sizing::Box{{-1.0 / 3.0, 0.0, 1e-9}, {1.0, 2e20, 3.0}}, 0.1, 0.5},
                             {sizing::Ball{{1.0, 2.0, 3.0}, 0.25}, 1.0 / 3.0, 0.0},
                             {sizing::Cylinder{{0.0, 0.0, 0.0}, {0.0, 0.0, -2.0}, 4.0}, 0.3, 0.0},
                             {sizing::HalfSpace{{0.5, 0.0, 0.0}, {-1.0, 0.0, 0.0}}, 0.4, 1.0},
                             {sizing::PatchPattern{"in \"l\" [ab]*"}, 0.5, 0.0},
                             {sizing::MaterialPattern{"st?el"}, 0.6, 0.0},
                             {sizing::CurvePattern{"3-7"}, 0.7, 0.0}}};
  wanted.coarse = {.max_size = 1e-7,
                   .grading = 0.1,
                   .curvature = 99.5,
                   .feature_angle_deg = 12.25,
                   .optimize = true};
  wanted.decompose.subdomains = 77;
  wanted.refine.levels = 0;
  wanted.fill = {
      .kernel = fill::KernelKind::subdivide,
      .regions = {{"st\"a\\hl ü\n", fill::KernelKind::netgen}, {"b", fill::KernelKind::subdivide}},
      .timeout_s = 1e5,
      .memory_gib = 0.3,
      .optimize_steps = 9,
      .grading = 0.9};
  wanted.quality = {.min_dihedral_deg = 7.1, .min_mean_ratio = 0.11};
  wanted.output.directory = "out/a b";
  wanted.output.compression = io::Compression::none;
  wanted.output.files = 12;
  wanted.output.cell_quality = true;
  wanted.output.report_html = false;
  return wanted;
}

TEST(ToToml, ReadsBackAsTheSameCase)
{
  const Case wanted = complete_case();
  EXPECT_EQ(parse_case(to_toml(wanted), "/elsewhere/case.toml"), wanted);
}

TEST(ToToml, ReadsBackAsTheSameCaseWithATargetSize)
{
  Case wanted = complete_case();
  wanted.size.target = 0.125;
  wanted.coarse.max_size = 0.0;
  wanted.refine.levels = refine::RefineOptions{}.levels;
  wanted.decompose.subdomains = 0;
  EXPECT_EQ(parse_case(to_toml(wanted), "/elsewhere/case.toml"), wanted);
}

TEST(ToToml, ReadsBackAsTheSameCaseWithAWrap)
{
  Case wanted;
  wanted.geometry.file = "/models/robot.stl";
  wanted.geometry.stl = {.repair = model::StlRepair::wrap, .wrap_tolerance = 0.25};
  wanted.coarse.max_size = 2.0;
  EXPECT_EQ(parse_case(to_toml(wanted), "/elsewhere/case.toml").geometry, wanted.geometry);
}

TEST(ToToml, WritesEveryKeyThatIsGiven)
{
  const std::string text = to_toml(complete_case());
  for (const Key& key : all_keys()) {
    const std::string line = "\n" + std::string(last_part(key.name)) + " = ";
    const bool is_not_given = key.name == "size.target" || key.name == "geometry.cad"
                              || key.name == "geometry.wrap_tolerance";
    EXPECT_EQ(text.find(line) != std::string::npos, !is_not_given) << key.name;
  }
}

TEST(ToToml, HasNoRegionUnlessOneIsGiven)
{
  Case wanted = complete_case();
  EXPECT_NE(to_toml(wanted).find("[[fill.region]]\nmaterial = \"b\"\nkernel = \"subdivide\"\n"),
            std::string::npos);
  wanted.fill.regions.clear();
  EXPECT_EQ(to_toml(wanted).find("fill.region"), std::string::npos);
  EXPECT_EQ(parse_case(to_toml(wanted), "/elsewhere/case.toml"), wanted);
}

TEST(ToToml, RefusesAPathThatIsNoUtf8)
{
  Case wanted = complete_case();
  wanted.output.directory = "gr\xFC\xDF";
  EXPECT_THROW((void)to_toml(wanted), ConfigError);
}

TEST(Reference, IsACaseWithEveryDefault)
{
  Case defaults;
  defaults.geometry.file = "/configs/model.step";
  defaults.coarse.max_size = 10.0;
  defaults.output.directory = "outputs/reference";
  EXPECT_EQ(parse_case(reference_toml(), "/configs/reference.toml"), defaults);
}

// The text with its commented tables and keys made effective from `begin` on.
std::string uncommented(std::string text, const std::string& begin)
{
  text.erase(0, text.find(begin));
  return std::regex_replace(text, std::regex("(^|\n)# (?=\\[\\[|[a-z_.]+ = )"), "$1");
}

TEST(Reference, ExamplesOfAListAreAValidTable)
{
  const std::string region = uncommented(reference_toml(), "# [[fill.region]]");
  const Case loaded = parse_case("geometry.file = 'a'\nsize.target = 1\n" + region, "case.toml");
  EXPECT_EQ(loaded.fill.regions,
            (std::vector<fill::FillRegion>{{"steel", fill::KernelKind::subdivide}}));
  EXPECT_EQ(
      loaded.size.regions,
      (std::vector<sizing::SizeRegion>{{sizing::Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}, 0.1, 0.3}}));
}

TEST(Reference, NamesEveryKeyOfEveryListWithItsReason)
{
  const std::string text = reference_toml();
  for (const TableList& list : all_table_lists()) {
    const std::size_t heading = text.find("\n# [[" + std::string(list.name) + "]]\n");
    ASSERT_NE(heading, std::string::npos) << list.name;
    EXPECT_FALSE(list.meaning.empty() || list.reason.empty()) << list.name;
    for (const Key& key : list.keys) {
      const std::string line = std::string(name_in_list(list, key)) + " = ";
      EXPECT_TRUE(text.find("\n# " + line, heading) != std::string::npos
                  || text.find("\n# or " + line, heading) != std::string::npos)
          << key.name;
      EXPECT_FALSE(key.meaning.empty() || key.reason.empty()) << key.name;
    }
  }
}

TEST(Reference, NamesEveryKeyWithItsRangeAndReason)
{
  const std::string text = reference_toml();
  for (const Key& key : all_keys()) {
    const std::size_t heading = text.find("\n[" + std::string(table_of(key.name)) + "]\n");
    ASSERT_NE(heading, std::string::npos) << key.name;
    const std::string table = text.substr(heading + 1, text.find("\n[", heading + 1) - heading);
    const std::string comment = key.is_optional ? "\n# " : "\n";
    EXPECT_NE(table.find(comment + std::string(last_part(key.name)) + " = "), std::string::npos)
        << key.name;
    EXPECT_FALSE(key.meaning.empty()) << key.name;
    EXPECT_FALSE(key.reason.empty()) << key.name;
  }
}

TEST(KeyTable, NamesAreUnique)
{
  for (const Key& key : all_keys()) {
    EXPECT_EQ(find_key(key.name), &key) << key.name;
  }
}

TEST(KeyTable, ListsHaveNamesOfTheirOwnAndAUniqueKeyAmongTheirKeys)
{
  for (const TableList& list : all_table_lists()) {
    EXPECT_EQ(find_table_list(list.name), &list) << list.name;
    EXPECT_TRUE(find_key(list.name) == nullptr && !is_table(list.name)) << list.name;
    if (!list.unique_key.empty()) {
      EXPECT_EQ(std::ranges::count(list.keys, list.unique_key, &Key::name), 1) << list.name;
    }
    for (const Key& key : list.keys) EXPECT_EQ(list_around(key.name), &list) << key.name;
    for (const std::string_view word : list.alternatives) {
      EXPECT_TRUE(std::ranges::any_of(list.keys, [&](const Key& key) {
        return alternative_of(list, key) == word;
      })) << word;
    }
  }
}

TEST(KeyTable, DefaultsAreAllowed)
{
  Case from;
  from.geometry.file = "/a.geo";
  from.coarse.max_size = 1.0;
  from.output.directory = "out";
  for (const Key& key : all_keys()) {
    const auto text = toml_value(key.rule, from);
    if (key.is_optional && !text) continue;
    ASSERT_TRUE(text.has_value()) << key.name;
    const auto entry = parse_toml_value(*text, std::string(key.name), "test");
    ASSERT_TRUE(entry.has_value()) << key.name;
    Case into;
    EXPECT_TRUE(assign(key.rule, entry->value, into)) << key.name << " = " << *text;
  }
}

TEST(RequireInRange, TakesWhatACaseFileCanHaveAndNumbersThatAreNotGiven)
{
  EXPECT_NO_THROW(require_in_range(Case{}, "made"));
  EXPECT_NO_THROW(require_in_range(complete_case(), "made"));
}

TEST(RequireInRange, NamesTheKeyAndWhatItMayBe)
{
  const auto said = [](const auto& spoil) -> std::string {
    Case given = complete_case();
    spoil(given);
    try {
      require_in_range(given, "made");
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_EQ(
      said([](Case& c) { c.decompose.subdomains = -3; }),
      "made: decompose.subdomains = -3: must be a whole number from 1 to 1000000, or \"auto\"");
  for (const double size : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(said([&](Case& c) { c.coarse.max_size = size; }).find("made: coarse.max_size = "),
              0U);
  }
  EXPECT_EQ(said([](Case& c) { c.fill.timeout_s = -1.0; }).find("made: fill.timeout_s = -1: "), 0U);
}

TEST(KnownKeys, AreThoseOfTheReferenceWithTheirWords)
{
  const std::string reference = reference_toml();
  for (const KnownKey& key : known_keys()) {
    const std::string last(key.name.substr(key.name.find('.') + 1));
    EXPECT_NE(reference.find(last + " = "), std::string::npos) << key.name;
    EXPECT_EQ(key.is_path, key.name == "geometry.file" || key.name == "geometry.cad"
                               || key.name == "output.directory" || key.name == "size.field");
    if (key.name == "fill.kernel") {
      EXPECT_EQ(key.words.size(), 3U);
      EXPECT_EQ(key.words.front(), "netgen");
    }
    if (key.name == "fill.split_corners") {
      EXPECT_EQ(key.words, (std::vector<std::string_view>{"true", "false", "auto"}));
    }
    EXPECT_EQ(key.words.size() == 2,
              key.name == "coarse.optimize" || key.name == "improve.seams"
                  || key.name == "decompose.planes" || key.name == "geometry.smooth"
                  || key.name == "geometry.repair" || key.name == "geometry.loose_faces"
                  || key.name == "geometry.loose_curves" || key.name == "coarse.mesher"
                  || key.name == "output.cell_quality" || key.name == "output.layers"
                  || key.name == "output.report_html")
        << key.name;
  }
}

}  // namespace
}  // namespace tessera::config

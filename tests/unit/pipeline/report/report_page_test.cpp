// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report_page.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json ok_report()
{
  return {
      {"schema", 1},
      {"version", "1.2.3"},
      {"status", "ok"},
      {"exit_code", 0},
      {"reason", ""},
      {"reasons", Json::array()},
      {"case", "shaft.toml"},
      {"num_ranks", 2},
      {"num_tets", 12345},
      {"wall_time_s", 10.0},
      {"digest", "00ff"},
      {"stages",
       {{{"name", "fill"}, {"wall_time_s", 8.0}, {"rank_min_s", 3.0}, {"rank_max_s", 8.0}}}},
      {"quality",
       {{"min_dihedral_deg", 20.0},
        {"max_dihedral_deg", 140.0},
        {"mean_ratio", {{"min", 0.5}, {"p01", 0.6}, {"mean", 0.9}, {"histogram", {0, 1, 5, 2}}}},
        {"dihedral_deg_histogram", {{"smallest_of_tet", {0, 8}}, {"largest_of_tet", {1, 7}}}},
        {"worst",
         {{{"mean_ratio", 0.5},
           {"min_dihedral_deg", 20.0},
           {"max_dihedral_deg", 140.0},
           {"subdomain", 3},
           {"centre", {1.5, 2.5, -3.5}}}}}}},
      {"patch_names", {"<b>in</b>", "out \"1\""}}};
}

ReportSource source_of(const Json& json)
{
  return {.json = json.dump(), .pictures = {{"patches", "AAAA"}}, .folder = "out/my shaft"};
}

bool has(const std::string& page, const std::string& text)
{
  return page.find(text) != std::string::npos;
}

TEST(ReportPage, HasTheVerdictBeforeAllElse)
{
  const std::string page = report_page(source_of(ok_report()));
  const std::vector<const char*> order{"data-status=\"ok\"", "Key figures", "picture-patches",
                                       "Dihedral angles",    "who waited",  "worst tets",
                                       "Warnings",           "Run it again"};
  std::size_t place = 0;
  for (const char* const text : order) {
    const std::size_t found = page.find(text, place);
    ASSERT_NE(found, std::string::npos) << text;
    place = found;
  }
}

TEST(ReportPage, HasTheFigures)
{
  const std::string page = report_page(source_of(ok_report()));
  for (const char* const text : {"12,345", "10.0 s", "-3.5", "0.5000", "a rank waited 5.0 s"}) {
    EXPECT_TRUE(has(page, text)) << text;
  }
}

TEST(ReportPage, NamesCoarseTetsWithSmallAngles)
{
  constexpr const char* kHeading = "Small angles that the model does not force";
  Json json = ok_report();
  EXPECT_FALSE(has(report_page(source_of(json)), kHeading));
  json["coarse"]["sharp"] = {
      {"num_tets", 1},
      {"worst",
       {{{"min_dihedral_deg", 1.25}, {"centre", {7.5, 2.5, -4.5}}, {"patches", {"<b>", "c"}}}}}};
  const std::string page = report_page(source_of(json));
  for (const char* const text : {kHeading, "1.25°", "-4.5", "&lt;b&gt;, c"}) {
    EXPECT_TRUE(has(page, text)) << text;
  }
}

TEST(ReportPage, EscapesNamesAndQuotesFolders)
{
  Json json = ok_report();
  json["case"] = "<script>x</script>.toml";
  const std::string page = report_page(source_of(json));
  EXPECT_FALSE(has(page, "<script"));
  EXPECT_TRUE(has(page, "&lt;b&gt;in&lt;/b&gt;"));
  EXPECT_TRUE(has(page, "out &quot;1&quot;"));
  EXPECT_TRUE(has(page, "tessera mesh &#39;out/my shaft/case.toml&#39;"));
}

TEST(ReportPage, HasEveryReasonOfADegradedRun)
{
  Json json = ok_report();
  json["status"] = "degraded";
  json["reasons"] = {"first; with more", "second <x>"};
  const std::string page = report_page(source_of(json));
  EXPECT_TRUE(has(page, "<li>first; with more</li><li>second &lt;x&gt;</li>"));
}

TEST(ReportPage, SaysTheWayOutOfEveryFailure)
{
  for (const auto& [code, text] : std::vector<std::pair<int, std::string>>{
           {2, "failure"}, {64, "Correct"}, {70, "report"}, {73, "--resume"}, {75, "Stopped"}}) {
    const Json json{{"schema", 1},      {"status", "failed"}, {"exit_code", code},
                    {"reason", "a\nb"}, {"case", "x.toml"},   {"num_ranks", 1}};
    const std::string page = report_page(source_of(json));
    EXPECT_TRUE(has(page, text)) << code;
    EXPECT_TRUE(has(page, "<pre>a\nb</pre>"));
    EXPECT_FALSE(has(page, "<h2>Quality")) << code;
  }
}

TEST(ReportPage, SaysWhatToDoAboutWaitingRanks)
{
  EXPECT_TRUE(has(report_page(source_of(ok_report())), "More decompose.subdomains"));
  Json even = ok_report();
  even["stages"][0]["rank_min_s"] = 7.9;
  EXPECT_FALSE(has(report_page(source_of(even)), "More decompose.subdomains"));
}

TEST(ReportPage, RefusesWhatIsNoReport)
{
  for (const char* const json :
       {"", "[]", "{}", "{\"schema\": 2, \"status\": \"ok\"}", "{\"schema\": 1, \"status\": 3}"}) {
    EXPECT_THROW(static_cast<void>(report_page({.json = json})), InputError) << json;
  }
}

TEST(ReportSource, IsReadBackFromAFolder)
{
  const testing::TemporaryFolder folder;
  const ReportSource made{.json = ok_report().dump(),
                          .pictures = {{"subdomains", "AAAA"}, {"cut", "BB=="}},
                          .folder = folder.path()};
  testing::write_bytes(folder.path() / "report.json", made.json);
  EXPECT_TRUE(read_report_source(folder.path()).pictures.empty());
  testing::write_bytes(folder.path() / "report.html", report_page(made));
  const ReportSource read = read_report_source(folder.path());
  EXPECT_EQ(read.pictures, made.pictures);
  EXPECT_EQ(read.json, made.json);
}

TEST(ReportSource, TakesNothingButBase64FromAPage)
{
  const testing::TemporaryFolder folder;
  testing::write_bytes(folder.path() / "report.json", ok_report().dump());
  testing::write_bytes(folder.path() / "report.html",
                       "<img id=\"picture-cut\" src=\"data:image/png;base64,AA<script>\">");
  EXPECT_TRUE(read_report_source(folder.path()).pictures.empty());
  EXPECT_THROW(static_cast<void>(read_report_source(folder.path() / "none")), InputError);
}

TEST(ComparePage, SaysWhetherTheMeshesAreTheSame)
{
  Json other = ok_report();
  EXPECT_TRUE(has(compare_page(source_of(ok_report()), source_of(other)), "the same, bit for bit"));
  other["digest"] = "00fe";
  EXPECT_TRUE(has(compare_page(source_of(ok_report()), source_of(other)), "The two meshes differ"));
}

TEST(ComparePage, MarksWhatBecameBetterOrWorse)
{
  Json other = ok_report();
  other["wall_time_s"] = 5.0;
  other["quality"]["mean_ratio"]["min"] = 0.4;
  const std::string page = compare_page(source_of(ok_report()), source_of(other));
  EXPECT_TRUE(has(page,
                  "<tr class=\"better\"><td>wall time</td><td>10.0 s</td><td>5.0 s</td>"
                  "<td>0.500 better</td></tr>"));
  EXPECT_TRUE(has(page, "<tr class=\"worse\"><td>worst mean ratio</td>"));
  EXPECT_TRUE(has(page, "<tr><td>tets</td>"));
  EXPECT_TRUE(has(page, "picture-a-patches"));
  EXPECT_TRUE(has(page, "picture-b-patches"));
  const std::string text = compare_text(source_of(ok_report()), source_of(other));
  EXPECT_TRUE(has(text, "0.500  better"));
}

TEST(ComparePage, TakesARunWithoutAMesh)
{
  const Json failed{{"schema", 1},    {"status", "failed"}, {"exit_code", 2},
                    {"reason", "no"}, {"case", "x.toml"},   {"num_ranks", 1}};
  const std::string page = compare_page(source_of(ok_report()), source_of(failed));
  EXPECT_TRUE(has(page, "There are no two meshes to compare"));
  EXPECT_TRUE(has(page, "<td>–</td>"));
}

}  // namespace
}  // namespace tessera::pipeline

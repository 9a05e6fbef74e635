// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tessera/check/report.hpp"

namespace tessera::check {
namespace {

TEST(CheckReportJson, HasTheKeysOfTheRunReport)
{
  CheckReport report;
  report.conforms = true;
  report.has_digest = true;
  report.digest = {1, 2};
  report.num_tets = 7;
  report.volume = 0.1;
  report.subdomains.resize(2);
  report.subdomains[1].id = 100000;
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["num_tets"], 7);
  EXPECT_EQ(json["num_subdomains"], 2);
  EXPECT_EQ(json["volume"].get<double>(), 0.1);
  EXPECT_EQ(json["digest"], "00000000000000020000000000000001");
  EXPECT_EQ(json["quality"]["mean_ratio"]["histogram"].size(), 20U);
  EXPECT_TRUE(json["quality"]["edge_length"].contains("median"));
  EXPECT_TRUE(json["quality"]["seam"].contains("num_tets"));
  EXPECT_EQ(json["subdomains"].size(), 2U);
  EXPECT_EQ(json["subdomains"][1]["id"], 100000);
  EXPECT_EQ(json["partial"], false);
}

TEST(CheckReportJson, NamesOffendersAndLeavesOutADigestThatIsNone)
{
  CheckReport report;
  report.defects.push_back({"triangle", 3, {"first", "second"}});
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["conforms"], false);
  EXPECT_EQ(json["offenders"][0]["kind"], "triangle");
  EXPECT_EQ(json["offenders"][0]["count"], 3);
  EXPECT_EQ(json["offenders"][0]["first"].size(), 2U);
  EXPECT_TRUE(json["digest"].is_null());
}

}  // namespace
}  // namespace tessera::check

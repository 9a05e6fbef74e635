// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::config {
namespace {

constexpr const char* kMinimal = "geometry.file = 'a.geo'\nsize.target = 1\n";
constexpr const char* kGeometry = "decompose.method = 'geometry'\n";
constexpr const char* kPlane = "[[decompose.plane]]\npoint = [1, 2, 3]\nnormal = [0, 0, 2]\n";

Case parsed(const std::string& lines)
{
  return parse_case(kMinimal + lines, "/cases/case.toml", {});
}

std::string error_of(const std::string& lines)
{
  return testing::message_of<ConfigError>([&] { (void)parsed(lines); });
}

TEST(Planes, AreThoseOfTheCase)
{
  std::string lines = kGeometry;
  lines += "decompose.planes = 'pca'\n";
  const Case loaded = parsed(lines += kPlane);
  EXPECT_EQ(loaded.decompose.method, decompose::Method::geometry);
  EXPECT_EQ(loaded.planes.rule, cut::PlaneRule::pca);
  ASSERT_EQ(loaded.planes.given.size(), 1U);
  EXPECT_EQ(loaded.planes.given[0].point, (Vec3{1, 2, 3}));
  EXPECT_EQ(loaded.planes.given[0].normal, (Vec3{0, 0, 2}));
  EXPECT_EQ(parse_case(to_toml(loaded), "/cases/case.toml", {}), loaded);
}

TEST(Planes, CutTheCoarseMeshUnlessTheCaseSaysMore)
{
  EXPECT_EQ(parsed("").decompose.method, decompose::Method::mesh);
  EXPECT_EQ(parsed(kGeometry).planes, cut::PlaneSettings{});
}

TEST(Planes, NeedTheirMethodAndADirection)
{
  EXPECT_NE(error_of(kPlane).find("needs decompose.method = \"geometry\""), std::string::npos);
  const std::string flat = "[[decompose.plane]]\npoint = [1, 2, 3]\nnormal = [0, 0, 0]\n";
  EXPECT_NE(error_of(kGeometry + flat).find("normal must not be zero"), std::string::npos);
  const std::string no_point = "[[decompose.plane]]\nnormal = [0, 0, 1]\n";
  EXPECT_NE(error_of(kGeometry + no_point).find("no decompose.plane.point"), std::string::npos);
}

}  // namespace
}  // namespace tessera::config

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/stl_file.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/stl_models.hpp"
#include "support/temporary_file.hpp"

namespace tessera::model {
namespace {

using testing::ascii_stl;
using testing::binary_stl;
using testing::cube_soup;
using testing::joined;
using testing::sphere_soup;
using testing::TemporaryFile;

TriangleSoup read(const std::string& content)
{
  return read_stl(TemporaryFile("model.stl", content).path());
}

// The message of the InputError that reading throws; empty if it throws none.
std::string message_of_reading(const std::string& content)
{
  try {
    (void)read(content);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

constexpr const char* kOneFacet =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\n";

TEST(StlFile, AsciiKeepsEveryBitAndTheNamesOfItsSolids)
{
  TriangleSoup both = joined(cube_soup(), sphere_soup(2));
  both.solid_names = {"first part", "second"};
  const TriangleSoup back = read(ascii_stl(both));
  EXPECT_EQ(back.corner_xyz, both.corner_xyz);
  EXPECT_EQ(back.triangle_solid, both.triangle_solid);
  EXPECT_EQ(back.solid_names, both.solid_names);
}

TEST(StlFile, BinaryKeepsSinglePrecision)
{
  const TriangleSoup sphere = sphere_soup(2);
  const TriangleSoup back = read(binary_stl(sphere));
  ASSERT_EQ(back.corner_xyz.size(), sphere.corner_xyz.size());
  for (std::size_t i = 0; i < back.corner_xyz.size(); ++i) {
    EXPECT_EQ(back.corner_xyz[i], static_cast<double>(static_cast<float>(sphere.corner_xyz[i])));
  }
}

TEST(StlFile, BinaryThatBeginsWithSolidIsReadAsBinary)
{
  const TriangleSoup back = read(binary_stl(cube_soup(), "solid gear wheel  "));
  EXPECT_EQ(back.corner_xyz, cube_soup().corner_xyz);
  EXPECT_EQ(back.solid_names, std::vector<std::string>{"gear wheel"});
}

TEST(StlFile, KeywordsMayHaveAnyCaseLineEndsMayBeDosAndNormalsNan)
{
  const std::string text =
      "SOLID\r\n  FACET NORMAL nan -nan inf\r\nOuter Loop\r\nVertex +1e0 -0 .5\r\n"
      "vertex 1E+1 0 0 vertex 0 2 0\r\nENDLOOP endfacet\r\nEndSolid";
  const TriangleSoup soup = read(text);
  EXPECT_EQ(soup.corner_xyz, (std::vector<double>{1, 0, 0.5, 10, 0, 0, 0, 2, 0}));
  EXPECT_FALSE(std::signbit(soup.corner_xyz[1]));
}

TEST(StlFile, WrongWordIsNamedWithItsLine)
{
  std::string text = kOneFacet;
  text.replace(text.find("vertex 1"), 6, "vortex");
  const std::string message = message_of_reading(text + "endsolid\n");
  EXPECT_TRUE(has(message, "model.stl:5: expected 'vertex', found 'vortex'")) << message;
}

TEST(StlFile, CoordinateThatIsNoFiniteNumberIsNamedWithItsLine)
{
  for (const std::string bad : {"nan", "inf", "1e999", "1,5", "0x10", "--1"}) {
    std::string text = kOneFacet;
    text.replace(text.find("vertex 0 1 0"), 12, "vertex 0 " + bad + " 0");
    const std::string message = message_of_reading(text + "endsolid\n");
    EXPECT_TRUE(has(message, "model.stl:6: coordinate '" + bad + "' is not a finite number"))
        << message;
  }
}

TEST(StlFile, TruncatedAsciiIsRefusedWhereverItEnds)
{
  const std::string whole = std::string(kOneFacet) + "endsolid";
  for (std::size_t size = 7; size < whole.size(); ++size) {
    EXPECT_NE(message_of_reading(whole.substr(0, size)), "") << "cut after " << size;
  }
  EXPECT_TRUE(has(message_of_reading(kOneFacet), "model.stl:9: file is truncated"));
}

TEST(StlFile, TruncatedBinaryNamesBothSizes)
{
  const std::string whole = binary_stl(cube_soup(), "solid");
  for (const std::size_t size : {whole.size() - 1, whole.size() - 50, std::size_t{84}}) {
    const std::string message = message_of_reading(whole.substr(0, size));
    EXPECT_TRUE(has(message, "promises 12 triangles, which is 684 bytes")) << message;
    EXPECT_TRUE(has(message, "has " + std::to_string(size))) << message;
  }
}

TEST(StlFile, CountInTheHeaderIsNotTrustedForAnAllocation)
{
  std::string bytes = binary_stl(cube_soup());
  bytes.replace(80, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_TRUE(has(message_of_reading(bytes), "promises 4294967295 triangles"));
}

TEST(StlFile, BinaryNanIsNamedWithItsOffset)
{
  std::string bytes = binary_stl(cube_soup());
  const std::size_t offset = 84 + 50 + 12 + 8;  // second triangle, first corner, z
  bytes.replace(offset, 4, std::string("\0\0\xC0\x7F", 4));
  const std::string message = message_of_reading(bytes);
  EXPECT_TRUE(has(message, "coordinate at byte " + std::to_string(offset))) << message;
}

TEST(StlFile, EmptyForeignAndMissingFilesAreRefused)
{
  EXPECT_TRUE(has(message_of_reading(""), "is empty"));
  EXPECT_TRUE(has(message_of_reading("ISO-10303-21;"), "is not an STL file"));
  EXPECT_TRUE(has(message_of_reading(std::string(500, 'x')), "not an STL file"));
  EXPECT_TRUE(has(message_of_reading("solid nothing\nendsolid\n"), "holds no triangle"));
  EXPECT_TRUE(has(message_of_reading("solid"), "truncated"));
  EXPECT_THROW((void)read_stl("/nonexistent/model.stl"), InputError);
  EXPECT_THROW((void)read_stl("/"), InputError);
}

}  // namespace
}  // namespace tessera::model

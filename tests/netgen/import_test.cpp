// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tessera/base/error.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/temporary_file.hpp"

namespace tessera {
namespace {

using testing::TemporaryFile;

constexpr const char* kBall = "algebraic3d\nsolid ball = sphere (0, 0, 0; 1);\ntlo ball;\n";

// What import says of the file; empty if it takes it.
template <class E>
std::string refusal(const std::filesystem::path& file)
{
  try {
    (void)netgen::import_model(file, {});
  } catch (const E& error) {
    return error.what();
  }
  return {};
}

void expect_in_order(const std::string& text, const std::string& first, const std::string& second)
{
  const auto at = text.find(first);
  EXPECT_NE(at, std::string::npos) << "'" << first << "' is not in: " << text;
  if (at == std::string::npos) return;
  EXPECT_NE(text.find(second, at), std::string::npos) << "'" << second << "' is not in: " << text;
}

TEST(Import, MissingFileIsNamed)
{
  const auto file = std::filesystem::temp_directory_path() / "there_is_no_such.geo";
  expect_in_order(refusal<InputError>(file), "there_is_no_such.geo", "no such file");
}

TEST(Import, FolderIsNamed)
{
  const TemporaryFile file("inner.geo", kBall);
  const auto folder = file.folder() / "folder.geo";
  std::filesystem::create_directory(folder);
  expect_in_order(refusal<InputError>(folder), "folder.geo", "folder");
}

TEST(Import, PipeIsNamedAndNotWaitedFor)
{
  const TemporaryFile file("inner.geo", kBall);
  const auto pipe = file.folder() / "pipe.geo";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_in_order(refusal<InputError>(pipe), "pipe.geo", "pipe");
}

TEST(Import, EmptyFileIsNamed)
{
  const TemporaryFile file("empty.geo", "");
  expect_in_order(refusal<InputError>(file.path()), "empty.geo", "is empty");
}

TEST(Import, UnknownExtensionNamesTheKnownOnes)
{
  const TemporaryFile file("model.obj", "v 0 0 0\n");
  expect_in_order(refusal<InputError>(file.path()), "model.obj", ".geo");
}

TEST(Import, FileWithoutExtensionIsRefused)
{
  const TemporaryFile file("model", kBall);
  EXPECT_FALSE(refusal<InputError>(file.path()).empty());
}

TEST(Import, ExtensionMayBeInCapitals)
{
  const TemporaryFile file("BALL.GEO", kBall);
  EXPECT_EQ(netgen::import_model(file.path(), {}).format, model::Format::csg);
}

TEST(Import, SourceSurvivesTheWayThroughBytes)
{
  const TemporaryFile file("ball.geo", kBall);
  const auto source = netgen::import_model(file.path(), {});
  const auto copy = from_bytes<model::ModelSource>(to_bytes(source));
  EXPECT_EQ(netgen::load_model(copy)->box_diagonal(), netgen::load_model(source)->box_diagonal());
}

TEST(Import, TextThatIsNoGeometryIsRefused)
{
  const TemporaryFile file("poem.geo", "roses are red\n");
  expect_in_order(refusal<InputError>(file.path()), "poem.geo", "algebraic3d");
}

TEST(Import, SyntaxErrorGivesNetgensWords)
{
  const TemporaryFile file("typo.geo", "algebraic3d\nsolid a = sphere (0, 0; 1);\ntlo a;\n");
  expect_in_order(refusal<InputError>(file.path()), "typo.geo", "line 2");
}

TEST(Import, NameAtTheVeryEndDoesNotHang)
{
  const TemporaryFile file("cut.geo", "algebraic3d\nsolid a = sphere (0, 0, 0; 1);\ntlo a");
  expect_in_order(refusal<InputError>(file.path()), "cut.geo", "expected");
}

TEST(Import, ModelWithoutTopLevelObjectSaysHowToNameOne)
{
  const TemporaryFile file("no_tlo.geo", "algebraic3d\nsolid a = sphere (0, 0, 0; 1);\n");
  expect_in_order(refusal<GeometryError>(file.path()), "no_tlo.geo", "tlo");
}

TEST(Import, EmptySolidIsRefused)
{
  const TemporaryFile file("nothing.geo",
                           "algebraic3d\nsolid a = sphere (0, 0, 0; 1) and sphere (9, 0, 0; 1);\n"
                           "tlo a;\n");
  expect_in_order(refusal<GeometryError>(file.path()), "nothing.geo", "empty");
}

TEST(Import, SkippedWordIsReported)
{
  std::string words = kBall;
  const TemporaryFile file("word.geo", words += "colour;\n");
  const auto source = netgen::import_model(file.path(), {});
  ASSERT_FALSE(source.repairs.empty());
  EXPECT_NE(source.repairs.front().find("colour"), std::string::npos) << source.repairs.front();
}

TEST(NetgenVersion, IsANumber)
{
  const std::string version = netgen::netgen_version();
  ASSERT_FALSE(version.empty());
  EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(version.front()))) << version;
}

}  // namespace
}  // namespace tessera

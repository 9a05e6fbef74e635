// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

namespace tessera::config {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMinimal = "[geometry]\nfile = \"shaft.geo\"\n[coarse]\nmax_size = 20\n";

constexpr const char* kEveryKey = R"(
[geometry]
file = "m.stl"
scale = 1e-3
[coarse]
max_size = 2
grading = 0.2
curvature = 3.5
feature_angle_deg = 45
optimize = true
[decompose]
subdomains = 12
[refine]
levels = 4
[fill]
kernel = "subdivide"
timeout_s = 30
memory_gib = 1.5
optimize_steps = 0
grading = 0.7
[improve]
seams = false
rounds = 3

[quality]
min_dihedral_deg = 5
min_mean_ratio = 0.25
[output]
directory = "out dir"
formats = ["pvtu"]
compression = "zlib"
files = 6
cell_quality = true
)";

Case parsed(const std::string& text, const std::vector<std::string>& overrides = {})
{
  return parse_case(text, "/cases/shaft.toml", overrides);
}

TEST(LoadCase, MinimalCaseHasTheDefaultsOfTheOptionStructs)
{
  Case expected;
  expected.geometry.file = "/cases/shaft.geo";
  expected.coarse.max_size = 20.0;
  expected.output.directory = "outputs/shaft";
  EXPECT_EQ(parsed(kMinimal), expected);
}

TEST(LoadCase, EveryKeyReachesItsOwnOption)
{
  const Case loaded = parsed(kEveryKey);
  EXPECT_EQ(loaded.geometry.file, "/cases/m.stl");
  EXPECT_EQ(loaded.geometry.scale, 1e-3);
  EXPECT_EQ(loaded.size.target, 0.0);
  EXPECT_EQ(loaded.coarse.max_size, 2.0);
  EXPECT_EQ(loaded.coarse.grading, 0.2);
  EXPECT_EQ(loaded.coarse.curvature, 3.5);
  EXPECT_EQ(loaded.coarse.feature_angle_deg, 45.0);
  EXPECT_TRUE(loaded.coarse.optimize);
  EXPECT_EQ(loaded.decompose.subdomains, 12);
  EXPECT_EQ(loaded.refine.levels, 4);
  EXPECT_EQ(loaded.fill.kernel, fill::KernelKind::subdivide);
  EXPECT_EQ(loaded.fill.timeout_s, 30.0);
  EXPECT_EQ(loaded.fill.memory_gib, 1.5);
  EXPECT_EQ(loaded.fill.optimize_steps, 0);
  EXPECT_EQ(loaded.fill.grading, 0.7);
  EXPECT_FALSE(loaded.improve.seams);
  EXPECT_EQ(loaded.improve.rounds, 3);
  EXPECT_EQ(loaded.quality.min_dihedral_deg, 5.0);
  EXPECT_EQ(loaded.quality.min_mean_ratio, 0.25);
  EXPECT_EQ(loaded.output.directory, "out dir");
  EXPECT_EQ(loaded.output.formats, std::vector{io::Format::pvtu});
  EXPECT_EQ(loaded.output.compression, io::Compression::zlib);
  EXPECT_EQ(loaded.output.files, 6);
  EXPECT_TRUE(loaded.output.cell_quality);
}

TEST(LoadCase, KernelWordsNameTheirEnumerators)
{
  EXPECT_EQ(parsed(kMinimal, {{"fill.kernel=netgen"}}).fill.kernel, fill::KernelKind::netgen);
  EXPECT_EQ(parsed(kMinimal, {{"fill.kernel=subdivide"}}).fill.kernel, fill::KernelKind::subdivide);
}

TEST(LoadCase, CompressionWordsNameTheirEnumerators)
{
  EXPECT_EQ(parsed(kMinimal, {{"output.compression=none"}}).output.compression,
            io::Compression::none);
  EXPECT_EQ(parsed(kMinimal, {{"output.compression=lz4"}}).output.compression,
            io::Compression::lz4);
}

TEST(LoadCase, SizeTargetStandsInForCoarseSize)
{
  const Case loaded = parsed("geometry.file = 'a.geo'\nsize.target = 0.5");
  EXPECT_EQ(loaded.size.target, 0.5);
  EXPECT_EQ(loaded.coarse.max_size, 0.0);
}

TEST(LoadCase, AutoSubdomainsAreZero)
{
  EXPECT_EQ(parsed(kMinimal, {{"decompose.subdomains=auto"}}).decompose.subdomains, 0);
}

TEST(LoadCase, OverridesWinOverTheFileAndTheLastOneOverTheOthers)
{
  const Case loaded = parsed(kMinimal, {"coarse.max_size=5", " coarse.max_size = 7.5 "});
  EXPECT_EQ(loaded.coarse.max_size, 7.5);
}

TEST(LoadCase, OverrideCanReplaceAValueThatIsWrongInTheFile)
{
  const std::string text = std::string(kMinimal) + "grading = 'steep'\n";
  EXPECT_EQ(parsed(text, {{"coarse.grading=0.5"}}).coarse.grading, 0.5);
}

TEST(LoadCase, OverrideOfTextNeedsNoQuotesButMayHaveThem)
{
  EXPECT_EQ(parsed(kMinimal, {{"geometry.file=a b.geo"}}).geometry.file, "/cases/a b.geo");
  EXPECT_EQ(parsed(kMinimal, {{"geometry.file=\"a b.geo\""}}).geometry.file, "/cases/a b.geo");
  EXPECT_EQ(parsed(kMinimal, {{"geometry.file=x=1 # ü.geo"}}).geometry.file, "/cases/x=1 # ü.geo");
  EXPECT_EQ(parsed(kMinimal, {{"geometry.file=12"}}).geometry.file, "/cases/12");
}

TEST(LoadCase, ModelIsRelativeToTheCaseFileAndAbsoluteModelsStay)
{
  EXPECT_EQ(parsed(kMinimal, {{"geometry.file=../cad/./a.geo"}}).geometry.file, "/cad/a.geo");
  EXPECT_EQ(parsed(kMinimal, {{"geometry.file=/models/a.geo"}}).geometry.file, "/models/a.geo");
  const Case relative = parse_case(kMinimal, "cases/shaft.toml");
  EXPECT_EQ(relative.geometry.file, fs::current_path() / "cases/shaft.geo");
}

TEST(LoadCase, WindowsLineEndsAndByteOrderMarkDoNotMatter)
{
  const Case loaded =
      parsed("\xEF\xBB\xBF[geometry]\r\nfile = 'a.geo'\r\n[coarse]\r\nmax_size = 1\r\n");
  EXPECT_EQ(loaded.geometry.file, "/cases/a.geo");
  EXPECT_EQ(loaded.coarse.max_size, 1.0);
}

TEST(LoadCase, KnownTableWithoutKeysIsNoError)
{
  EXPECT_EQ(parsed(std::string(kMinimal) + "[refine]\n"), parsed(kMinimal));
}

class CaseFiles : public ::testing::Test {
 protected:
  void SetUp() override
  {
    std::string name = (fs::temp_directory_path() / "tessera case ü XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  [[nodiscard]] std::string error_of(const fs::path& file) const
  {
    try {
      (void)load_case(file);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_{};
};

TEST_F(CaseFiles, LoadFromAFolderWithBlanksAndUmlauts)
{
  const Case loaded = load_case(write("größe 1.toml", kMinimal));
  EXPECT_EQ(loaded.geometry.file, folder_ / "shaft.geo");
  EXPECT_EQ(loaded.output.directory, "outputs/größe 1");
}

TEST_F(CaseFiles, UnusableFilesAreNamedWithTheReason)
{
  const fs::path missing = folder_ / "missing.toml";
  EXPECT_EQ(error_of(missing), missing.string() + ": no such case file");
  EXPECT_EQ(error_of(folder_), folder_.string() + ": is a folder, not a case file");
  const fs::path empty = write("empty.toml", " \n");
  EXPECT_EQ(error_of(empty), empty.string() + ": the case file is empty");
  const fs::path binary = write("binary.toml", std::string("\x7f"
                                                           "ELF\0\0",
                                                           6));
  EXPECT_EQ(error_of(binary), binary.string() + ": is a binary file, not a case file (TOML)");
  const fs::path large = write("large.toml", std::string((1U << 16U) + 1, '#'));
  EXPECT_EQ(error_of(large), large.string() + ": is larger than 64 KiB, so it is no case file");
  const fs::path loop = folder_ / "loop.toml";
  fs::create_symlink(loop, loop);
  EXPECT_NE(error_of(loop).find("cannot read the case file: "), std::string::npos);
  EXPECT_NE(error_of("").find("empty"), std::string::npos);
}

TEST_F(CaseFiles, FileInPlaceOfAFolderIsNoSuchFile)
{
  const fs::path inside = write("file.toml", kMinimal) / "case.toml";
  EXPECT_NE(error_of(inside), "no error");
}

}  // namespace
}  // namespace tessera::config

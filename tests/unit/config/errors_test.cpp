// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

namespace tessera::config {
namespace {

constexpr const char* kMinimal = "[geometry]\nfile = \"a.geo\"\n[coarse]\nmax_size = 20\n";

std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {})
{
  try {
    (void)parse_case(text, "case.toml", overrides);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_key(const std::string& line) { return error_of(kMinimal + line + "\n"); }

std::string error_of_override(const std::string& text) { return error_of(kMinimal, {text}); }

bool is_one_clean_line(const std::string& message)
{
  for (const char c : message) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) return false;
  }
  return true;
}

TEST(ConfigErrors, UnknownKeyNamesFileLineAndNearestKey)
{
  EXPECT_EQ(error_of_key("gradin = 0.2"),
            "case.toml:5: unknown key \"coarse.gradin\"; did you mean \"coarse.grading\"? "
            "(configs/reference.toml lists all keys)");
}

TEST(ConfigErrors, RightKeyInWrongTableIsNear)
{
  EXPECT_NE(error_of_key("levels = 2").find("did you mean \"refine.levels\"?"), std::string::npos);
  EXPECT_NE(error_of("max_size = 2").find("did you mean \"coarse.max_size\"?"), std::string::npos);
  EXPECT_NE(error_of_key("[corse]\nmax_size = 2").find("did you mean \"coarse.max_size\"?"),
            std::string::npos);
}

TEST(ConfigErrors, NoKeyIsSuggestedWhenNoneIsNear)
{
  const std::string message = error_of_key("[turbulence]\nviscosity = 3");
  EXPECT_NE(message.find("case.toml:6: unknown key \"turbulence.viscosity\""), std::string::npos);
  EXPECT_EQ(message.find("did you mean"), std::string::npos);
}

TEST(ConfigErrors, UnknownTableIsNamedEvenIfEmpty)
{
  EXPECT_NE(error_of_key("[refinement]").find("case.toml:5: unknown key \"refinement\""),
            std::string::npos);
}

TEST(ConfigErrors, PartsExcludeFiles)
{
  EXPECT_NE(
      error_of_key("[output]\nparts = 2\nfiles = 3").find("output.parts excludes output.files"),
      std::string::npos);
}

TEST(ConfigErrors, WrongTypeNamesTheValueAndWhatIsAllowed)
{
  EXPECT_EQ(error_of("[geometry]\nfile = 3"),
            "case.toml:2: geometry.file = 3: must be a path in quotes, not empty");
  EXPECT_EQ(error_of_key("grading = \"steep\""),
            "case.toml:5: coarse.grading = \"steep\": must be a number > 0 and <= 1");
  EXPECT_EQ(error_of_key("[refine]\nlevels = 1.5"),
            "case.toml:6: refine.levels = 1.5: must be a whole number from 0 to 10");
  EXPECT_EQ(
      error_of_key("[decompose]\nsubdomains = \"all\""),
      "case.toml:6: decompose.subdomains = \"all\": must be a whole number from 1 to 1000000, "
      "or \"auto\"");
  EXPECT_EQ(error_of_key("[output]\ncell_quality = 1"),
            "case.toml:6: output.cell_quality = 1: must be true or false");
  EXPECT_EQ(error_of_key("[output]\ncompression = [\"lz4\", 1]"),
            "case.toml:6: output.compression = [\"lz4\", 1]: must be one of \"none\", \"lz4\", "
            "\"zlib\"");
  EXPECT_EQ(error_of_key("curvature = 1979-05-27"),
            "case.toml:5: coarse.curvature = a date or time: must be a number > 0 and <= 100");
}

TEST(ConfigErrors, NumbersOutsideTheirRangeAreRefused)
{
  for (const char* line :
       {"grading = 0", "grading = 1.01", "grading = nan", "grading = inf", "grading = -inf",
        "curvature = -1", "feature_angle_deg = 180", "[decompose]\nsubdomains = 0",
        "[decompose]\nsubdomains = -4", "[refine]\nlevels = 11", "[refine]\nlevels = -1",
        "[fill]\nmemory_gib = 0", "[fill]\ntimeout_s = -1", "[quality]\nmin_dihedral_deg = 71",
        "[quality]\nmin_mean_ratio = nan"}) {
    EXPECT_NE(error_of_key(line).find("must be a"), std::string::npos) << line;
  }
  // toml11 4 refuses by itself what no number holds.
  for (const char* line : {"curvature = 1e999", "grading = 99999999999999999999"}) {
    const std::string message = error_of_key(line);
    EXPECT_TRUE(message.starts_with("case.toml:5: ")) << message;
    EXPECT_TRUE(message.find("must be a") != std::string::npos
                || message.find("not valid TOML") != std::string::npos)
        << message;
  }
  for (const char* files : {"-1", "1000001", "2.0", "auto"}) {
    EXPECT_NE(error_of_override(std::string("output.files=") + files)
                  .find("must be a whole number from 0 to 1000000"),
              std::string::npos)
        << files;
  }
  for (const char* size : {"0", "-1", "nan", "inf", "1e999"}) {
    EXPECT_NE(
        error_of_override(std::string("coarse.max_size=") + size).find("must be a number > 0"),
        std::string::npos)
        << size;
  }
}

TEST(ConfigErrors, WordListsRefuseUnknownRepeatedAndNoWords)
{
  for (const char* formats : {"[]", R"(["vtk"])", R"(["pvtu", "pvtu"])", R"("pvtu")", "[1]"}) {
    EXPECT_NE(error_of_key(std::string("[output]\nformats = ") + formats).find("must be a list"),
              std::string::npos)
        << formats;
  }
  EXPECT_TRUE(error_of_key("[output]\nformats = [\"vtk\"]")
                  .starts_with("case.toml:6: output.formats = [\"vtk\"]: must be a list without "
                               "repetitions, not empty, of: \"pvtu\", \"xdmf\", \"abaqus\""));
}

TEST(ConfigErrors, AWordThatNoKernelHasIsRefusedWithThoseThatThereAre)
{
  EXPECT_EQ(error_of_override("fill.kernel=tetgen"),
            "--set fill.kernel=tetgen: fill.kernel = \"tetgen\": must be one of \"netgen\", "
            "\"optimize\", \"subdivide\"");
}

TEST(ConfigErrors, TableWrittenAsValueAndValueAsTable)
{
  EXPECT_EQ(error_of("coarse = 3"),
            "case.toml:1: \"coarse\" is a table, not a value: write [coarse] on a line of its own "
            "and its keys below");
  EXPECT_NE(error_of("[coarse.max_size]").find("coarse.max_size = an empty table: must be"),
            std::string::npos);
  EXPECT_NE(error_of("[coarse.max_size]\nvalue = 2").find("did you mean \"coarse.max_size\"?"),
            std::string::npos);
  EXPECT_NE(error_of("[[coarse]]\nmax_size = 2").find("is a table, not a value"),
            std::string::npos);
}

TEST(ConfigErrors, KeyOrTableGivenTwiceNamesBothLines)
{
  EXPECT_EQ(error_of("[coarse]\nmax_size = 2\n\nmax_size = 3\n"),
            "case.toml:4: defined twice (first on line 2): max_size = 3");
  EXPECT_EQ(error_of("[coarse]\nmax_size = 2\n[coarse]\ngrading = 0.3\n"),
            "case.toml:3: defined twice (first on line 1): [coarse]");
}

TEST(ConfigErrors, BrokenTomlNamesItsLineInOneCleanLine)
{
  for (const char* line : {"grading", "grading =", "grading = .5", "grading = 5,0", "= 3", "[fill",
                           "grading = \"0.3", "grading = tru", "a = 1 b = 2", "\x1b[31m", "\x01"}) {
    const std::string message = error_of_key(line);
    EXPECT_TRUE(message.starts_with("case.toml:5: not valid TOML: ")) << message;
    EXPECT_TRUE(is_one_clean_line(message)) << message;
    EXPECT_EQ(message.find("toml::"), std::string::npos) << message;
  }
  EXPECT_TRUE(error_of_key("[output]\nformats = [1,\n 2").starts_with("case.toml:"));
}

TEST(ConfigErrors, EndlessNestingIsRefusedInsteadOfOverflowingTheStack)
{
  const std::string deep(100'000, '[');
  EXPECT_EQ(error_of("a = " + deep), "case.toml: has too many brackets or dots for a case file");
  EXPECT_NE(error_of_override("output.formats=" + deep).find("must be a list"), std::string::npos);
}

TEST(ConfigErrors, AKeyOfEndlessPartsIsRefusedInsteadOfOverflowingTheStack)
{
  std::string key = "a";
  for (int part = 0; part < 30'000; ++part) key += ".a";
  for (const std::string& line : {key + " = 1", "[" + key + "]"}) {
    EXPECT_EQ(error_of(line), "case.toml: has too many brackets or dots for a case file");
  }
}

TEST(ConfigErrors, ALineOfAnyLengthGivesAShortMessage)
{
  const std::string text(60'000, 'x');
  for (const std::string& line :
       {"size = " + text, "[geometry]\nfile = \"" + text, text + " = 1\n" + text + " = 2"}) {
    const std::string message = error_of(line);
    EXPECT_TRUE(message.starts_with("case.toml:")) << message;
    EXPECT_TRUE(is_one_clean_line(message)) << message;
    EXPECT_LT(message.size(), 1000U) << message;
  }
}

TEST(ConfigErrors, BytesThatAreNoUtf8AreRefused)
{
  EXPECT_NE(error_of("[geometry]\nfile = \"gr\xFC\xDF.geo\"").find("case.toml:2: not valid TOML"),
            std::string::npos);
  EXPECT_EQ(error_of("a = 1\nb = {c = 'd\xF5\xFF\xFF\xFF'}"),
            "case.toml:2: not valid TOML: holds bytes that are not UTF-8");
}

TEST(ConfigErrors, AKeyThatHasAnotherNameNowSaysIt)
{
  const std::string text = "geometry.file = 'a.geo'\ncoarse.max_size = 2\ncoarse.defeature = 1\n";
  EXPECT_EQ(
      error_of(text),
      "case.toml:3: coarse.defeature is size.min now: give size.min the value that it has here");
}

TEST(ConfigErrors, ModelAndSizeAreRequired)
{
  EXPECT_EQ(error_of("coarse.max_size = 2"),
            "case.toml: no geometry.file; every case names its CAD model");
  EXPECT_EQ(error_of("geometry.file = 'a.geo'"),
            "case.toml: no size; give either size.target or coarse.max_size");
  EXPECT_NE(error_of("geometry.file = ''").find("not empty"), std::string::npos);
  EXPECT_NE(error_of("# only a comment").find("no geometry.file"), std::string::npos);
}

TEST(ConfigErrors, AMeshNeedsNoSizeAndHasKeysOfItsOwn)
{
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(error_of(text).find(part), std::string::npos) << error_of(text);
  };
  EXPECT_NO_THROW((void)parse_case("geometry.file = 'a.MSH'", "case.toml"));
  EXPECT_NO_THROW((void)parse_case("geometry.file = 'a.vol'\ngeometry.cad = 'a.geo'", "case.toml"));
  says("geometry.file = 'a.msh'\ncoarse.max_size = 1", "coarse.max_size is for a CAD model");
  says("geometry.file = 'a.msh'\ncoarse.mesher = 'gmsh'", "is the coarse mesh");
  says("geometry.file = 'a.msh'\ngeometry.cad = 'b.vtu'", "geometry.cad names a mesh");
  says("geometry.file = 'a.msh'\ngeometry.cad = 'b.stl'\ngeometry.smooth = true", "excludes");
  says("geometry.file = 'a.stl'\ncoarse.max_size = 1\ngeometry.cad = 'b.stl'", "is for a mesh");
  says("geometry.file = 'a.stl'\ncoarse.max_size = 1\ncoarse.mesher = 'gmsh'",
       "leave it out for .stl");
  says("geometry.file = 'a.STL'\ncoarse.max_size = 1\ncoarse.mesher = 'gmsh'",
       "leave it out for .stl");
}

TEST(ConfigErrors, OverridesNameThemselves)
{
  EXPECT_EQ(error_of_override("coarse.grading"),
            "--set coarse.grading: must have the form table.key=value");
  EXPECT_EQ(error_of_override("coarse.gradin=0.2"),
            "--set coarse.gradin=0.2: unknown key \"coarse.gradin\"; did you mean "
            "\"coarse.grading\"? (configs/reference.toml lists all keys)");
  EXPECT_EQ(error_of_override("coarse.grading=7"),
            "--set coarse.grading=7: coarse.grading = 7: must be a number > 0 and <= 1");
  EXPECT_EQ(error_of_override("coarse.grading="),
            "--set coarse.grading=: no value after '='; must be a number > 0 and <= 1");
  EXPECT_EQ(error_of_override("coarse.grading=2O"),
            "--set coarse.grading=2O: coarse.grading = \"2O\": must be a number > 0 and <= 1");
  EXPECT_NE(error_of_override("=3").find("unknown key \"\""), std::string::npos);
  EXPECT_NE(error_of_override("coarse=3").find("unknown key \"coarse\""), std::string::npos);
  EXPECT_TRUE(is_one_clean_line(error_of_override("coarse.grading=1\nfill.grading=2")));
}

}  // namespace
}  // namespace tessera::config

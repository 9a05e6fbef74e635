// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/cli.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/version.hpp"

namespace tessera::pipeline {
namespace {

Command parsed(std::vector<const char*> arguments)
{
  arguments.insert(arguments.begin(), "tessera");
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

template <class Kind>
Kind parsed_as(const std::vector<const char*>& arguments)
{
  return std::get<Kind>(parsed(arguments));
}

std::string error_of(const std::vector<const char*>& arguments)
{
  try {
    (void)parsed(arguments);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CommandLine, MeshNeedsOnlyACase)
{
  const auto mesh = parsed_as<MeshCommand>({"mesh", "a case.toml"});
  EXPECT_EQ(mesh.file, "a case.toml");
  EXPECT_TRUE(mesh.overrides.empty());
  EXPECT_FALSE(mesh.output.has_value());
  EXPECT_FALSE(mesh.overwrite || mesh.resume || mesh.dump_config || mesh.dry_run);
  EXPECT_FALSE(mesh.predicted_ranks.has_value());
  EXPECT_TRUE(mesh.only_subdomains.empty());
  EXPECT_EQ(mesh.progress, ProgressMode::automatic);
  EXPECT_EQ(mesh.verbosity, Verbosity::normal);
}

TEST(CommandLine, MeshTakesAModelWithASize)
{
  EXPECT_FALSE(parsed_as<MeshCommand>({"mesh", "a.toml"}).model.has_value());
  const auto alone = parsed_as<MeshCommand>({"mesh", "a.step", "--size", "0.5"});
  ASSERT_TRUE(alone.model.has_value());
  EXPECT_EQ(alone.model->size, 0.5);
  EXPECT_EQ(alone.model->parts, 0);
  EXPECT_FALSE(alone.model->kernel.has_value());
  const auto all = parsed_as<MeshCommand>(
      {"mesh", "--kernel=optimize", "--parts", "8", "--size", "1e-3", "a.step"});
  EXPECT_EQ(all.model->size, 1e-3);
  EXPECT_EQ(all.model->parts, 8);
  EXPECT_EQ(all.model->kernel, fill::KernelKind::optimize);
}

TEST(CommandLine, RefusesASizeThatIsNone)
{
  for (const char* size : {"0", "-1", "nan", "inf", "1e31", "1 mm", "", "0x1"}) {
    EXPECT_NE(error_of({"mesh", "a.step", "--size", size}).find("number > 0"), std::string::npos)
        << size;
  }
  EXPECT_NE(error_of({"mesh", "a.step", "--parts", "8"}).find("--size"), std::string::npos);
  EXPECT_NE(error_of({"mesh", "a.step", "--kernel", "netgen"}).find("--size"), std::string::npos);
  EXPECT_NE(error_of({"mesh", "a.step", "--size", "1", "--kernel", "gmsh"}).find("subdivide"),
            std::string::npos);
}

TEST(CommandLine, MeshTakesEveryOption)
{
  const auto mesh = parsed_as<MeshCommand>(
      {"mesh", "--set", "a.b=1", "--set=c.d=x y", "case.toml", "--output", "out dir", "--overwrite",
       "--dump-config", "--dry-run", "--ranks", "100000", "--progress", "never", "-v"});
  EXPECT_EQ(mesh.file, "case.toml");
  EXPECT_EQ(mesh.overrides, (std::vector<std::string>{"a.b=1", "c.d=x y"}));
  EXPECT_EQ(mesh.output, "out dir");
  EXPECT_TRUE(mesh.overwrite && mesh.dump_config && mesh.dry_run);
  EXPECT_EQ(mesh.predicted_ranks, 100'000);
  EXPECT_EQ(mesh.progress, ProgressMode::never);
  EXPECT_EQ(mesh.verbosity, Verbosity::verbose);
}

TEST(CommandLine, ResumeExcludesWhatDoesNotGoOn)
{
  EXPECT_TRUE(parsed_as<MeshCommand>({"mesh", "c", "--resume", "--output", "a"}).resume);
  for (const char* other : {"--overwrite", "--dry-run"}) {
    const std::string message = error_of({"mesh", "c", "--resume", other});
    EXPECT_NE(message.find(" excludes "), std::string::npos) << message;
    EXPECT_NE(message.find("--resume"), std::string::npos) << message;
    EXPECT_NE(message.find(other), std::string::npos) << message;
  }
}

TEST(CommandLine, RanksBelongToADryRun)
{
  EXPECT_EQ(parsed_as<MeshCommand>({"mesh", "c", "--ranks=1", "--dry-run"}).predicted_ranks, 1);
  EXPECT_EQ(parsed_as<MeshCommand>({"mesh", "c", "--dry-run", "--ranks", "010"}).predicted_ranks,
            10);
  EXPECT_NE(error_of({"mesh", "c", "--ranks", "4"}).find("--ranks requires --dry-run"),
            std::string::npos);
  for (const char* ranks : {"0", "-1", "1000001", "99999999999", "4.0", "four", "4 ", "0x4"}) {
    const std::string option = std::string("--ranks=") + ranks;
    const std::string message = error_of({"mesh", "c", "--dry-run", option.c_str()});
    EXPECT_NE(message.find(std::string("--ranks ") + ranks
                           + ": must be a whole number from 1 to 1000000"),
              std::string::npos)
        << message;
  }
}

TEST(CommandLine, SubdomainsArriveAscending)
{
  const auto subdomains = [](const char* text) {
    return parsed_as<MeshCommand>({"mesh", "--only-subdomains", text, "c"}).only_subdomains;
  };
  EXPECT_EQ(subdomains("0"), std::vector<LocalIndex>{0});
  EXPECT_EQ(subdomains("17,3,2147483647,0"), (std::vector<LocalIndex>{0, 3, 17, 2147483647}));
}

TEST(CommandLine, SubdomainsThatAreNoListOfNumbersAreRefused)
{
  for (const char* text :
       {"-1", "1,", ",1", "1,,2", "1;2", "1, 2", "a", "2147483648", "1.5", "+1"}) {
    const std::string option = std::string("--only-subdomains=") + text;
    const std::string message = error_of({"mesh", "c", option.c_str()});
    EXPECT_NE(message.find(std::string("--only-subdomains ") + text + ": must be whole numbers"),
              std::string::npos)
        << message;
  }
  EXPECT_NE(error_of({"mesh", "c", "--only-subdomains", "3,1,3"})
                .find("--only-subdomains 3,1,3: names 3 twice"),
            std::string::npos);
}

TEST(CommandLine, OverridesArriveAsTheyWereWritten)
{
  const auto mesh = parsed_as<MeshCommand>(
      {"mesh", "case.toml", "--set", R"(output.formats=["pvtu"])", "--set", "[x,y]", "--set",
       "a.b='q'", "--set", R"(fill.region=[{material="a",kernel="netgen"}])"});
  EXPECT_EQ(mesh.overrides,
            (std::vector<std::string>{R"(output.formats=["pvtu"])", "[x,y]", "a.b='q'",
                                      R"(fill.region=[{material="a",kernel="netgen"}])"}));
}

TEST(CommandLine, QuietAndProgressWords)
{
  EXPECT_EQ(parsed_as<MeshCommand>({"mesh", "c", "-q"}).verbosity, Verbosity::quiet);
  EXPECT_EQ(parsed_as<MeshCommand>({"mesh", "c", "--progress=auto"}).progress,
            ProgressMode::automatic);
  EXPECT_EQ(parsed_as<MeshCommand>({"mesh", "c", "--progress=always"}).progress,
            ProgressMode::always);
}

TEST(CommandLine, CheckAndInfo)
{
  EXPECT_EQ(parsed_as<CheckCommand>({"check", "m.pvtu"}).mesh_file, "m.pvtu");
  EXPECT_FALSE(parsed_as<CheckCommand>({"check", "m.pvtu"}).json);
  EXPECT_TRUE(parsed_as<CheckCommand>({"check", "--json", "m.pvtu"}).json);
  EXPECT_FALSE(parsed_as<CheckCommand>({"check", "m.pvtu"}).is_partial);
  EXPECT_TRUE(parsed_as<CheckCommand>({"check", "--partial", "m.pvtu"}).is_partial);
  EXPECT_EQ(parsed_as<InfoCommand>({"info", "--", "-m.geo"}).file, "-m.geo");
}

TEST(CommandLine, HelpOfEveryLevelIsReturnedNotPrinted)
{
  const std::string all = parsed_as<PrintCommand>({"--help"}).text;
  for (const char* word : {"mesh", "check", "info", "--version"}) {
    EXPECT_NE(all.find(word), std::string::npos) << word;
  }
  const std::string mesh = parsed_as<PrintCommand>({"mesh", "--help"}).text;
  for (const char* word : {"tessera mesh", "CASE.toml|MODEL", "--set", "--output", "--overwrite",
                           "--resume", "--dump-config", "--dry-run", "--ranks", "--only-subdomains",
                           "--progress", "--quiet", "--verbose"}) {
    EXPECT_NE(mesh.find(word), std::string::npos) << word;
  }
  EXPECT_NE(parsed_as<PrintCommand>({"check", "-h"}).text.find("--json"), std::string::npos);
  EXPECT_NE(parsed_as<PrintCommand>({"info", "--help"}).text.find("FILE"), std::string::npos);
}

TEST(CommandLine, VersionIsReturned)
{
  EXPECT_EQ(parsed_as<PrintCommand>({"--version"}).text,
            "tessera " + std::string(version()) + "\n");
}

TEST(CommandLine, WrongUseIsOneLineThatSaysHowToGetHelp)
{
  const std::vector<std::vector<const char*>> wrong{
      {},
      {"polish"},
      {"mesh"},
      {"check"},
      {"info"},
      {"info", "a", "b"},
      {"mesh", "c", "extra"},
      {"mesh", "c", "--set"},
      {"mesh", "c", "--output"},
      {"mesh", "c", "--output", "a", "--output", "b"},
      {"mesh", "c", "--progress", "loud"},
      {"mesh", "c", "-q", "-v"},
      {"mesh", "c", "--resume", "--overwrite"},
      {"mesh", "c", "--ranks", "4"},
      {"mesh", "c", "--dry-run", "--ranks", "x"},
      {"mesh", "c", "--only-subdomains"},
      {"mesh", "c", "--only-subdomains", "1", "--only-subdomains", "2"},
      {"mesh", "c", "--overwrite=perhaps"},
      {"mesh", "c", "check", "m"},
      {"-x"},
  };
  for (const auto& arguments : wrong) {
    const std::string message = error_of(arguments);
    EXPECT_TRUE(message.starts_with("wrong command line: ")) << message;
    EXPECT_NE(message.find("--help`"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(CommandLine, CompareTakesTwoFoldersAndAFile)
{
  const auto compare = parsed_as<CompareCommand>({"compare", "out/a", "out/b"});
  EXPECT_EQ(compare.folder_a, "out/a");
  EXPECT_EQ(compare.folder_b, "out/b");
  EXPECT_EQ(compare.output, "compare.html");
  EXPECT_EQ(parsed_as<CompareCommand>({"compare", "a", "b", "--output", "x.html"}).output,
            "x.html");
  EXPECT_NE(error_of({"compare", "a"}), "no error");
  EXPECT_NE(error_of({"compare", "a", "b", "--output", ""}), "no error");
}

TEST(CommandLine, UnknownCommandsAndOptionsAreNamed)
{
  for (const char* stranger : {"polish", "-x", "--polish"}) {
    EXPECT_NE(error_of({stranger}).find(stranger), std::string::npos);
    EXPECT_NE(error_of({"mesh", "c", stranger}).find(stranger), std::string::npos);
  }
}

TEST(CommandLine, CommandsOfLaterVersionsAreRefused)
{
  EXPECT_NE(error_of({"repartition", "m.pvtu"}), "no error");
}

TEST(DescribeCommandLine, HasTheProgramAndItsCommandsWithWhatTheyTake)
{
  const std::vector<CommandHelp> all = describe_command_line();
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all.front().name, "");
  const CommandHelp& mesh = all[1];
  EXPECT_EQ(mesh.name, "mesh");
  ASSERT_EQ(mesh.arguments.size(), 1U);
  EXPECT_EQ(mesh.arguments.front().value, "CASE.toml|MODEL");
  const auto option = [&](const std::string& name) {
    for (const OptionHelp& candidate : mesh.options) {
      if (candidate.names.back() == name) return candidate;
    }
    return OptionHelp{};
  };
  EXPECT_EQ(option("--progress").value, "auto|always|never");
  EXPECT_EQ(option("--dump-config").value, "");
  EXPECT_EQ(option("--quiet").names.front(), "-q");
  EXPECT_NE(option("--resume").meaning.find("excludes --dry-run, --overwrite"), std::string::npos);
}

}  // namespace
}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/output_folder.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;
using testing::FullDisk;
using testing::message_of;
using testing::TemporaryFolder;

constexpr auto kLock = ".tessera.lock";

[[nodiscard]] std::string refusal(const fs::path& folder, ExistingFolder existing)
{
  return message_of<OutputError>([&] { const OutputFolder output(folder, existing); });
}

/// @brief Makes what a run leaves behind.
void make_earlier_run(const fs::path& folder)
{
  const OutputFolder output(folder, ExistingFolder::refuse);
  for (const char* const sub : {"mesh", "boundary", "pieces", "log", "failure/job_3"}) {
    fs::create_directories(folder / sub);
  }
  for (const char* const file :
       {"mesh.pvtu", "boundary.pvtu", "case.toml", "report.json", "mesh/piece_000000.vtu",
        "mesh/piece_000001.vtu.tmp-12-3", "boundary/piece_000000.vtu", "pieces/piece_000000.record",
        "log/rank_0.txt", "failure/job_3/skin.vtu", "report.json.tmp-4-0"}) {
    testing::write_bytes(folder / file, "x");
  }
}

/// @brief A process that holds the folder until it is told to die.
class Holder {
 public:
  explicit Holder(const fs::path& folder)
  {
    int ready[2];
    if (::pipe(ready) != 0) throw std::runtime_error("no pipe");
    process_ = ::fork();
    if (process_ == 0) {
      const OutputFolder output(folder, ExistingFolder::resume);
      [[maybe_unused]] const ssize_t ignored = ::write(ready[1], "r", 1);
      while (true) ::pause();
    }
    char byte = 0;
    [[maybe_unused]] const ssize_t ignored = ::read(ready[0], &byte, 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Holder() { kill(); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  void kill()
  {
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
    }
    process_ = 0;
  }
  [[nodiscard]] pid_t process() const { return process_; }

 private:
  pid_t process_ = 0;
};

TEST(OutputFolder, IsMadeWithItsParents)
{
  const TemporaryFolder folder;
  const OutputFolder output(folder / "a b/ü/run", ExistingFolder::refuse);
  EXPECT_TRUE(fs::is_directory(folder / "a b/ü/run"));
  EXPECT_EQ(output.path(), folder / "a b/ü/run");
}

TEST(OutputFolder, IsRefusedIfItIsNotEmpty)
{
  const TemporaryFolder folder;
  make_earlier_run(folder / "run");
  fs::remove_all(folder / "run/pieces");
  const std::string message = refusal(folder / "run", ExistingFolder::refuse);
  EXPECT_NE(message.find("not empty"), std::string::npos) << message;
  EXPECT_TRUE(fs::exists(folder / "run/mesh/piece_000000.vtu"));
}

TEST(OutputFolder, OfAnUnfinishedRunNamesBothWaysOn)
{
  const TemporaryFolder folder;
  make_earlier_run(folder / "run");
  const std::string message = refusal(folder / "run", ExistingFolder::refuse);
  EXPECT_NE(message.find("--resume"), std::string::npos) << message;
  EXPECT_NE(message.find("--overwrite"), std::string::npos) << message;
}

TEST(OutputFolder, OfARunThatWroteNothingCountsAsEmpty)
{
  const TemporaryFolder folder;
  {
    const OutputFolder output(folder / "run", ExistingFolder::refuse);
  }
  EXPECT_EQ(refusal(folder / "run", ExistingFolder::refuse), "");
}

TEST(OutputFolder, OverwriteRemovesWhatARunMakesAndKeepsTheRest)
{
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  make_earlier_run(run);
  for (const char* const foreign : {"notes.txt", "mesh/notes.txt", "state.pvsm"}) {
    testing::write_bytes(run / foreign, "mine");
  }
  fs::create_directory(run / "pictures");
  ASSERT_EQ(refusal(run, ExistingFolder::overwrite), "");

  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    left.push_back(entry.path().lexically_relative(run).string());
  }
  std::ranges::sort(left);
  const std::vector<std::string> expected{kLock,       "mesh",     "mesh/notes.txt",
                                          "notes.txt", "pictures", "state.pvsm"};
  EXPECT_EQ(left, expected);
}

TEST(OutputFolder, OverwriteRemovesOtherFormatsAndKeepsWhatSolversAdd)
{
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  make_earlier_run(run);
  fs::create_directory(folder / "elsewhere");
  testing::write_bytes(folder / "elsewhere/polyMesh", "mine");
  for (const char* const made :
       {"mesh_12.msh", "mesh.000003", "mesh_sets.000003", "mesh.exo", "partitioning.2/part.1.nodes",
        "processor0/constant/polyMesh/points", "constant/polyMesh/faces",
        "processor1/constant/polyMesh/points"}) {
    fs::create_directories((run / made).parent_path());
    testing::write_bytes(run / made, "ours");
  }
  for (const char* const foreign : {"mesh_fine.msh", "processor0/0", "system", "mesh.2b"})
    testing::write_bytes(run / foreign, "mine");
  fs::create_directory(run / "processor2");
  fs::create_directory_symlink(folder / "elsewhere", run / "processor2/constant");
  ASSERT_EQ(refusal(run, ExistingFolder::overwrite), "");

  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(run))
    left.push_back(entry.path().lexically_relative(run).string());
  std::ranges::sort(left);
  const std::vector<std::string> expected{
      kLock,          "mesh.2b",    "mesh_fine.msh",       "processor0",
      "processor0/0", "processor2", "processor2/constant", "system"};
  EXPECT_EQ(left, expected);
  EXPECT_TRUE(fs::exists(folder / "elsewhere/polyMesh"));
}

TEST(OutputFolder, OverwriteAndResumeRefuseAFolderThatNoRunHasUsed)
{
  const TemporaryFolder folder;
  for (const char* const name : {"case.toml", "thesis.tex"}) {
    testing::write_bytes(folder / name, "mine");
  }
  for (const ExistingFolder existing : {ExistingFolder::overwrite, ExistingFolder::resume}) {
    const std::string message = refusal(folder.path(), existing);
    EXPECT_NE(message.find("no Tessera run has used it"), std::string::npos) << message;
  }
  EXPECT_EQ(folder.num_entries(), 2U) << "refused, and no lock left in it";
}

TEST(OutputFolder, OfADeadNodeIsThatOfARunWithoutItsLockToo)
{
  const TemporaryFolder folder;
  fs::create_directory(folder / "log");
  for (const char* const name : {"case.toml", "log/run.log"})
    testing::write_bytes(folder / name, "of a run that was killed");
  EXPECT_EQ(refusal(folder.path(), ExistingFolder::resume), "");
  EXPECT_TRUE(fs::exists(folder / "case.toml"));
}

TEST(OutputFolder, ResumeKeepsEverything)
{
  const TemporaryFolder folder;
  make_earlier_run(folder / "run");
  EXPECT_EQ(refusal(folder / "run", ExistingFolder::resume), "");
  EXPECT_TRUE(fs::exists(folder / "run/pieces/piece_000000.record"));
  EXPECT_TRUE(fs::exists(folder / "run/report.json"));
}

TEST(OutputFolder, ResumeRemovesWhatKilledWritersLeft)
{
  const TemporaryFolder folder;
  make_earlier_run(folder / "run");
  EXPECT_EQ(refusal(folder / "run", ExistingFolder::resume), "");
  EXPECT_FALSE(fs::exists(folder / "run/mesh/piece_000001.vtu.tmp-12-3"));
  EXPECT_FALSE(fs::exists(folder / "run/report.json.tmp-4-0"));
  EXPECT_TRUE(fs::exists(folder / "run/mesh/piece_000000.vtu"));
}

TEST(OutputFolder, OverwriteFollowsNoSymbolicLink)
{
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  make_earlier_run(run);
  fs::create_directory(folder / "elsewhere");
  testing::write_bytes(folder / "elsewhere/piece_000000.vtu", "mine");
  testing::write_bytes(folder / "elsewhere/report.json", "mine");
  for (const char* const name : {"mesh", "log", "report.json"}) fs::remove_all(run / name);
  fs::create_directory_symlink(folder / "elsewhere", run / "mesh");
  fs::create_directory_symlink(folder / "elsewhere", run / "log");
  fs::create_directory_symlink(folder / "elsewhere", run / "failure/link");
  fs::create_symlink(folder / "elsewhere/report.json", run / "report.json");

  EXPECT_EQ(refusal(run, ExistingFolder::overwrite), "");
  EXPECT_TRUE(fs::exists(folder / "elsewhere/piece_000000.vtu"));
  EXPECT_TRUE(fs::exists(folder / "elsewhere/report.json"));
  EXPECT_FALSE(fs::exists(fs::symlink_status(run / "mesh")));
  EXPECT_FALSE(fs::exists(run / "failure"));
}

TEST(OutputFolder, ALockThatIsALinkIsRefused)
{
  const TemporaryFolder folder;
  fs::create_directory(folder / "run");
  testing::write_bytes(folder / "precious", "mine");
  fs::create_symlink(folder / "precious", folder / "run" / kLock);
  EXPECT_NE(refusal(folder / "run", ExistingFolder::refuse), "");
  EXPECT_EQ(testing::file_bytes(folder / "precious"), "mine");
}

TEST(OutputFolder, InUseByALivingProcessNamesIt)
{
  const TemporaryFolder folder;
  const Holder holder(folder / "run");
  for (const ExistingFolder existing :
       {ExistingFolder::refuse, ExistingFolder::overwrite, ExistingFolder::resume}) {
    const std::string message = refusal(folder / "run", existing);
    EXPECT_NE(message.find("in use"), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(holder.process())), std::string::npos) << message;
  }
}

TEST(OutputFolder, OfAProcessThatWasKilledIsTakenOver)
{
  const TemporaryFolder folder;
  Holder holder(folder / "run");
  holder.kill();
  EXPECT_NE(testing::file_bytes(folder / "run" / kLock), "") << "it had no time to clean up";
  EXPECT_EQ(refusal(folder / "run", ExistingFolder::resume), "");
}

TEST(OutputFolder, IsFreeAgainWhenItsRunEnds)
{
  const TemporaryFolder folder;
  std::optional<OutputFolder> output(std::in_place, folder / "run", ExistingFolder::refuse);
  EXPECT_NE(refusal(folder / "run", ExistingFolder::refuse), "") << "this very process holds it";
  OutputFolder moved = *std::move(output);
  output.reset();  // NOLINT(bugprone-use-after-move): the folder is moved, not the optional.
  EXPECT_NE(refusal(folder / "run", ExistingFolder::refuse), "") << "moved, not given up";
  moved = OutputFolder(folder / "other", ExistingFolder::refuse);
  EXPECT_EQ(testing::file_bytes(folder / "run" / kLock), "");
  EXPECT_EQ(refusal(folder / "run", ExistingFolder::refuse), "");
}

TEST(OutputFolder, OfAnOwnerOnAnotherHostNamesTheLockToRemove)
{
  const TemporaryFolder folder;
  testing::write_bytes(folder / kLock, "host no-such-host\nprocess 1\nsince 2020\n");
  const std::string message = refusal(folder.path(), ExistingFolder::resume);
  EXPECT_NE(message.find("no-such-host"), std::string::npos) << message;
  EXPECT_NE(message.find((folder / kLock).string()), std::string::npos) << message;
  fs::remove(folder / kLock);
  EXPECT_EQ(refusal(folder.path(), ExistingFolder::resume), "");
}

TEST(OutputFolder, WhoseLockCannotBeWrittenNamesNoStranger)
{
  const TemporaryFolder folder;
  {
    const FullDisk full_disk(6);  // Ends in the name of the host.
    EXPECT_THROW(OutputFolder(folder / "out", ExistingFolder::refuse), OutputError);
  }
  EXPECT_NO_THROW(OutputFolder(folder / "out", ExistingFolder::refuse));
}

TEST(OutputFolder, ThatCannotBeWrittenSaysWhereAndWhy)
{
  const TemporaryFolder folder;
  testing::write_bytes(folder / "file", "");
  for (const fs::path& path : {fs::path("/proc/run"), folder / "file", folder / "file/run"}) {
    const std::string message = refusal(path, ExistingFolder::refuse);
    EXPECT_NE(message.find(path.string() + ": "), std::string::npos) << path << ": " << message;
  }
}

TEST(WriteText, ReplacesTheFileAndLeavesNothingElse)
{
  const TemporaryFolder folder;
  write_text_atomically(folder / "report.json", "{}");
  write_text_atomically(folder / "report.json", "{\"schema\": 1}\n");
  EXPECT_EQ(testing::file_bytes(folder / "report.json"), "{\"schema\": 1}\n");
  EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(WriteText, AFullDiskKeepsTheOlderFile)
{
  const TemporaryFolder folder;
  write_text_atomically(folder / "report.json", "{}");
  {
    const FullDisk full_disk(10);
    const std::string message = message_of<OutputError>(
        [&] { write_text_atomically(folder / "report.json", std::string(100, 'x')); });
    EXPECT_NE(message.find("report.json: "), std::string::npos) << message;
  }
  EXPECT_EQ(testing::file_bytes(folder / "report.json"), "{}");
  EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(OutputFolder, WhatADryRunHasLeftIsInNobodysWay)
{
  const TemporaryFolder folder;
  {
    const OutputFolder output(folder.path(), ExistingFolder::refuse);
    fs::create_directories(folder / "log");
    fs::create_directories(folder / "dry_run/mesh");
    testing::write_bytes(folder / "prediction.json", "x");
  }
  EXPECT_NO_THROW(OutputFolder(folder.path(), ExistingFolder::refuse));
  testing::write_bytes(folder / "mesh.pvtu", "x");
  EXPECT_NE(refusal(folder.path(), ExistingFolder::refuse), "");
  const OutputFolder output(folder.path(), ExistingFolder::overwrite);
  EXPECT_TRUE(fs::exists(folder / "prediction.json")) << "it may be that of the run to come";
  EXPECT_FALSE(fs::exists(folder / "dry_run"));
}

TEST(OutputFolder, AForeignFolderWithNamesOfADryRunIsRefused)
{
  const TemporaryFolder folder;
  fs::create_directories(folder / "log");
  EXPECT_NE(refusal(folder.path(), ExistingFolder::refuse), "");
  EXPECT_NE(refusal(folder.path(), ExistingFolder::overwrite), "");
}

}  // namespace
}  // namespace tessera::io

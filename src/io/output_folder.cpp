// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/output_folder.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "io/atomic_file.hpp"
#include "io/folder_lock.hpp"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

/// Files and folders that a run makes; nothing else is ever removed.
constexpr std::array kRunFiles{
    "mesh.pvtu", "boundary.pvtu", "lines.pvtu",    "case.toml",  "report.json", "report.html",
    "mesh.xdmf", "tets.xdmf",     "boundary.xdmf", "mesh.h5",    "mesh.inp",    "mesh.mesh",
    "mesh.exo",  "mesh.msh",      "mesh_v2.msh",   "mesh.names", "cells.pvtu"};
constexpr std::array kPieceFolders{"mesh", "boundary", "lines", "pieces", "cells"};
constexpr std::array kOwnFolders{"log", "failure", "dry_run"};

/// What a dry run makes: no reason to refuse the run that it predicts. The prediction outlives an
/// overwriting run, for it may be of that one.
constexpr std::array kDryRunNames{"prediction.json", "log", "dry_run", "failure"};

template <class Names>
[[nodiscard]] bool has_name(const Names& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// @brief Whether `name` is a number between `head` and `tail`.
[[nodiscard]] bool is_numbered(std::string_view name, std::string_view head, std::string_view tail)
{
  if (name.size() <= head.size() + tail.size()) return false;
  if (!name.starts_with(head) || !name.ends_with(tail)) return false;
  name.remove_prefix(head.size());
  name.remove_suffix(tail.size());
  return name.find_first_not_of("0123456789") == std::string_view::npos;
}

/// @brief Files of a run, and of other formats with a file a piece.
[[nodiscard]] bool is_run_file(const std::string& name)
{
  return has_name(kRunFiles, name) || is_numbered(name, "mesh_", ".msh")
         || is_numbered(name, "mesh.", "") || is_numbered(name, "mesh_sets.", "");
}

[[noreturn]] void fail(const std::string& what, const fs::path& path, const std::error_code& error)
{
  throw OutputError(fmt::format("{} {}: {}", what, path.string(), error.message()));
}

void make_folder(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error) && !error) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (error) fail("cannot make folder", folder, error);
}

/// @brief The entries of a folder, read to the end before the caller changes any.
[[nodiscard]] std::vector<fs::directory_entry> entries_of(const fs::path& folder)
{
  std::vector<fs::directory_entry> entries;
  std::error_code error;
  fs::directory_iterator at(folder, error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) entries.push_back(*at);
  if (error) fail("cannot read folder", folder, error);
  return entries;
}

/// @brief Whether there is nothing but a lock, or what a dry run has left.
[[nodiscard]] bool holds_no_run(const fs::path& folder)
{
  const bool is_locked = fs::is_regular_file(folder / kLockName);
  return std::ranges::all_of(entries_of(folder), [&](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name == kLockName || (is_locked && has_name(kDryRunNames, name));
  });
}

/// @brief Whether a Tessera run has used the folder, also one whose lock was removed as that of a
/// dead node; one of the files alone could be anyone's.
[[nodiscard]] bool is_of_a_run(const fs::path& folder)
{
  const auto has = [&](const char* name) { return fs::is_regular_file(folder / name); };
  return has(kLockName) || (has("case.toml") && (has("report.json") || has("log/run.log")));
}

void require_usable(const fs::path& folder, ExistingFolder existing)
{
  if (holds_no_run(folder)) return;
  if (!is_of_a_run(folder)) {
    throw OutputError(
        fmt::format("folder {} is not empty and no Tessera run has used it (it has no {}); choose "
                    "another folder, or empty it",
                    folder.string(), kLockName));
  }
  if (existing != ExistingFolder::refuse) return;
  if (fs::exists(folder / "pieces")) {
    throw OutputError(
        fmt::format("folder {} holds a run that is not finished; --resume goes on with it, "
                    "--overwrite replaces what it left there",
                    folder.string()));
  }
  throw OutputError(
      fmt::format("folder {} exists and is not empty; --overwrite replaces what a run left there",
                  folder.string()));
}

/// @brief Removes one file, link (not what it points to) or folder with all that is in it.
void remove_tree(const fs::path& path)
{
  std::error_code error;
  fs::remove_all(path, error);
  if (error) fail("cannot remove", path, error);
}

/// @brief Removes the pieces in a folder, and the folder if nothing else is in it.
void remove_pieces(const fs::path& folder)
{
  for (const fs::directory_entry& entry : entries_of(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_piece = name.ends_with(".record") || is_temporary_name(name)
                          || (name.starts_with("piece_") && name.ends_with(".vtu"));
    if (is_piece && !entry.is_directory()) remove_tree(entry.path());
  }
  std::error_code error;
  fs::remove(folder, error);  // Fails, as it should, when a foreign file is in it.
}

/// @brief Removes what formats with folders of their own have made: Elmer's parts, and of a case of
/// OpenFOAM its meshes, but nothing that a solver has added.
void remove_folder_of_format(const fs::path& folder)
{
  const std::string name = folder.filename().string();
  const bool is_part = is_numbered(name, "partitioning.", "");
  if (!is_part && name != "constant" && !is_numbered(name, "processor", "")) return;
  std::error_code error;  // What is not empty stays.
  if (is_part) {
    for (const fs::directory_entry& entry : entries_of(folder))
      if (entry.path().filename().string().starts_with("part.")) remove_tree(entry.path());
  } else {
    const fs::path constant = name == "constant" ? folder : folder / "constant";
    if (fs::is_symlink(fs::symlink_status(constant))) return;
    remove_tree(constant / "polyMesh");
    fs::remove(constant, error);
  }
  fs::remove(folder, error);
}

void remove_unless_folder(const fs::path& path)
{
  if (!fs::is_directory(fs::symlink_status(path))) remove_tree(path);
}

/// @brief Removes what an earlier run made. A kill meanwhile leaves nothing that a later run could
/// take for more than it is, because the report goes first and the case last. Without a report the
/// run has not ended. Only a folder without a case is one in which nothing has been done.
void remove_earlier_run(const fs::path& folder)
{
  remove_unless_folder(folder / "report.json");
  for (const fs::directory_entry& entry : entries_of(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_folder = entry.is_directory() && !entry.is_symlink();
    if (name == "case.toml") continue;
    if (is_folder) remove_folder_of_format(entry.path());
    if (is_folder && has_name(kPieceFolders, name)) {
      remove_pieces(entry.path());
    } else if (is_folder ? has_name(kOwnFolders, name)
                         : is_run_file(name) || has_name(kPieceFolders, name)
                               || has_name(kOwnFolders, name) || is_temporary_name(name)) {
      remove_tree(entry.path());
    }
  }
  remove_unless_folder(folder / "case.toml");
}

/// @brief Removes what writers that were killed have left half written.
void remove_temporaries(const fs::path& folder)
{
  std::vector<fs::path> folders{folder};
  for (const char* const name : kPieceFolders) {
    if (fs::is_directory(fs::symlink_status(folder / name))) folders.push_back(folder / name);
  }
  for (const fs::path& each : folders) {
    for (const fs::directory_entry& entry : entries_of(each)) {
      if (!entry.is_directory() && is_temporary_name(entry.path().filename().string())) {
        remove_tree(entry.path());
      }
    }
  }
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, ExistingFolder existing) : folder_(std::move(folder))
{
  make_folder(folder_);
  require_usable(folder_, existing);  // Before the lock, which would mark a foreign folder as ours.
  lock_ = std::make_unique<FolderLock>(folder_);
  require_usable(folder_, existing);  // Again: another run may have come and gone in between.
  if (existing == ExistingFolder::overwrite) remove_earlier_run(folder_);
  if (existing == ExistingFolder::resume) remove_half_written();
}

void OutputFolder::remove_half_written() const { remove_temporaries(folder_); }

OutputFolder::~OutputFolder() = default;
OutputFolder::OutputFolder(OutputFolder&&) noexcept = default;
OutputFolder& OutputFolder::operator=(OutputFolder&&) noexcept = default;

}  // namespace tessera::io

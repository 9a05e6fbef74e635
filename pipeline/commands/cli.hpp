// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/io/options.hpp"
#include "tessera/tessera.hpp"

namespace tessera::pipeline {

/// @brief What `tessera mesh` is told of a model that has no case file.
struct ModelCase {
  double size = 0.0;  ///< size.target.
  int parts = 0;      ///< output.parts.
  std::optional<fill::KernelKind> kernel{};
};

/// @brief `tessera mesh`: make a mesh from a case file, or from a model alone.
struct MeshCommand {
  std::filesystem::path file{};                   ///< The case, or the model.
  std::optional<ModelCase> model{};               ///< If any of its options was given.
  std::vector<std::string> overrides{};           ///< "table.key=value", unchecked.
  std::optional<std::filesystem::path> output{};  ///< In place of output.directory.
  bool overwrite = false;                         ///< Use an output folder that is not empty.
  bool resume = false;                            ///< Go on with a run that was stopped.
  bool dump_config = false;                       ///< Print the resolved case and stop.
  bool dry_run = false;                           ///< Predict the run instead of running.
  std::optional<int> predicted_ranks{};           ///< With dry_run; nothing: those that run.
  std::vector<LocalIndex> only_subdomains{};      ///< Ascending; empty: all.
  ProgressMode progress = ProgressMode::automatic;
  Verbosity verbosity = Verbosity::normal;
};

/// @brief `tessera check`: verify a mesh from its files alone.
struct CheckCommand {
  std::filesystem::path mesh_file{};
  bool is_partial = false;  ///< Only some pieces of the mesh were made.
  bool json = false;        ///< Print the keys of report.json instead of text.
};

/// @brief `tessera repartition`: cut a mesh anew into balanced pieces.
struct RepartitionCommand {
  std::filesystem::path mesh_file{};
  std::filesystem::path output{};
  LocalIndex num_parts = 0;
  int num_ghost_layers = 0;
  bool overwrite = false;  ///< Use an output folder that is not empty.
};

/// @brief `tessera convert`: write a mesh in other formats.
struct ConvertCommand {
  std::filesystem::path mesh_file{};
  std::vector<io::Format> formats{};  ///< Not empty, none twice.
  std::filesystem::path output{};
  io::LayerCells layers = io::LayerCells::prisms;
  bool overwrite = false;  ///< Use an output folder that is not empty.
};

/// @brief `tessera info`: say what a model, case or mesh file holds.
struct InfoCommand {
  std::filesystem::path file{};
  bool edges = false;                              ///< Of a model: list its edges as well.
  bool json = false;                               ///< Of a model: print JSON instead of text.
  std::optional<std::filesystem::path> picture{};  ///< Of a model: draw it into this PNG file.
  std::optional<std::filesystem::path> html{};     ///< Of a model or mesh: write a page.
};

/// @brief `tessera compare`: two runs side by side.
struct CompareCommand {
  std::filesystem::path folder_a{};  ///< Output folders.
  std::filesystem::path folder_b{};
  std::filesystem::path output{"compare.html"};
};

/// @brief `tessera replay`: run a job that failed once more, in this process.
struct ReplayCommand {
  std::filesystem::path folder{};  ///< DIR/failure/JOB.
};

/// @brief `--help` or `--version`: print this to standard output and end with exit code 0.
struct PrintCommand {
  std::string text{};
};

using Command = std::variant<MeshCommand, CheckCommand, RepartitionCommand, ConvertCommand,
                             InfoCommand, CompareCommand, ReplayCommand, PrintCommand>;

/// @brief Read the command line. Pure: prints nothing and never ends the process, since every rank
/// parses and only one may speak. Local.
/// @throws ConfigError with one message that says how to get help.
[[nodiscard]] Command parse_command_line(int argc, const char* const* argv);

/// @brief One option or argument of a command, as its help shows it.
struct OptionHelp {
  std::vector<std::string> names{};  ///< "-q", "--quiet"; of an argument none.
  std::string value{};               ///< Placeholder, such as "DIR"; of a flag empty.
  std::string meaning{};
};

/// @brief A command, or with an empty name the program itself, as its help shows it.
struct CommandHelp {
  std::string name{};
  std::string meaning{};
  std::vector<OptionHelp> arguments{};
  std::vector<OptionHelp> options{};
};

/// @brief The program, then its commands, as parse_command_line() knows them: for the man page and
/// the completion of shells. Local.
[[nodiscard]] std::vector<CommandHelp> describe_command_line();

}  // namespace tessera::pipeline

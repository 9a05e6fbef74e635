// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/convert_command.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/formats/export_mesh.hpp"
#include "tessera/io/output_folder.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

void require_file(const ConvertCommand& command)
{
  if (std::filesystem::exists(command.mesh_file)) return;
  throw InputError(command.mesh_file.string() + ": no such file");
}

std::string words_of(const std::vector<io::Format>& formats)
{
  std::vector<std::string_view> words;
  for (const io::Format format : formats) words.push_back(word_of(format));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

ExitCode run_convert_command(const ConvertCommand& command, const comm::Communicator& comm)
{
  const auto start = std::chrono::steady_clock::now();
  std::optional<io::OutputFolder> folder;
  all_or_none(comm, [&] {
    if (comm.rank() != 0) return;
    require_file(command);
    folder.emplace(command.output,
                   command.overwrite ? io::ExistingFolder::overwrite : io::ExistingFolder::refuse);
  });
  const formats::Outline mesh =
      formats::export_mesh({command.mesh_file, command.formats, command.output, command.layers},
                           comm, throw_if_stop_requested);
  if (comm.rank() != 0) return ExitCode::ok;
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  fmt::print("{} {} in {} pieces as {}, {:.1f} s: {}\n", mesh.num_cells(),
             mesh.has_prisms() ? "cells" : "tets", mesh.num_pieces(), words_of(command.formats),
             time.count(), command.output.string());
  return ExitCode::ok;
}

}  // namespace tessera::pipeline

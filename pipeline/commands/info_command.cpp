// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/info_command.hpp"

#include <cstdio>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/config/case.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/model/model.hpp"
#include "tessera/netgen/factory.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/run_context.hpp"
#include "pipeline/runtime/stop_signal.hpp"
#include "pipeline/stages/model_stage.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kInfoLimits{.cpu_s = 600.0, .stall_s = 60.0, .memory_gib = 8.0};

std::string describe_mesh(const std::filesystem::path& file)
{
  GlobalIndex num_points = 0;
  GlobalIndex num_cells = 0;
  std::string names;
  const auto pieces = io::piece_files(file);
  for (const auto& path : pieces) {
    throw_if_stop_requested();
    const mesh::MeshArrays piece = io::read_vtu(path);
    num_points += piece.num_points();
    num_cells += piece.num_cells();
    if (!names.empty()) continue;
    for (const auto& [name, texts] : piece.field_texts) {
      names += fmt::format("{}: {}\n", name, fmt::join(texts, ", "));
    }
  }
  return fmt::format(
      "mesh: {} pieces, {} cells, {} points (shared points counted in every piece)\n{}",
      pieces.size(), num_cells, num_points, names);
}

// The model is read in a job: the CAD libraries may crash on it.
std::string describe_model(const std::filesystem::path& file, jobs::JobRunner& jobs)
{
  netgen::require_model_file(file);
  jobs::JobOutcome read =
      jobs.run(import_request(file, model::ImportOptions{}), kInfoLimits, wait_for_stop_signal());
  const auto source = read_result(read, from_bytes<model::ModelSource>);
  throw_unless_read(read, file);
  throw_unless_read(
      jobs.load(load_model_message(*source, 1.0), kInfoLimits, wait_for_stop_signal()), file);
  jobs::JobOutcome box = jobs.run(box_request(), kInfoLimits, wait_for_stop_signal());
  const auto diagonal = read_result(box, box_diagonal_from_bytes);
  throw_unless_read(box, file);
  std::string text = fmt::format("model: box diagonal {:.6g} {}\n", *diagonal, source->length_unit);
  for (const std::string& repair : source->repairs) text += fmt::format("repair: {}\n", repair);
  return text;
}

std::string describe(const std::filesystem::path& file, jobs::JobRunner& jobs)
{
  std::error_code error;
  if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found) {
    throw InputError(file.string() + ": no such file");
  }
  const std::string extension = file.extension().string();
  if (extension == ".pvtu" || extension == ".vtu") return describe_mesh(file);
  if (extension == ".toml") return config::to_toml(config::load_case(file));
  return describe_model(file, jobs);
}

}  // namespace

ExitCode run_info_command(const InfoCommand& command, const comm::Communicator& comm,
                          jobs::JobRunner& jobs)
{
  const std::string text = on_root(comm, [&] { return describe(command.file, jobs); });
  if (comm.rank() == 0) std::fputs(text.c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace tessera::pipeline

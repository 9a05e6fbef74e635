// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/info_command.hpp"

#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/config/case.hpp"
#include "tessera/io/files.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/model/model.hpp"
#include "tessera/model/options.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/surface/places.hpp"

#include "pipeline/commands/mesh_page.hpp"
#include "pipeline/commands/model_info.hpp"
#include "pipeline/commands/model_page.hpp"
#include "pipeline/drawing/model_picture.hpp"
#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/run_job.hpp"
#include "pipeline/report/places_page.hpp"
#include "pipeline/runtime/stop_signal.hpp"
#include "pipeline/stages/model/model_stage.hpp"
#include "pipeline/stages/model/name_stage.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kInfoLimits{.cpu_s = 180.0, .stall_s = 60.0, .memory_gib = 8.0};

std::string describe_mesh(const std::filesystem::path& file)
{
  GlobalIndex num_points = 0;
  GlobalIndex num_cells = 0;
  std::string names;
  const auto pieces = io::piece_files(file);
  for (const auto& path : pieces) {
    throw_if_stop_requested();
    const mesh::MeshArrays piece = io::read_vtu(path, io::CellOrder::up_to_second);
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

template <class Read>
auto run(const Bytes& request, const Read& read, jobs::JobRunner& jobs)
{
  return read_result(jobs.run(request, kInfoLimits, wait_for_stop_signal()), read);
}

// The model is read in a job: the CAD libraries may crash on it. Solids that overlap are listed,
// not refused.
model::ModelSource read_source(const std::filesystem::path& file, jobs::JobRunner& jobs)
{
  netgen::require_model_file(file);
  return import_in_jobs(file, {.assembly = {.overlap = model::Overlap::first}},
                        [&](const std::string&, const Bytes& request) {
                          return run(request, from_bytes<model::ModelSource>, jobs);
                        });
}

model::ModelDescription describe(const model::ModelSource& source,
                                 const std::filesystem::path& file, jobs::JobRunner& jobs)
{
  require_read(jobs.load(load_model_message(source, 1.0), kInfoLimits, wait_for_stop_signal()),
               file);
  auto described = describe_in_jobs(source.format, [&](const std::string&, const Bytes& request) {
    return run(request, description_from_bytes, jobs);
  });
  require_read(described.end, file);
  return *std::move(described.made);
}

// A page, and no more, of an STL file that bounds no body: the error comes all the same.
void write_places(const InfoCommand& command, const std::string& message, jobs::JobRunner& jobs)
{
  const auto places =
      run(places_request(command.file), from_bytes<surface::SurfacePlaces>, jobs).made;
  if (!places || places->places.empty()) return;
  if (command.html)
    io::write_text_atomically(*command.html, places_page(command.file, message, *places));
  if (command.picture) {
    const Bytes png = to_png(places_picture(*places));
    io::write_text_atomically(*command.picture,
                              {reinterpret_cast<const char*>(png.data()), png.size()});
  }
}

std::string describe_model(const InfoCommand& command, jobs::JobRunner& jobs)
{
  const model::ModelSource source = read_source(command.file, jobs);
  const model::ModelDescription description = describe(source, command.file, jobs);
  if (command.picture) {
    const Bytes png = to_png(draw_model(description));
    io::write_text_atomically(*command.picture,
                              {reinterpret_cast<const char*>(png.data()), png.size()});
  }
  if (command.html) io::write_text_atomically(*command.html, model_page(source, description));
  return command.json ? model_json(source, description)
                      : model_text(source, description, command.edges);
}

std::string describe_any_model(const InfoCommand& command, jobs::JobRunner& jobs)
{
  try {
    return describe_model(command, jobs);
  } catch (const GeometryError& error) {
    const bool is_stl = model::lower_case_extension(command.file) == ".stl";
    if (is_stl && (command.html || command.picture)) write_places(command, error.what(), jobs);
    throw;
  }
}

std::string describe(const InfoCommand& command, jobs::JobRunner& jobs)
{
  const std::filesystem::path& file = command.file;
  std::error_code error;
  if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found) {
    throw InputError(file.string() + ": no such file");
  }
  const std::string extension = file.extension().string();
  const bool is_mesh = extension == ".pvtu" || extension == ".vtu";
  if (!is_mesh && extension != ".toml") return describe_any_model(command, jobs);
  if (command.edges || command.json || command.picture) {
    throw ConfigError(file.string() + ": --edges, --json and --picture are for CAD models");
  }
  if (command.html && !is_mesh) {
    throw ConfigError(file.string() + ": --html is for CAD models and meshes");
  }
  if (command.html) {
    io::write_text_atomically(*command.html, mesh_page(file, throw_if_stop_requested));
  }
  return is_mesh ? describe_mesh(file) : config::to_toml(config::load_case(file));
}

}  // namespace

ExitCode run_info_command(const InfoCommand& command, const comm::Communicator& comm,
                          jobs::JobRunner& jobs)
{
  const std::string text = on_root(comm, [&] { return describe(command, jobs); });
  if (comm.rank() == 0) std::fputs(text.c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/repartition_command.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/version.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/files.hpp"
#include "tessera/io/output_folder.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/periodic_pairs.hpp"
#include "tessera/migrate/assemble.hpp"
#include "tessera/migrate/cut_into_parts.hpp"
#include "tessera/migrate/partition.hpp"
#include "tessera/subdomain/mesh_input.hpp"
#include "tessera/subdomain/part_arrays.hpp"
#include "tessera/subdomain/part_layers.hpp"
#include "tessera/subdomain/part_lines.hpp"
#include "tessera/subdomain/periodic_partners.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/commands/part_report.hpp"
#include "pipeline/runtime/run_context.hpp"
#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

namespace fs = std::filesystem;

// What a solver may rely on.
constexpr double kMaxBalance = 1.03;

Hash128 sum_over_ranks(const Hash128& hash, const comm::Communicator& comm)
{
  std::vector<Hash128> sum{hash};
  comm.sum_in_place(sum);
  return sum.front();
}

// Adds the rows of each pair up.
std::vector<io::SharedPoints> sum_of_pairs(std::vector<io::SharedPoints> rows)
{
  std::ranges::sort(rows);
  std::vector<io::SharedPoints> sums;
  for (const io::SharedPoints& row : rows) {
    if (!sums.empty() && sums.back().piece == row.piece && sums.back().other == row.other) {
      sums.back().num_points += row.num_points;
    } else {
      sums.push_back(row);
    }
  }
  return sums;
}

bool is_inside(const fs::path& path, const fs::path& folder)
{
  const fs::path relative =
      fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(folder));
  return !relative.empty() && *relative.begin() != "..";
}

// One repartition in its folder, which is locked as long as this lives.
class Repartition {
 public:
  Repartition(const RepartitionCommand& command, const comm::Communicator& comm)
      : command_(command), comm_(comm)
  {
    figures_.mesh_file = command.mesh_file.string();
    figures_.num_ranks = comm.size();
    figures_.num_ghost_layers = command.num_ghost_layers;
    migrate::require_partitioner(command.num_parts);
    all_or_none(comm, [&] {
      if (comm.rank() == 0) open_folder();
    });
    comm.barrier();
  }

  ExitCode run()
  {
    try {
      return cut();
    } catch (const comm::ThrownOnAllRanks& thrown) {
      if (comm_.rank() == 0) report_failure(thrown.error());
      throw;
    }
  }

 private:
  void open_folder()
  {
    const fs::path& folder = command_.output;
    if (!fs::exists(command_.mesh_file)) {
      throw InputError(command_.mesh_file.string() + ": no such file");
    }
    if (is_inside(command_.mesh_file, folder)) {
      throw InputError(
          fmt::format("the mesh is in the output folder {}; choose another one", folder.string()));
    }
    folder_.emplace(
        folder, command_.overwrite ? io::ExistingFolder::overwrite : io::ExistingFolder::refuse);
    io::make_own_folder(folder / "mesh");
    io::make_own_folder(folder / "boundary");
  }

  ExitCode cut()
  {
    read();
    const auto columns_of_layers = [this](const migrate::MeshBlock& block) {
      return subdomain::columns_of_layers(block, mesh_.columns);
    };
    migrate::RepartitionResult cut = migrate::cut_into_parts(comm_, std::move(mesh_.mesh),
                                                             {.num_parts = command_.num_parts,
                                                              .max_balance = kMaxBalance,
                                                              .groups_of = columns_of_layers},
                                                             figures_.traffic);
    mesh_.mesh = std::move(cut.mesh);
    figures_.cut = cut.figures;
    end_step("partition");
    measure();
    end_step("measure");
    write();
    end_step("write");
    return finish();
  }

  void read()
  {
    const migrate::MeshPieces pieces =
        subdomain::read_pieces(command_.mesh_file, comm_, throw_if_stop_requested);
    texts_ = subdomain::field_texts_of(pieces, comm_);
    texts_["tessera_version"] = {std::string(version())};
    if (const auto pairs = texts_.find(mesh::kPeriodicPairsName); pairs != texts_.end()) {
      all_or_none(comm_, [&] { static_cast<void>(mesh::periodic_pairs(pairs->second)); });
    }
    end_step("read");
    mesh_ = subdomain::assemble_pieces(command_.mesh_file, pieces, comm_);
    figures_.notes = mesh_.notes;
    lines_ = subdomain::read_lines(command_.mesh_file, comm_);
    figures_.tets_digest = sum_over_ranks(migrate::digest_of_tets(mesh_.mesh), comm_);
    end_step("assemble");
    const GlobalIndex num_tets = comm_.sum(mesh_.mesh.num_tets());
    if (num_tets < command_.num_parts) {
      throw comm::Collective<InputError>(
          fmt::format("--parts {}: the mesh has only {} tets", command_.num_parts, num_tets));
    }
    constexpr auto kMostOnAverage =
        static_cast<GlobalIndex>(subdomain::kMostTetsOfFile / kMaxBalance);
    if (num_tets <= kMostOnAverage * command_.num_parts) return;
    throw comm::Collective<InputError>(
        fmt::format("--parts {}: the mesh has {} tets, and a part's 32-bit indices reach to {}; "
                    "choose more parts",
                    command_.num_parts, num_tets, subdomain::kMostTetsOfFile));
  }

  void measure()
  {
    const migrate::TetNeighbours neighbours = migrate::find_neighbours(comm_, mesh_.mesh);
    figures_.parts = migrate::measure_parts(comm_, mesh_.mesh, neighbours, command_.num_parts);
    GlobalIndex num_owned = 0;
    for (LocalIndex v = 0; v < mesh_.mesh.num_vertices(); ++v) {
      if (mesh_.mesh.owner(v, comm_.rank()) == comm_.rank()) ++num_owned;
    }
    figures_.num_vertices = comm_.sum(num_owned);
    figures_.traffic.num_messages = comm_.sum(figures_.traffic.num_messages);
    figures_.traffic.num_bytes = comm_.sum(figures_.traffic.num_bytes);
    if (sum_over_ranks(migrate::digest_of_tets(mesh_.mesh), comm_) == figures_.tets_digest) return;
    throw comm::Collective<Error>("the migration has lost or changed tets");
  }

  void write()
  {
    const IndexLists vertex_parts = migrate::parts_of_vertices(comm_, mesh_.mesh);
    const subdomain::PartContext context{mesh_.mesh, vertex_parts, mesh_.columns, texts_,
                                         command_.num_ghost_layers};
    const std::vector<migrate::GhostTets> parts = migrate::find_ghosts(
        comm_, mesh_.mesh, vertex_parts, command_.num_parts, command_.num_ghost_layers);
    if (lines_) parts_of_lines_ = subdomain::parts_of_lines(*lines_, mesh_.mesh, comm_);
    if (std::ranges::find(parts_of_lines_, kNoIndex) != parts_of_lines_.end()) {
      throw comm::Collective<InputError>(command_.mesh_file.string()
                                         + ": lines.pvtu has edges that no tet has; `tessera "
                                           "check` says which");
    }
    all_or_none(comm_, [&] {
      for (const migrate::GhostTets& ghosts : parts) write_part(context, ghosts);
    });
    if (texts_.contains(mesh::kPeriodicPairsName)) add_partners();
    const std::vector<io::SharedPoints> neighbours = shared_points(vertex_parts);
    all_or_none(comm_, [&] {
      if (comm_.rank() == 0) write_indices(context, neighbours);
    });
  }

  void add_partners()
  {
    const GlobalIndex num_missing = subdomain::add_periodic_partners(
        boundary_files(command_.output), io::usual_compression(), comm_, throw_if_stop_requested);
    if (num_missing == 0) return;
    figures_.notes.push_back(
        fmt::format("{} points of periodic patches are the image of none", num_missing));
  }

  // Every vertex is counted on the rank that owns it.
  std::vector<io::SharedPoints> shared_points(const IndexLists& vertex_parts) const
  {
    std::map<std::pair<LocalIndex, LocalIndex>, GlobalIndex> counts;
    for (LocalIndex v = 0; v < mesh_.mesh.num_vertices(); ++v) {
      if (mesh_.mesh.owner(v, comm_.rank()) != comm_.rank()) continue;
      const auto parts = vertex_parts[v];
      for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = i + 1; j < parts.size(); ++j) ++counts[{parts[i], parts[j]}];
      }
    }
    std::vector<io::SharedPoints> own;
    for (const auto& [pair, count] : counts) own.push_back({pair.first, pair.second, count});
    return sum_of_pairs(comm_.all_gather_rows(own));
  }

  void write_part(const subdomain::PartContext& context, const migrate::GhostTets& ghosts) const
  {
    throw_if_stop_requested();
    const LocalIndex part = ghosts.part;
    const subdomain::PieceArrays arrays = subdomain::part_arrays(context, part, &ghosts);
    io::write_vtu(arrays.tets, command_.output / subdomain::piece_path("mesh", part),
                  io::usual_compression());
    if (arrays.boundary.num_cells() > 0) {
      io::write_vtu(arrays.boundary, command_.output / subdomain::piece_path("boundary", part),
                    io::usual_compression());
    }
    if (!has_lines(part)) return;
    io::make_own_folder(command_.output / "lines");
    io::write_vtu(subdomain::lines_of_part(*lines_, parts_of_lines_, part, arrays.tets),
                  command_.output / subdomain::piece_path("lines", part), io::usual_compression());
  }

  [[nodiscard]] bool has_lines(LocalIndex part) const
  {
    return std::ranges::find(parts_of_lines_, part) != parts_of_lines_.end();
  }

  [[nodiscard]] std::vector<fs::path> boundary_files(const fs::path& folder) const
  {
    std::vector<fs::path> files;
    for (LocalIndex part = 0; part < command_.num_parts; ++part) {
      if (figures_.parts[at(part)].num_boundary > 0)
        files.push_back(folder / subdomain::piece_path("boundary", part));
    }
    return files;
  }

  void write_indices(const subdomain::PartContext& context,
                     const std::vector<io::SharedPoints>& neighbours) const
  {
    std::vector<fs::path> tets;
    std::vector<fs::path> lines;
    for (LocalIndex part = 0; part < command_.num_parts; ++part) {
      tets.push_back(subdomain::piece_path("mesh", part));
      if (has_lines(part)) lines.push_back(subdomain::piece_path("lines", part));
    }
    constexpr LocalIndex kNoPart = -1;  // Nothing but the names of arrays.
    subdomain::PieceArrays schema = subdomain::part_arrays(context, kNoPart, nullptr);
    subdomain::name_periodic_partners(schema.boundary);
    io::write_pvtu(command_.output / "mesh.pvtu", tets, schema.tets, neighbours);
    io::write_pvtu(command_.output / "boundary.pvtu", boundary_files({}), schema.boundary);
    if (lines.empty()) return;
    io::write_pvtu(command_.output / "lines.pvtu", lines,
                   subdomain::lines_of_part(*lines_, parts_of_lines_, kNoPart, schema.tets));
  }

  ExitCode finish()
  {
    std::string reason;
    if (figures_.largest_part()
        > migrate::largest_allowed(figures_.num_tets(), command_.num_parts, kMaxBalance)) {
      reason = fmt::format("the largest part is {:.3f} of the average", figures_.balance());
    }
    if (figures_.num_disconnected() > 0) {
      figures_.notes.push_back(
          fmt::format("{} parts are not connected", figures_.num_disconnected()));
    }
    const ExitCode code = reason.empty() ? ExitCode::ok : ExitCode::degraded;
    figures_.wall_time_s = seconds_since(start_);
    all_or_none(comm_, [&] {
      if (comm_.rank() != 0) return;
      io::write_text_atomically(command_.output / "report.json",
                                repartition_json(code, reason, figures_));
    });
    if (comm_.rank() == 0) say(reason);
    return code;
  }

  void say(const std::string& reason) const
  {
    if (!reason.empty()) fmt::print(stderr, "tessera: degraded: {}\n", reason);
    for (const std::string& note : figures_.notes) fmt::print("note: {}\n", note);
    fmt::print(
        "{} tets in {} parts, largest {:.4f} of the average, {} triangles cut, {:.1f} s: {}\n",
        figures_.num_tets(), figures_.parts.size(), figures_.balance(),
        figures_.num_cut_triangles(), figures_.wall_time_s, command_.output.string());
  }

  void report_failure(const std::exception& error)
  {
    figures_.wall_time_s = seconds_since(start_);
    figures_.parts.clear();
    try {
      io::write_text_atomically(command_.output / "report.json",
                                repartition_json(exit_code_of(error), error.what(), figures_));
    } catch (const Error& second) {
      fmt::print(stderr, "warning: report.json is missing: {}\n", second.what());
    }
  }

  using Clock = std::chrono::steady_clock;

  [[nodiscard]] static double seconds_since(Clock::time_point begin)
  {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void end_step(const std::string& name)
  {
    throw_if_stopped(comm_);
    figures_.steps.push_back({name, seconds_since(step_start_)});
    step_start_ = Clock::now();
  }

  const RepartitionCommand& command_;
  const comm::Communicator& comm_;
  std::optional<io::OutputFolder> folder_{};
  migrate::AssembledMesh mesh_{};
  std::optional<mesh::MeshArrays> lines_{};
  std::vector<LocalIndex> parts_of_lines_{};
  subdomain::Texts texts_{};
  RepartitionFigures figures_{};
  Clock::time_point start_ = Clock::now();
  Clock::time_point step_start_ = start_;
};

}  // namespace

ExitCode run_repartition_command(const RepartitionCommand& command, const comm::Communicator& comm)
{
  return Repartition(command, comm).run();
}

}  // namespace tessera::pipeline

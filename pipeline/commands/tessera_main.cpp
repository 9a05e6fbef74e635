// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/tessera_main.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/comm/environment.hpp"
#include "tessera/tessera.hpp"

#include "pipeline/commands/check_command.hpp"
#include "pipeline/commands/cli.hpp"
#include "pipeline/commands/compare_command.hpp"
#include "pipeline/commands/convert_command.hpp"
#include "pipeline/commands/info_command.hpp"
#include "pipeline/commands/mesh_command.hpp"
#include "pipeline/commands/repartition_command.hpp"
#include "pipeline/commands/replay_command.hpp"
#include "pipeline/front_door/session.hpp"
#include "pipeline/jobs/node_workers.hpp"
#include "pipeline/runtime/exit_code.hpp"
#include "pipeline/runtime/installed.hpp"
#include "pipeline/runtime/peer_watch.hpp"

namespace tessera::pipeline {
namespace {

void say(const comm::Communicator& comm, const std::string& text)
{
  if (comm.rank() == 0) std::fprintf(stderr, "tessera: %s\n", text.c_str());
}

ExitCode run(const Command& command, const comm::Communicator& comm, jobs::JobRunner& jobs)
{
  if (const auto* print = std::get_if<PrintCommand>(&command)) {
    if (comm.rank() == 0) std::fputs(print->text.c_str(), stdout);
    return ExitCode::ok;
  }
  if (const auto* check = std::get_if<CheckCommand>(&command))
    return run_check_command(*check, comm);
  if (const auto* repartition = std::get_if<RepartitionCommand>(&command)) {
    return run_repartition_command(*repartition, comm);
  }
  if (const auto* convert = std::get_if<ConvertCommand>(&command)) {
    return run_convert_command(*convert, comm);
  }
  if (const auto* info = std::get_if<InfoCommand>(&command)) {
    return run_info_command(*info, comm, jobs);
  }
  if (const auto* compare = std::get_if<CompareCommand>(&command)) {
    return run_compare_command(*compare, comm);
  }
  if (const auto* replay = std::get_if<ReplayCommand>(&command)) {
    return run_replay_command(*replay, comm);
  }
  return run_mesh_command(std::get<MeshCommand>(command), comm, jobs);
}

// Of the commands that answer there; a mesh is in its folder, whatever becomes of the progress.
void require_answered(const Command& command)
{
  const auto* const mesh = std::get_if<MeshCommand>(&command);
  if (std::holds_alternative<RepartitionCommand>(command)) return;
  if (std::holds_alternative<ConvertCommand>(command)) return;
  if (mesh != nullptr && !mesh->dump_config && !mesh->dry_run) return;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw OutputError("cannot write to standard output");
}

// An error that all ranks threw ends the program in order. After any other error the other ranks
// may wait in a collective for ever, so this rank ends them all.
ExitCode run_guarded(int argc, char** argv, const std::function<void(jobs::JobRunner&)>& prepare,
                     const comm::Communicator& comm, jobs::JobRunner& jobs)
{
  try {
    prepare(jobs);
    const Command command = parse_command_line(argc, argv);
    const ExitCode code = run(command, comm, jobs);
    all_or_none(comm, [&] { require_answered(command); });
    return code;
  } catch (const ConfigError& error) {
    say(comm, error.what());
    return ExitCode::wrong_input;
  } catch (const comm::ThrownOnAllRanks& thrown) {
    say(comm, thrown.error().what());
    return exit_code_of(thrown.error());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tessera: internal error on rank %d, please report it: %s\n", comm.rank(),
                 error.what());
    comm.abort(static_cast<int>(ExitCode::internal));
  }
}

// Of a package with MPI inside. Ranks that another MPI has started would each be alone in it.
bool can_use_mpi()
{
  const std::optional<std::filesystem::path> mpi = mpi_inside();
  if (!mpi) return true;
  if (is_rank_of_other_mpi(*mpi)) {
    std::fputs(
        "tessera: this package has an MPI inside, for one machine: start it with "
        "tessera-mpirun, which is beside it. With the MPI of this machine or cluster, use "
        "the package without MPI, or build from the sources\n",
        stderr);
    return false;
  }
  use_mpi_inside(*mpi);
  return true;
}

// By what has started the ranks; 0 if that does not tell.
int rank_of_node_in_environment()
{
  for (const char* const name :
       {"OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID", "SLURM_LOCALID"}) {
    const char* const rank = std::getenv(name);
    if (rank != nullptr) return std::atoi(rank);
  }
  return 0;
}

// Lets the process that jobs are forked from load NETGEN and OpenCASCADE while MPI starts, which
// mostly waits. Not on ranks that will join the process of another one.
void prepare_jobs(int argc, char** argv)
{
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  const bool will_mesh =
      std::ranges::any_of(words, [](std::string_view word) { return word == "mesh"; });
  if (will_mesh && rank_of_node_in_environment() < kFewestRanksThatShare - 1) {
    session_jobs()->prepare();
  }
}

}  // namespace

int tessera_main(int argc, char** argv, const std::function<void(jobs::JobRunner&)>& prepare)
{
  if (!can_use_mpi()) return static_cast<int>(ExitCode::wrong_input);
  const Session session;  // Forks, so before MPI starts.
  prepare_jobs(argc, argv);
  const comm::Environment mpi(argc, argv);
  session.catch_stop_signals();
  const PeerWatch watch(end_without_peer);  // Ends before MPI does.
  const comm::Communicator comm = session.world();
  return static_cast<int>(run_guarded(argc, argv, prepare, comm, *session_jobs()));
}

}  // namespace tessera::pipeline

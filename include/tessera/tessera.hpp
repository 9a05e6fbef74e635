// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/comm/roll_call.hpp"
#include "tessera/config/case.hpp"
#include "tessera/io/output_folder.hpp"
#include "tessera/subdomain/mesh_part.hpp"
#include "tessera/subdomain/read_mesh.hpp"

/// The front door: all that a program needs to make a mesh, and to read its share of one. Errors
/// are exceptions that all ranks throw, each a tessera::Error; see tessera/base/error.hpp.
namespace tessera {

// A rank's share of a mesh in files; needs no Session.
using subdomain::MeshPiece, subdomain::MeshShare;
using subdomain::read_mesh, subdomain::ReadOptions, subdomain::ReadPartition;

/// @brief Makes make_mesh() possible: forks the processes in which NETGEN and OpenCASCADE run, for
/// they may crash or hang. Construct it first thing in main(): before MPI starts, and while the
/// process has one thread. One in a program.
class Session {
 public:
  /// @brief Also starts MPI, and ends it with this object. If a rank has been missing, it ends the
  /// processes of all ranks instead, with what the UsageError said: MPI cannot end without it.
  Session(int& argc, char**& argv);
  /// @brief For a program that starts and ends MPI itself, after this.
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// @brief All ranks. @note Collective. @pre MPI runs, as long as what is returned lives.
  /// @throws UsageError as make_mesh(), if a rank has not called it in `rank_timeout_s`.
  [[nodiscard]] comm::Communicator world(double rank_timeout_s = comm::kRankTimeout_s) const;

  /// @brief From now on SIGINT, SIGTERM and SIGUSR1 end a run in order: make_mesh() throws
  /// Interrupted, and can go on later. A second SIGINT ends the process at once.
  void catch_stop_signals() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @brief How much rank 0 prints. Quiet: warnings and errors only.
enum class Verbosity : int { quiet, normal, verbose };

/// @brief Whether rank 0 draws a bar of its progress. Automatic: on a terminal.
enum class ProgressMode : int { automatic, always, never };

/// @brief Words of `--progress`.
constexpr auto enum_words(ProgressMode /*tag*/)
{
  return std::to_array<EnumWord<ProgressMode>>({
      {ProgressMode::automatic, "auto"},
      {ProgressMode::always, "always"},
      {ProgressMode::never, "never"},
  });
}

/// @brief What make_mesh() is told besides its case.
struct MeshOptions {
  std::string case_name = "case";  ///< In messages and in report.json.
  /// Of output.directory. A finished run of the same case, input and version is not refused: its
  /// result counts, and nothing is made.
  io::ExistingFolder existing = io::ExistingFolder::refuse;
  std::vector<LocalIndex> only_subdomains{};  ///< Ascending; empty: all.
  Verbosity verbosity = Verbosity::quiet;
  ProgressMode progress = ProgressMode::automatic;  ///< Unless quiet.
  /// If set, no mesh files are written, and each finished piece is handed to this. That happens on
  /// the rank that took the piece, in the main thread, one piece at a time, in any order. The
  /// function must not communicate, nor call make_mesh(). If it throws on one rank, the run ends
  /// with an OutputError on all. Set it on all ranks or on none.
  std::function<void(MeshPiece)> on_piece{};
  /// How long this rank waits for the others to call make_mesh() too, seconds; infinity: for ever.
  double rank_timeout_s = comm::kRankTimeout_s;
};

/// @brief How a run ended. Degraded: the mesh is valid, but a target was missed.
enum class MeshStatus : int { ok, degraded };
[[nodiscard]] constexpr MeshStatus last_value(MeshStatus /*type*/) { return MeshStatus::degraded; }

/// @brief What make_mesh() has made; the same on every rank. The folder's report.json says more.
struct MeshResult {
  MeshStatus status = MeshStatus::ok;
  std::string reason{};          ///< Why it is degraded.
  GlobalIndex num_vertices = 0;  ///< Of the whole mesh, all subdomains made or not.
  GlobalIndex num_tets = 0;      ///< As the next three: of what was made.
  LocalIndex num_subdomains = 0;
  double volume = 0.0;             ///< Output length unit cubed.
  std::string digest{};            ///< Order-free hash of all tets, in hexadecimal.
  std::filesystem::path folder{};  ///< With report.json and, without on_piece, mesh.pvtu.

  static auto fields(auto& self)
  {
    return std::tie(self.status, self.reason, self.num_vertices, self.num_tets, self.num_subdomains,
                    self.volume, self.digest, self.folder);
  }
};

/// @brief Does what `tessera mesh` does with a case: the same folder, the same bits.
///
/// The case is checked like a case file, and that of rank 0 counts. Relative paths start at the
/// working directory.
/// @note Collective; one call at a time in a process.
/// @throws on all ranks: UsageError if a rank has no Session; ConfigError, InputError,
/// GeometryError, MeshError, OutputError, Interrupted as `tessera mesh` ends with them. UsageError
/// on those ranks that have called it, if others do not in time: comm::roll_call(). UsageError on
/// this rank, if it is within a make_mesh() already.
[[nodiscard]] MeshResult make_mesh(const config::Case& given, const comm::Communicator& comm,
                                   const MeshOptions& options = {});

}  // namespace tessera

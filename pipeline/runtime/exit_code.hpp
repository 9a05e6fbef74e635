// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "tessera/base/bytes.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::pipeline {

/// @brief How the program ends; the same on every rank. Scripts rely on the numbers.
enum class ExitCode : int {
  ok = 0,
  failed = 2,         ///< No valid mesh; `check`: does not conform.
  degraded = 3,       ///< A valid mesh is saved, but a target was missed or a kernel substituted.
  wrong_input = 64,   ///< Command line, case file or input file.
  internal = 70,      ///< A defect of the program.
  cannot_write = 73,  ///< Permission, disk full, folder in use.
  stopped = 75,       ///< By a signal.
};
[[nodiscard]] constexpr ExitCode last_value(ExitCode /*type*/) { return ExitCode::stopped; }

/// @brief The exit code an exception stands for.
[[nodiscard]] ExitCode exit_code_of(const std::exception& error);

/// @brief The code's name in report.json.
[[nodiscard]] std::string status_name(ExitCode code);

/// @brief Throws the error that `code` and `message` stand for as one that all ranks throw.
/// @pre all ranks call it with the same arguments.
[[noreturn]] void throw_on_all_ranks(ExitCode code, const std::string& message);

/// @brief Runs `work` on this rank; if it throws on any rank, all ranks throw that error (of the
/// lowest rank), else all return. The only way in which a stage does what may fail on one rank.
/// @note Collective.
template <class Work>
void all_or_none(const comm::Communicator& comm, Work&& work)
{
  std::optional<std::string> defect;
  try {
    std::forward<Work>(work)();
  } catch (const comm::ThrownOnAllRanks&) {
    throw;
  } catch (const std::exception& error) {
    defect = std::to_string(static_cast<int>(exit_code_of(error))) + " " + error.what();
  }
  if (const auto first = comm.first_message(defect)) {
    const std::size_t space = first->find(' ');
    throw_on_all_ranks(static_cast<ExitCode>(std::stoi(first->substr(0, space))),
                       first->substr(space + 1));
  }
}

/// @brief What `work` returns on rank 0, on every rank: a value as in bytes.hpp. An error there is
/// one everywhere. Other ranks wait asleep, so that jobs have the cores.
/// @note Collective.
template <class Work>
[[nodiscard]] auto on_root(const comm::Communicator& comm, Work&& work)
{
  using Value = std::remove_cvref_t<std::invoke_result_t<Work>>;
  Bytes bytes;
  std::exception_ptr error;
  if (comm.rank() == 0) {
    try {
      bytes = to_bytes(std::forward<Work>(work)());
    } catch (...) {
      error = std::current_exception();
    }
  }
  comm.quiet_barrier();
  all_or_none(comm, [&] {
    if (error) std::rethrow_exception(error);
  });
  return from_bytes<Value>(comm.broadcast(std::move(bytes), 0));
}

}  // namespace tessera::pipeline

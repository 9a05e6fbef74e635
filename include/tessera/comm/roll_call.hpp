// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <mpi.h>

namespace tessera::comm {

/// @brief How long ranks wait at the front door for one that does not come, unless said otherwise,
/// seconds. Not measured: long against what a rank may have to do before, short against the time
/// that a batch system grants.
inline constexpr double kRankTimeout_s = 600.0;

/// @brief Returns when all ranks have called it. Ranks that wait sleep between looks.
///
/// Without it, a rank that never comes to a collective function makes the others wait for ever. If
/// one has not come in `timeout_s`, those that have ask each other who is there, and all of them
/// throw. One that comes later throws at once, and so does every later roll call on `ranks`: the
/// ranks are no longer at the same point of the program. Only then there are messages between
/// ranks; they have the tag kRollCallTag. Communicators are not freed any more in this process: MPI
/// still waits in them.
/// @note Collective over `ranks`, which is one of the program or of this library.
/// @param[in] function What the ranks are to call, for the message: "make_mesh()".
/// @param[in] timeout_s Seconds, each rank's own; infinity: for ever.
/// @throws UsageError that names the missing ranks, not on all ranks: the missing ones cannot know.
void roll_call(MPI_Comm ranks, const std::string& function, double timeout_s);

/// @brief Tag of what ranks tell each other when one is missing.
inline constexpr int kRollCallTag = 31904;

/// @brief A roll call that has failed in this process.
struct FailedRollCall {
  std::string message{};    ///< Of the UsageError.
  bool is_speaker = false;  ///< Whether this is the lowest of the ranks that came in time.
};

/// @brief The first roll call that has failed in this process, if one has. Local.
[[nodiscard]] const std::optional<FailedRollCall>& failed_roll_call();

}  // namespace tessera::comm

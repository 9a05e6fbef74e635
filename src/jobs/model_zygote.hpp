// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <sys/types.h>

#include "tessera/base/file_descriptor.hpp"

#include "jobs/zygote.hpp"

namespace tessera::jobs {

/// @brief What a model zygote does for all its life: loads into its worker, and forks a process for
/// every job. Ends when the rank closes its socket.
///
/// If the rank opens the door, other ranks of the node join by a local socket. Then each has one
/// job at a time, and a load is done once for all of them.
/// @param first_call Requests with lower numbers were meant for a predecessor that died.
[[noreturn]] void run_model_zygote(pid_t zygote, FileDescriptor data, std::uint32_t first_call,
                                   const MakeWorker& make_worker);

}  // namespace tessera::jobs

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include <sys/types.h>

#include "tessera/base/file_descriptor.hpp"
#include "tessera/jobs/job_runner.hpp"

namespace tessera::jobs {

using MakeWorker = std::function<std::unique_ptr<Worker>()>;

/// @brief The sockets that tie the worker processes to their rank.
struct ZygoteSockets {
  FileDescriptor control{};  ///< rank and zygote: start and end of model zygotes.
  FileDescriptor data{};     ///< rank and model zygote with its jobs: loads, runs, results.
};

/// @brief What the zygote does for all its life: starts a model zygote when asked to, kills it when
/// asked to, reports its end. It stays in the state of the fork, so a model zygote can be replaced.
/// Ends when the rank closes its socket.
[[noreturn]] void run_zygote(pid_t rank_process, ZygoteSockets sockets,
                             const MakeWorker& make_worker);

}  // namespace tessera::jobs

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <spdlog/logger.h>

#include "tessera/comm/communicator.hpp"
#include "tessera/jobs/job_runner.hpp"

namespace tessera::pipeline {

/// With fewer ranks on a node each has a process of its own: two fork faster than one, and the
/// memory is no matter.
inline constexpr int kFewestRanksThatShare = 3;

/// @brief As long as it lives, the jobs of all ranks of a node are forks of one process: the model
/// is in memory once a node. A rank that cannot join keeps a model zygote of its own, and the log
/// says why. What a shared process has loaded is gone at the end.
/// Jobs that are alone have a thread for each rank of the node.
class NodeWorkers {
 public:
  /// @note Collective.
  NodeWorkers(const comm::Communicator& comm, jobs::JobRunner& jobs, spdlog::logger& log);
  ~NodeWorkers();
  NodeWorkers(const NodeWorkers&) = delete;
  NodeWorkers& operator=(const NodeWorkers&) = delete;

 private:
  jobs::JobRunner& jobs_;
  spdlog::logger& log_;
};

}  // namespace tessera::pipeline

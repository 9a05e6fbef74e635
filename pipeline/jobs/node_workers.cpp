// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/node_workers.hpp"

#include <exception>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/bytes.hpp"
#include "tessera/jobs/this_process.hpp"

#include "pipeline/jobs/replaceable_parts.hpp"

namespace tessera::pipeline {
namespace {

// Where the ranks of a node join, or why they cannot.
struct Door {
  std::string name{};
  std::string obstacle{};

  static auto fields(auto& self) { return std::tie(self.name, self.obstacle); }
};

// Why it could not be done; empty if it was.
std::string obstacle_to(const std::function<void()>& work)
{
  try {
    work();
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

// What kept this rank from sharing. Collective over the ranks of a node.
std::string share_workers(const comm::Communicator& node, int rank, jobs::JobRunner& jobs)
{
  const bool is_first = node.rank() == 0;
  Door door;
  if (is_first) door.obstacle = obstacle_to([&] { door.name = jobs.open_to_node(); });
  door = from_bytes<Door>(node.broadcast(is_first ? to_bytes(door) : Bytes{}, 0));
  if (!door.obstacle.empty()) return door.obstacle;
  std::string obstacle;
  if (!is_first) {
    obstacle = obstacle_to([&] {
      replaceable_parts().before_sharing("join", rank);
      jobs.join(door.name);
    });
  }
  node.barrier();
  // If this fails the first load says more.
  if (is_first) static_cast<void>(obstacle_to([&] { jobs.close_to_node(); }));
  return obstacle;
}

}  // namespace

NodeWorkers::NodeWorkers(const comm::Communicator& comm, jobs::JobRunner& jobs, spdlog::logger& log)
    : jobs_(jobs), log_(log)
{
  const comm::Communicator node = comm.ranks_of_node();
  jobs.set_node(node.size(), node.all_gather_rows(jobs::cores_of_this_thread()));
  const bool shares = node.size() >= kFewestRanksThatShare;
  const std::string obstacle = shares ? share_workers(node, comm.rank(), jobs) : std::string();
  const std::vector<std::string> obstacles =
      comm.all_gather_rows(obstacle.empty() ? std::vector<std::string>{} : std::vector{obstacle});
  jobs.prepare();  // The first rank reads the model now.
  if (obstacles.empty()) return;
  log.warn(fmt::format("{} of {} ranks keep the model in a process of their own: {}",
                       obstacles.size(), comm.size(), obstacles.front()));
}

NodeWorkers::~NodeWorkers()
{
  jobs_.set_node(1, {});
  const std::string obstacle = obstacle_to([&] { jobs_.leave_node(); });
  if (!obstacle.empty()) log_.debug(fmt::format("workers of this node: {}", obstacle));
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/share_on_node.hpp"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>
#include <vector>

#include "comm/run_on_root.hpp"

namespace tessera::comm {
namespace {

// What `make` returns, or why it does not.
NodeShare attempt(const std::function<SharedBytes()>& make)
{
  try {
    return {make(), {}};
  } catch (const std::exception& error) {
    return {{}, error.what()};
  }
}

// The first obstacle that any rank of the node has met.
std::string first_obstacle(const Communicator& node, const std::string& mine)
{
  if (node.max(mine.empty() ? 0.0 : 1.0) == 0.0) return {};
  for (const std::string& one : node.all_gather_values(mine)) {
    if (!one.empty()) return one;
  }
  return {};
}

// The first ranks of all nodes, or the second ones, and so on.
Communicator ranks_like(const Communicator& comm, const Communicator& node)
{
  MPI_Comm alike = MPI_COMM_NULL;
  MPI_Comm_split(comm.handle(), node.rank(), comm.rank(), &alike);
  Communicator ranks(alike);
  MPI_Comm_free(&alike);
  return ranks;
}

}  // namespace

NodeShare share_bytes(const Communicator& node, const std::function<SharedBytes()>& make_segment,
                      const std::function<Bytes()>& make_copy,
                      const std::function<void()>& before_mapping)
{
  const bool is_first = node.rank() == 0;
  NodeShare share;
  if (is_first) {
    share = attempt([&] {
      before_mapping();
      return make_segment();
    });
  }
  // The name is of the first rank; without one there is nothing to map.
  const auto name = from_bytes<std::optional<SegmentName>>(
      node.broadcast(is_first ? to_bytes(share.bytes.segment()) : Bytes{}, 0));
  if (!is_first && name) {
    share = attempt([&] {
      before_mapping();
      return SharedBytes::map_segment(*name);
    });
  }
  share.obstacle = first_obstacle(node, share.obstacle);
  if (share.obstacle.empty()) return share;
  share.bytes = {};
  share.bytes = node.broadcast(is_first ? make_copy() : Bytes{}, 0);
  return share;
}

SharedBytes bytes_on_root_of_nodes(const Communicator& comm, const std::function<Bytes()>& work)
{
  const Communicator node = comm.ranks_of_node();
  const Communicator alike = ranks_like(comm, node);
  Bytes bytes = run_on_root(comm, work);
  if (node.rank() == 0) bytes = alike.broadcast(std::move(bytes), 0);
  const auto copy_into = [&](std::span<std::byte> segment) {
    std::ranges::copy(bytes, segment.begin());
  };
  return share_bytes(
             node, [&] { return SharedBytes::make_segment(bytes.size(), copy_into); },
             [&] { return std::move(bytes); }, [] {})
      .bytes;
}

}  // namespace tessera::comm

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>

#include "tessera/base/bytes.hpp"
#include "tessera/base/shared_bytes.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief What share_on_node() gives a rank.
struct NodeShare {
  SharedBytes bytes{};
  std::string obstacle{};  ///< Why this rank's node does not share them; empty if it does.
};

/// @brief The rest of share_on_node(), where only the first rank of a node knows the value.
/// @param[in] make_segment, make_copy  Called on that rank alone.
/// @note Collective over the ranks of one node.
[[nodiscard]] NodeShare share_bytes(const Communicator& node,
                                    const std::function<SharedBytes()>& make_segment,
                                    const std::function<Bytes()>& make_copy,
                                    const std::function<void()>& before_mapping);

/// @brief The bytes of what `work` returns, once a node: its first rank runs `work` and puts them
/// into memory that all ranks of the node map, read-only. If one of them cannot, each has a copy.
///
/// `work` must return the same on every rank, for each node runs its own.
/// @param[in] before_mapping  Runs on every rank before it makes or maps the segment; what it
/// throws counts as an error of the system.
/// @note Collective.
/// @throws on all ranks what `work` throws on any.
template <class Work>
[[nodiscard]] NodeShare share_on_node(const Communicator& comm, Work&& work,
                                      const std::function<void()>& before_mapping)
{
  const Communicator node = comm.ranks_of_node();
  std::optional<std::remove_cvref_t<std::invoke_result_t<Work>>> value;
  all_or_none(comm, [&] {
    if (node.rank() == 0) value.emplace(work());
  });
  return share_bytes(
      node, [&] { return to_segment(*value); }, [&] { return to_bytes(*value); }, before_mapping);
}

/// @brief As on_root_of_nodes(), for bytes. @note Collective.
[[nodiscard]] SharedBytes bytes_on_root_of_nodes(const Communicator& comm,
                                                 const std::function<Bytes()>& work);

/// @brief As on_root(), but the flat arrays of the value stand once a node, read-only: only the
/// first rank of each node gets the bytes, and shares them. Where a node cannot, each rank has a
/// copy.
/// @note Collective.
template <class Work>
[[nodiscard]] auto on_root_of_nodes(const Communicator& comm, Work&& work)
{
  using Value = std::remove_cvref_t<std::invoke_result_t<Work>>;
  return from_shared_bytes<Value>(bytes_on_root_of_nodes(comm, [&] { return to_bytes(work()); }));
}

}  // namespace tessera::comm

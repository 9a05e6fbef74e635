// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <type_traits>

#include "tessera/base/bytes.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief Runs `work` on this rank. If it throws on any rank, all ranks throw the error of the
/// lowest such rank, as a Collective of the same class with the same text. Else all return.
///
/// What `work` throws on all ranks (ThrownOnAllRanks) passes as it is, so calls can be nested. An
/// exception that is not of this library becomes a Collective<Error>.
/// @note Collective; all ranks must reach the collectives within `work`, or none.
void all_or_none(const Communicator& comm, const std::function<void()>& work);

/// @brief As on_root(), for bytes. @note Collective.
[[nodiscard]] Bytes bytes_on_root(const Communicator& comm, const std::function<Bytes()>& work);

/// @brief What `work` returns on rank 0, on every rank: a value as in bytes.hpp. An error there is
/// one everywhere. Other ranks wait asleep, so that jobs have the cores.
/// @note Collective.
template <class Work>
[[nodiscard]] auto on_root(const Communicator& comm, Work&& work)
{
  using Value = std::remove_cvref_t<std::invoke_result_t<Work>>;
  return from_bytes<Value>(bytes_on_root(comm, [&] { return to_bytes(work()); }));
}

}  // namespace tessera::comm

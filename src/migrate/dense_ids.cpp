// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/dense_ids.hpp"

#include <cstdint>
#include <numeric>
#include <utility>

#include "tessera/base/hash.hpp"

namespace tessera::migrate {
namespace {

Hash128 hash_of_id(GlobalIndex id) { return hash_bytes(std::as_bytes(std::span(&id, 1))); }

std::vector<GlobalIndex> numbered(const comm::Communicator& comm, std::size_t num_rows)
{
  std::vector<GlobalIndex> ids(num_rows);
  std::iota(ids.begin(), ids.end(), comm.sum_of_lower_ranks(static_cast<GlobalIndex>(num_rows)));
  return ids;
}

}  // namespace

bool are_dense(const comm::Communicator& comm, std::span<const GlobalIndex> ids)
{
  Hash128 difference;
  for (const GlobalIndex id : ids) difference += hash_of_id(id);
  for (const GlobalIndex id : numbered(comm, ids.size())) difference -= hash_of_id(id);
  std::vector<std::uint64_t> halves{difference.low, difference.high};
  comm.sum_in_place(halves);
  return halves == std::vector<std::uint64_t>{0, 0};
}

std::vector<GlobalIndex> dense_ids(const comm::Communicator& comm,
                                   std::optional<std::vector<GlobalIndex>> ids,
                                   std::size_t num_rows)
{
  const bool all_have = comm.sum(ids ? 0 : 1) == 0;
  if (all_have && are_dense(comm, *ids)) return *std::move(ids);
  return numbered(comm, num_rows);
}

}  // namespace tessera::migrate

// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/consecutive_points.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/bytes.hpp"

namespace tessera::subdomain {
namespace {

// Rows of the points that each other rank owns.
std::vector<std::vector<LocalIndex>> rows_by_owner(const MeshShare& share, Rank rank, int num_ranks)
{
  std::vector<std::vector<LocalIndex>> rows(static_cast<std::size_t>(num_ranks));
  for (LocalIndex row = 0; row < share.num_points(); ++row) {
    const Rank owner = share.point_owner[at(row)];
    if (owner != rank) rows[static_cast<std::size_t>(owner)].push_back(row);
  }
  return rows;
}

std::vector<comm::Message> questions(const MeshShare& share,
                                     const std::vector<std::vector<LocalIndex>>& rows)
{
  std::vector<comm::Message> messages;
  for (std::size_t owner = 0; owner < rows.size(); ++owner) {
    if (rows[owner].empty()) continue;
    std::vector<GlobalIndex> ids;
    for (const LocalIndex row : rows[owner]) ids.push_back(share.point_ids[at(row)]);
    messages.push_back({static_cast<Rank>(owner), to_bytes(ids)});
  }
  return messages;
}

// The numbers of own points in place of their ids.
std::vector<comm::Message> answers(const MeshShare& share, std::vector<comm::Message> asked)
{
  const auto ids =
      std::span(share.point_ids).first(at(share.num_points() - share.num_ghost_points));
  for (comm::Message& message : asked) {
    auto numbers = from_bytes<std::vector<GlobalIndex>>(message.bytes);
    for (GlobalIndex& number : numbers) {
      const auto row = std::ranges::lower_bound(ids, number) - ids.begin();
      number = share.point_numbers[static_cast<std::size_t>(row)];
    }
    message.bytes = to_bytes(numbers);
  }
  return asked;
}

}  // namespace

void number_consecutively(MeshShare& share, const comm::Communicator& comm)
{
  const GlobalIndex num_own = std::ranges::count(share.point_owner, comm.rank());
  share.first_own_number = comm.sum_of_lower_ranks(num_own);
  GlobalIndex next = share.first_own_number;
  share.point_numbers.resize(share.point_ids.size());
  for (std::size_t row = 0; row < share.point_ids.size(); ++row) {
    if (share.point_owner[row] == comm.rank()) share.point_numbers[row] = next++;
  }
  const auto rows = rows_by_owner(share, comm.rank(), comm.size());
  for (const comm::Message& message :
       comm.exchange(answers(share, comm.exchange(questions(share, rows))))) {
    const auto numbers = from_bytes<std::vector<GlobalIndex>>(message.bytes);
    const std::vector<LocalIndex>& asked = rows[static_cast<std::size_t>(message.rank)];
    for (std::size_t i = 0; i < numbers.size(); ++i) share.point_numbers[at(asked[i])] = numbers[i];
  }
}

}  // namespace tessera::subdomain

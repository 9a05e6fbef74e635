// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/entity_key.hpp"
#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief Records that were sent to the ranks that own their keys, and the way back for answers.
template <class Record>
class RecordExchange {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  /// @brief Sends record r to rank `hash(r)` mod size.
  /// @note Collective.
  template <class Hash>
  RecordExchange(std::span<const Record> sent, const Hash& hash, const Communicator& comm)
  {
    const auto num_ranks = static_cast<std::uint64_t>(comm.size());
    destinations_.reserve(sent.size());
    for (const Record& record : sent)
      destinations_.push_back(static_cast<Rank>(hash(record) % num_ranks));

    for (Message& message : comm.exchange(pack(sent, comm.size()))) {
      const std::size_t begin = received_.size();
      received_.resize(begin + message.bytes.size() / sizeof(Record));
      if (!message.bytes.empty())
        std::memcpy(received_.data() + begin, message.bytes.data(), message.bytes.size());
      senders_.push_back({message.rank, begin, received_.size()});
      message.bytes = {};
    }
  }

  [[nodiscard]] std::span<const Record> received() const { return received_; }
  [[nodiscard]] std::vector<Record> take_received() && { return std::move(received_); }

  /// @brief Sends an answer to each received record back.
  /// @note Collective.
  /// @param[in] answers Parallel to received().
  /// @return Answers to this rank's records, in the order in which it sent them.
  template <class Answer>
  [[nodiscard]] std::vector<Answer> answer(std::span<const Answer> answers,
                                           const Communicator& comm) const
  {
    std::vector<Message> messages;
    for (const Sender& sender : senders_) {
      const auto bytes = std::as_bytes(answers.subspan(sender.begin, sender.end - sender.begin));
      messages.push_back({sender.rank, Bytes(bytes.begin(), bytes.end())});
    }
    std::vector<Bytes> from_rank(static_cast<std::size_t>(comm.size()));
    for (Message& message : comm.exchange(std::move(messages)))
      from_rank[static_cast<std::size_t>(message.rank)] = std::move(message.bytes);

    std::vector<std::size_t> next(from_rank.size(), 0);
    std::vector<Answer> own(destinations_.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto rank = static_cast<std::size_t>(destinations_[i]);
      std::memcpy(&own[i], from_rank[rank].data() + next[rank], sizeof(Answer));
      next[rank] += sizeof(Answer);
    }
    return own;
  }

 private:
  struct Sender {
    Rank rank = 0;
    std::size_t begin = 0;  // Of its records among received_.
    std::size_t end = 0;
  };

  // One message for each rank that gets a record.
  [[nodiscard]] std::vector<Message> pack(std::span<const Record> sent, int num_ranks) const
  {
    std::vector<std::size_t> num_records(static_cast<std::size_t>(num_ranks), 0);
    for (const Rank rank : destinations_) ++num_records[static_cast<std::size_t>(rank)];
    std::vector<Bytes> to_rank(num_records.size());
    for (std::size_t r = 0; r < to_rank.size(); ++r)
      to_rank[r].resize(num_records[r] * sizeof(Record));
    std::vector<std::size_t> next(to_rank.size(), 0);
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const auto rank = static_cast<std::size_t>(destinations_[i]);
      std::memcpy(to_rank[rank].data() + next[rank], &sent[i], sizeof(Record));
      next[rank] += sizeof(Record);
    }
    std::vector<Message> messages;
    for (std::size_t r = 0; r < to_rank.size(); ++r)
      if (!to_rank[r].empty()) messages.push_back({static_cast<Rank>(r), std::move(to_rank[r])});
    return messages;
  }

  std::vector<Rank> destinations_{};  // Of the records sent.
  std::vector<Record> received_{};
  std::vector<Sender> senders_{};
};

/// @brief Calls `visit(rows)` for each set of records with equal keys; a set's rows are in the
/// order of `place_of`, which must not depend on who sent them.
template <class Record, class KeyOf, class PlaceOf, class Visit>
void for_each_group(std::span<const Record> records, const KeyOf& key_of, const PlaceOf& place_of,
                    const Visit& visit)
{
  struct Slot {
    std::uint64_t hash;
    std::size_t row;
  };
  std::vector<Slot> slots(records.size());
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i] = {hash_of(key_of(records[i])), i};
  std::sort(slots.begin(), slots.end(), [&](const Slot& a, const Slot& b) {
    if (a.hash != b.hash) return a.hash < b.hash;
    const Record& x = records[a.row];
    const Record& y = records[b.row];
    return std::make_tuple(key_of(x), place_of(x)) < std::make_tuple(key_of(y), place_of(y));
  });

  std::vector<std::size_t> rows;
  for (std::size_t begin = 0, end = 0; begin < slots.size(); begin = end) {
    const auto key = key_of(records[slots[begin].row]);
    rows.clear();
    while (end < slots.size() && slots[end].hash == slots[begin].hash
           && key_of(records[slots[end].row]) == key)
      rows.push_back(slots[end++].row);
    visit(std::span<const std::size_t>(rows));
  }
}

}  // namespace tessera::comm

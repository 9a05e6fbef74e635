// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/entity_key.hpp"
#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief Records that were sent to the ranks that own their keys, and the way back for answers.
/// Records and answers are values of one size, see bytes.hpp.
template <class Record>
class RecordExchange {
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

    std::vector<Message> messages = comm.exchange(pack(sent, comm.size()));
    std::size_t num_bytes = 0;
    for (const Message& message : messages) num_bytes += message.bytes.size();
    received_.reserve(num_bytes / kLeastSize<Record>);
    for (Message& message : messages) {
      const std::size_t begin = received_.size();
      for (ByteReader in(message.bytes); !in.at_end();) received_.push_back(in.get<Record>());
      senders_.push_back({message.rank, begin, received_.size()});
      message.bytes = Bytes();  // An empty list would keep the memory.
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
      messages.push_back({sender.rank, bytes_of(answers, sender)});
    }
    std::vector<Message> from_rank(static_cast<std::size_t>(comm.size()));
    for (Message& message : comm.exchange(std::move(messages)))
      from_rank[static_cast<std::size_t>(message.rank)] = std::move(message);
    std::vector<ByteReader> readers;
    for (const Message& message : from_rank) readers.emplace_back(message.bytes);

    std::vector<Answer> own;
    own.reserve(destinations_.size());
    for (const Rank rank : destinations_)
      own.push_back(readers[static_cast<std::size_t>(rank)].template get<Answer>());
    return own;
  }

 private:
  struct Sender {
    Rank rank = 0;
    std::size_t begin = 0;  // Of its records among received_.
    std::size_t end = 0;
  };

  template <class Answer>
  [[nodiscard]] static Bytes bytes_of(std::span<const Answer> answers, const Sender& sender)
  {
    ByteBuffer buffer((sender.end - sender.begin) * kLeastSize<Answer>);
    for (const Answer& answer : answers.subspan(sender.begin, sender.end - sender.begin))
      ValueWriter(buffer).put(answer);
    return std::move(buffer).take();
  }

  // One message for each rank that gets a record.
  [[nodiscard]] std::vector<Message> pack(std::span<const Record> sent, int num_ranks) const
  {
    std::vector<std::size_t> num_records(static_cast<std::size_t>(num_ranks), 0);
    for (const Rank rank : destinations_) ++num_records[static_cast<std::size_t>(rank)];
    std::vector<ByteBuffer> to_rank;
    for (const std::size_t count : num_records) to_rank.emplace_back(count * kLeastSize<Record>);
    for (std::size_t i = 0; i < sent.size(); ++i)
      ValueWriter(to_rank[static_cast<std::size_t>(destinations_[i])]).put(sent[i]);
    std::vector<Message> messages;
    for (std::size_t r = 0; r < to_rank.size(); ++r)
      if (num_records[r] > 0)
        messages.push_back({static_cast<Rank>(r), std::move(to_rank[r]).take()});
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

// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/vertices.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/comm/record_exchange.hpp"

namespace tessera::check {
namespace {

std::string describe(const VertexRecord& record)
{
  const std::string id = record.id != kNoId ? fmt::format(" (id {})", record.id) : "";
  return fmt::format("{}{}: point {}{} at {}", record.is_listed ? "boundary piece " : "piece ",
                     record.piece, record.point, id, to_text(record.position));
}

Place place_of(const VertexRecord& record) { return {record.piece, record.point}; }

auto order_of(const VertexRecord& r)
{
  return std::make_tuple(r.is_listed, r.piece, r.point, r.id);
}

bool is_same_position(const VertexRecord& a, const VertexRecord& b)
{
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a.position) == std::bit_cast<Bits>(b.position);
}

// Ids of one block go to one rank: a writer numbers in ranges, which are to stay runs.
constexpr int kIdBlockBits = 12;
constexpr std::size_t kMinSlots = 1024;
// Records that a rank compares by position at a time.
constexpr GlobalIndex kPositionsAtOnce = GlobalIndex{1} << 18;

void compare_positions(VertexRecord& first, const VertexRecord& other, Findings& findings)
{
  first.is_shared = first.is_shared || !other.is_listed;
  if (is_same_position(first, other)) return;
  first.is_contradicted = first.is_contradicted || !other.is_listed;
  findings.add(other.is_listed ? Kind::boundary_point : Kind::point_position, place_of(other),
               [&] { return fmt::format("{}; but {}", describe(other), describe(first)); });
}

// Reports a point inside a piece that another piece has as well.
void check_inner(const VertexRecord& first, const VertexRecord& other, Findings& findings)
{
  if (!first.is_inner && !other.is_inner) return;
  findings.add(
      other.is_listed ? Kind::boundary_point : Kind::duplicate_point, place_of(other), [&] {
        return fmt::format("{} is inside another piece: {}", describe(other), describe(first));
      });
}

bool is_on_split(const VertexRecord& vertex) { return vertex.is_on_plus || vertex.is_on_minus; }

// Both sides of a split have a point at each place, be it the same one.
void check_sides(std::span<const VertexRecord> received, std::span<const std::size_t> rows,
                 Findings& findings)
{
  const auto has = [&](bool VertexRecord::*side) {
    return std::ranges::any_of(rows, [&](std::size_t row) { return received[row].*side; });
  };
  const bool has_plus = has(&VertexRecord::is_on_plus);
  if (has_plus == has(&VertexRecord::is_on_minus)) return;
  const VertexRecord& vertex = received[rows[0]];
  findings.add(Kind::split_point, place_of(vertex), [&] {
    return fmt::format(
        "{} is on the {} side of a split patch, and no point of the other side is "
        "at that place",
        describe(vertex), has_plus ? "plus" : "minus");
  });
}

// Reports different ids at one position, but on a split. In a mesh without splits those in one
// piece are reported already.
void compare_ids(std::span<const VertexRecord> received, std::span<const std::size_t> rows,
                 bool has_splits, Findings& findings)
{
  if (has_splits) check_sides(received, rows, findings);
  for (const std::size_t row : rows.subspan(1)) {
    const VertexRecord& first = received[rows[0]];
    const VertexRecord& other = received[row];
    if (first.piece == other.piece && !has_splits) continue;
    if (is_on_split(first) && is_on_split(other)) continue;
    findings.add(Kind::duplicate_point, place_of(other),
                 [&] { return fmt::format("{} and {}", describe(first), describe(other)); });
  }
}

constexpr std::array kFlags{&VertexRecord::is_used,    &VertexRecord::is_inner,
                            &VertexRecord::is_on_seam, &VertexRecord::is_listed,
                            &VertexRecord::is_shared,  &VertexRecord::is_contradicted,
                            &VertexRecord::is_on_plus, &VertexRecord::is_on_minus};

std::uint8_t flags_of(const VertexRecord& record)
{
  unsigned flags = 0;
  for (std::size_t i = 0; i < kFlags.size(); ++i) flags |= (record.*kFlags[i] ? 1U : 0U) << i;
  return static_cast<std::uint8_t>(flags);
}

}  // namespace

VertexMatcher::VertexMatcher(const comm::Communicator& comm, Findings& findings)
    : comm_(comm), findings_(findings), slots_(kMinSlots, kNoIndex)
{
}

void VertexMatcher::add(std::span<const VertexRecord> records, VertexIdentity identity)
{
  identity_ = identity;
  const auto key = [&](const VertexRecord& record) { return key_of(record, identity); };
  const comm::RecordExchange<VertexRecord> exchange(
      records, [&](const VertexRecord& record) { return owner_of(key(record)); }, comm_);
  comm::for_each_group(exchange.received(), key, order_of,
                       [&](std::span<const std::size_t> rows) { take(exchange.received(), rows); });
}

void VertexMatcher::mark_seam(std::span<const VertexKey> keys)
{
  const comm::RecordExchange<VertexKey> exchange(
      keys, [&](const VertexKey& key) { return owner_of(key); }, comm_);
  VertexRecord seam;
  seam.is_on_seam = true;
  for (const VertexKey& key : exchange.received())
    flags_[static_cast<std::size_t>(slots_[slot_of(key)])] |= flags_of(seam);
}

std::vector<VertexFlags> VertexMatcher::flags(std::span<const VertexKey> keys) const
{
  const comm::RecordExchange<VertexKey> exchange(
      keys, [&](const VertexKey& key) { return owner_of(key); }, comm_);
  std::vector<VertexFlags> answers;
  answers.reserve(exchange.received().size());
  for (const VertexKey& key : exchange.received()) {
    const VertexRecord vertex = record(static_cast<std::size_t>(slots_[slot_of(key)]));
    answers.push_back({vertex.is_on_seam, vertex.is_shared, is_on_split(vertex)});
  }
  return exchange.answer(std::span<const VertexFlags>(answers), comm_);
}

VertexTotals VertexMatcher::finish(bool has_splits)
{
  VertexTotals totals;
  if (identity_ == VertexIdentity::ids) totals.ids.reserve(size());
  for (std::size_t row = 0; row < size(); ++row) {
    const VertexRecord vertex = record(row);
    if (vertex.is_used) ++totals.num_vertices;
    if (vertex.is_listed) {
      findings_.add(Kind::boundary_point, place_of(vertex), [&] {
        return fmt::format("{} is no point on the surface of a piece", describe(vertex));
      });
    } else if (identity_ == VertexIdentity::ids) {
      totals.ids.push_back({vertex.id, vertex.piece});
      if (vertex.is_shared) ++totals.num_shared_ids;
      if (vertex.is_contradicted) ++totals.num_contradicted;
    }
  }
  match_positions(has_splits);
  vertices_ = std::deque<Vertex>();  // {} would keep memory.
  flags_ = std::deque<std::uint8_t>();
  slots_ = std::vector<LocalIndex>();
  return totals;
}

VertexRecord VertexMatcher::record(std::size_t row) const
{
  const Vertex& vertex = vertices_[row];
  VertexRecord record{
      .position = vertex.position, .id = vertex.id, .piece = vertex.piece, .point = vertex.point};
  for (std::size_t i = 0; i < kFlags.size(); ++i)
    record.*kFlags[i] = (static_cast<unsigned>(flags_[row]) >> i & 1U) != 0;
  return record;
}

void VertexMatcher::set(std::size_t row, const VertexRecord& record)
{
  vertices_[row] = {record.position, record.id, record.piece, record.point};
  flags_[row] = flags_of(record);
}

std::uint64_t VertexMatcher::owner_of(const VertexKey& key) const
{
  return identity_ == VertexIdentity::ids ? key[0] >> kIdBlockBits : key[0];
}

// Where the vertex is, or the empty slot where it belongs.
std::size_t VertexMatcher::slot_of(const VertexKey& key) const
{
  std::size_t slot = hash_of(key) & (slots_.size() - 1);
  while (slots_[slot] != kNoIndex) {
    const auto row = static_cast<std::size_t>(slots_[slot]);
    if (key_of(vertices_[row], identity_) == key) break;
    slot = (slot + 1) & (slots_.size() - 1);
  }
  return slot;
}

// Doubles the table.
void VertexMatcher::grow()
{
  slots_.assign(2 * slots_.size(), kNoIndex);
  for (std::size_t row = 0; row < vertices_.size(); ++row)
    slots_[slot_of(key_of(vertices_[row], identity_))] = static_cast<LocalIndex>(row);
}

// Rows are of one vertex, those of tets before those of the boundary file.
void VertexMatcher::take(std::span<const VertexRecord> records, std::span<const std::size_t> rows)
{
  const std::size_t slot = slot_of(key_of(records[rows[0]], identity_));
  const bool is_new = slots_[slot] == kNoIndex;
  if (is_new) {
    slots_[slot] = static_cast<LocalIndex>(vertices_.size());
    vertices_.emplace_back();
    flags_.push_back(0);
  }
  const auto at = static_cast<std::size_t>(slots_[slot]);
  VertexRecord first = is_new ? records[rows[0]] : record(at);
  for (const std::size_t row : rows.subspan(is_new ? 1 : 0)) take(first, records[row]);
  set(at, first);
  if (4 * vertices_.size() > 3 * slots_.size()) grow();
}

void VertexMatcher::take(VertexRecord& first, const VertexRecord& other)
{
  const bool is_used = first.is_used || other.is_used;
  const bool is_on_seam = first.is_on_seam || other.is_on_seam;
  first.is_used = is_used;
  first.is_on_seam = is_on_seam;
  first.is_on_plus = first.is_on_plus || other.is_on_plus;
  first.is_on_minus = first.is_on_minus || other.is_on_minus;
  if (identity_ == VertexIdentity::ids)
    compare_positions(first, other, findings_);
  else
    first.is_shared = first.is_shared || !other.is_listed;
  check_inner(first, other, findings_);
}

// In several rounds, so that only a part of the vertices is sent at a time.
void VertexMatcher::match_positions(bool has_splits)
{
  if (identity_ != VertexIdentity::ids) return;
  const auto most = comm_.max(static_cast<double>(vertices_.size()));
  const auto num_rounds = 1 + static_cast<std::uint64_t>(most) / kPositionsAtOnce;
  const auto key = [](const VertexRecord& record) { return key_of_position(record.position); };
  for (std::uint64_t round = 0; round < num_rounds; ++round) {
    std::vector<VertexRecord> sent;
    for (std::size_t row = 0; row < size(); ++row)
      if (key_of_position(vertices_[row].position)[1] % num_rounds == round
          && !record(row).is_listed)
        sent.push_back(record(row));
    const comm::RecordExchange<VertexRecord> exchange(
        sent, [&](const VertexRecord& record) { return key(record)[0]; }, comm_);
    comm::for_each_group(exchange.received(), key, order_of,
                         [&](std::span<const std::size_t> rows) {
                           compare_ids(exchange.received(), rows, has_splits, findings_);
                         });
  }
}

}  // namespace tessera::check

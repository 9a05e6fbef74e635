// SPDX-License-Identifier: BSD-3-Clause
#include "check/match_vertices.hpp"

#include <array>
#include <bit>
#include <string>
#include <tuple>

#include "check/concat.hpp"
#include "check/record_exchange.hpp"

namespace tessera::check {
namespace {

std::string describe(const VertexRecord& record)
{
  const std::string id = record.id != kNoId ? concat(" (id ", record.id, ")") : "";
  return concat(record.is_listed ? "boundary piece " : "piece ", record.piece, ": point ",
                record.point, id, " at ", to_text(record.position));
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

class VertexMatcher {
 public:
  VertexMatcher(std::span<const VertexRecord> records, Identity identity, Findings& findings)
      : records_(records), identity_(identity), findings_(findings), is_on_seam_(records.size(), 0)
  {
  }

  // Rows of the points of the mesh come before those of the boundary file.
  void match(std::span<const std::size_t> rows)
  {
    const VertexRecord& first = records_[rows[0]];
    bool is_used = false;
    std::uint8_t is_on_seam = 0;
    for (const std::size_t row : rows) {
      is_used = is_used || records_[row].is_used;
      if (records_[row].is_on_seam) is_on_seam = 1;
    }
    for (const std::size_t row : rows) is_on_seam_[row] = is_on_seam;
    if (is_used) ++match_.num_vertices;
    if (first.is_listed) {
      report_stranger(first);
    } else {
      compare_positions(rows);
      check_inner(rows);
      if (identity_ == Identity::kIds) {
        match_.ids.push_back({first.id, first.piece});
        representatives_.push_back(first);
      }
    }
  }

  [[nodiscard]] std::span<const std::uint8_t> is_on_seam() const { return is_on_seam_; }
  [[nodiscard]] std::span<const VertexRecord> representatives() const { return representatives_; }
  [[nodiscard]] VertexMatch take() && { return std::move(match_); }

 private:
  void report_stranger(const VertexRecord& listed)
  {
    findings_.add(Kind::kBoundaryPoint, place_of(listed), [&] {
      return concat(describe(listed), " is no point on the surface of a piece");
    });
  }

  void compare_positions(std::span<const std::size_t> rows)
  {
    if (identity_ != Identity::kIds) return;
    const VertexRecord& first = records_[rows[0]];
    bool is_shared = false;
    bool is_contradicted = false;
    for (const std::size_t row : rows.subspan(1)) {
      const VertexRecord& other = records_[row];
      is_shared = is_shared || !other.is_listed;
      if (is_same_position(first, other)) continue;
      is_contradicted = is_contradicted || !other.is_listed;
      findings_.add(other.is_listed ? Kind::kBoundaryPoint : Kind::kPointPosition, place_of(other),
                    [&] { return concat(describe(other), "; but ", describe(first)); });
    }
    if (is_shared) ++match_.num_shared_ids;
    if (is_contradicted) ++match_.num_contradicted;
  }

  // A point inside a piece that another piece has as well.
  void check_inner(std::span<const std::size_t> rows)
  {
    for (const std::size_t row : rows.subspan(1)) {
      const VertexRecord& first = records_[rows[0]];
      const VertexRecord& other = records_[row];
      if (!first.is_inner && !other.is_inner) continue;
      findings_.add(
          other.is_listed ? Kind::kBoundaryPoint : Kind::kDuplicatePoint, place_of(other),
          [&] { return concat(describe(other), " is inside another piece: ", describe(first)); });
    }
  }

  std::span<const VertexRecord> records_;
  Identity identity_;
  Findings& findings_;
  std::vector<std::uint8_t> is_on_seam_;
  std::vector<VertexRecord> representatives_{};  // One for each id.
  VertexMatch match_{};
};

// Reports different ids at one position in different pieces; those in one piece it has reported.
void match_positions(std::span<const VertexRecord> representatives, const comm::Communicator& comm,
                     Findings& findings)
{
  const auto key = [](const VertexRecord& record) { return key_of_position(record.position); };
  const RecordExchange<VertexRecord> exchange(
      representatives, [&](const VertexRecord& record) { return hash_of(key(record)); }, comm);
  const std::span<const VertexRecord> received = exchange.received();
  for_each_group(received, key, order_of, [&](std::span<const std::size_t> rows) {
    for (const std::size_t row : rows.subspan(1)) {
      const VertexRecord& first = received[rows[0]];
      const VertexRecord& other = received[row];
      if (first.piece == other.piece) continue;
      findings.add(Kind::kDuplicatePoint, place_of(other),
                   [&] { return concat(describe(first), " and ", describe(other)); });
    }
  });
}

}  // namespace

VertexMatch match_vertices(std::span<const VertexRecord> records, Identity identity,
                           const comm::Communicator& comm, Findings& findings)
{
  const auto key = [&](const VertexRecord& record) { return key_of(record, identity); };
  const RecordExchange<VertexRecord> exchange(
      records, [&](const VertexRecord& record) { return hash_of(key(record)); }, comm);
  VertexMatcher matcher(exchange.received(), identity, findings);
  for_each_group(exchange.received(), key, order_of,
                 [&](std::span<const std::size_t> rows) { matcher.match(rows); });
  match_positions(matcher.representatives(), comm, findings);
  const auto is_on_seam = exchange.answer(matcher.is_on_seam(), comm);
  VertexMatch match = std::move(matcher).take();
  match.is_on_seam = is_on_seam;
  return match;
}

}  // namespace tessera::check

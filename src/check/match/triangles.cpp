// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/triangles.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace tessera::check {
namespace {

std::string describe(const TriangleRecord& record)
{
  const Vec3 near{record.centroid[0], record.centroid[1], record.centroid[2]};
  if (record.is_listed) {
    return fmt::format("triangle {} of boundary piece {} near {}", record.cell, record.piece,
                       to_text(near));
  }
  const std::string id = record.cell_id != kNoId ? fmt::format(" (id {})", record.cell_id) : "";
  return fmt::format("cell {}{} of piece {} near {}", record.cell, id, record.piece, to_text(near));
}

Place place_of(const TriangleRecord& record) { return {record.piece, record.cell}; }

// What two sides make of a triangle.
template <class Side>
TriangleRole role_between(const Side& a, const Side& b)
{
  if (a.is_odd == b.is_odd) return TriangleRole::faulty;
  if (a.attribute != b.attribute) return TriangleRole::interface;
  return a.subdomain == b.subdomain ? TriangleRole::inner : TriangleRole::seam;
}

// All records of one triangle: first its sides, then its occurrences in the boundary file.
class TriangleGroup {
 public:
  TriangleGroup(std::span<const TriangleRecord> records, std::span<const std::size_t> rows)
      : records_(records), rows_(rows)
  {
    while (num_sides_ < rows.size() && !records[rows[num_sides_]].is_listed) ++num_sides_;
  }

  [[nodiscard]] std::size_t num_sides() const { return num_sides_; }
  [[nodiscard]] std::size_t num_listed() const { return rows_.size() - num_sides_; }
  [[nodiscard]] const TriangleRecord& side(std::size_t i) const { return records_[rows_[i]]; }
  [[nodiscard]] const TriangleRecord& listed(std::size_t i) const
  {
    return records_[rows_[num_sides_ + i]];
  }

  [[nodiscard]] TriangleRole role(BoundaryFile boundary) const
  {
    if (num_sides_ == 1) {
      return boundary == BoundaryFile::partial && num_listed() == 0 ? TriangleRole::open_seam
                                                                    : TriangleRole::outside;
    }
    return num_sides_ == 2 ? role_between(side(0), side(1)) : TriangleRole::faulty;
  }

 private:
  std::span<const TriangleRecord> records_;
  std::span<const std::size_t> rows_;
  std::size_t num_sides_ = 0;
};

// @param is_late Two tets on both sides were there before.
void report_fault(const TriangleGroup& group, bool is_late, Findings& findings)
{
  findings.add(Kind::triangle, place_of(group.side(0)), [&] {
    std::string text = !is_late && group.num_sides() == 2 ? "triangle has two tets on one side:"
                                                          : "triangle has more than two tets:";
    for (std::size_t i = 0; i < group.num_sides(); ++i)
      text += fmt::format(" {};", describe(group.side(i)));
    return text;
  });
}

// A triangle of the boundary file against the side whose tet it names.
void check_listed(const TriangleRecord& listed, const TriangleRecord& side, Findings& findings)
{
  const auto report = [&](Kind kind, const std::string& what) {
    findings.add(kind, place_of(listed), [&] {
      return fmt::format("{} {}; the tet behind it is {}", describe(listed), what, describe(side));
    });
  };
  if (listed.cell_id != kNoId && side.cell_id != kNoId && listed.cell_id != side.cell_id)
    report(Kind::boundary_tet, fmt::format("names tet {}", listed.cell_id));
  if (listed.is_odd != side.is_odd) report(Kind::boundary_orientation, "points inwards");
  if (listed.subdomain != kNoSubdomain && listed.subdomain != side.subdomain)
    report(Kind::boundary_subdomain, fmt::format("names subdomain {}", listed.subdomain));
}

// The side a listed triangle means: that of the tet it names, or else the one it is turned to.
const TriangleRecord& side_meant(const TriangleGroup& group, const TriangleRecord& listed)
{
  for (std::size_t i = 0; i < group.num_sides(); ++i)
    if (listed.cell_id != kNoId && group.side(i).cell_id == listed.cell_id) return group.side(i);
  for (std::size_t i = 0; i < group.num_sides(); ++i)
    if (group.side(i).is_odd == listed.is_odd) return group.side(i);
  return group.side(0);
}

void check_boundary(const TriangleGroup& group, TriangleRole role, Findings& findings)
{
  if (group.num_listed() == 0) {
    if (role != TriangleRole::outside) return;
    findings.add(Kind::boundary_missing, place_of(group.side(0)), [&] {
      return fmt::format("the boundary file lacks the outer triangle of {}",
                         describe(group.side(0)));
    });
    return;
  }
  for (std::size_t i = 1; i < group.num_listed(); ++i) {
    findings.add(Kind::boundary_twice, place_of(group.listed(i)), [&] {
      return fmt::format("{} and {}", describe(group.listed(0)), describe(group.listed(i)));
    });
  }
  const TriangleRecord& listed = group.listed(0);
  if (role == TriangleRole::outside || role == TriangleRole::interface || listed.is_inside) {
    check_listed(listed, side_meant(group, listed), findings);
  } else {
    findings.add(Kind::boundary_extra, place_of(listed), [&] {
      return fmt::format(
          "{} is neither an outer triangle of the mesh, nor between two materials, nor on "
          "a patch that the file says is inside of one",
          describe(listed));
    });
  }
}

void count(const TriangleGroup& group, TriangleRole role, TriangleCounts& counts)
{
  if (group.num_sides() == 0) return;
  ++counts.num_triangles;
  if (role == TriangleRole::outside) ++counts.num_outside;
  if (role == TriangleRole::seam) ++counts.num_seam;
  if (role == TriangleRole::interface) ++counts.num_interface;
  if (is_open(role) && group.num_listed() == 0) ++counts.num_unlisted;
}

template <class Side>
void link_pieces(const Side& first, const Side& other, std::vector<Link>& links)
{
  const auto a = component_name(first.piece, first.component);
  const auto b = component_name(other.piece, other.component);
  if (a != b && (links.empty() || links.back() != Link{a, b})) links.push_back({a, b});
}

void append_verdicts(const TriangleGroup& group, TriangleRole role,
                     std::vector<TriangleVerdict>& verdicts)
{
  for (std::size_t i = 0; i < group.num_sides(); ++i) {
    const TriangleRecord& side = group.side(i);
    if (side.row == kNoIndex) continue;
    const LocalIndex partner = group.num_sides() == 2 ? group.side(1 - i).piece : kNoPiece;
    verdicts.push_back({side.piece, side.row, partner, role});
  }
}

std::vector<TriangleVerdict> send_to_readers(const std::vector<TriangleVerdict>& verdicts,
                                             const comm::Communicator& comm)
{
  const auto reader = [](const TriangleVerdict& verdict) {
    return static_cast<std::uint64_t>(verdict.piece);
  };
  return comm::RecordExchange<TriangleVerdict>(verdicts, reader, comm).take_received();
}

}  // namespace

void TriangleMatcher::add(std::span<const TriangleSide> open, std::span<const TriangleRecord> inner)
{
  const auto owner = [](const auto& side) { return hash_of(side.key); };
  take_open(comm::RecordExchange<TriangleSide>(open, owner, comm_).received());
  take_inner(comm::RecordExchange<TriangleRecord>(inner, owner, comm_).received());
}

std::vector<TriangleVerdict> TriangleMatcher::match()
{
  std::vector<TriangleVerdict> verdicts;
  for (Bucket& bucket : buckets_) match(bucket, verdicts);
  sort_unique(links_);
  return send_to_readers(verdicts, comm_);
}

TriangleMatcher::ShortKey TriangleMatcher::short_key(const TriangleKey& key)
{
  return {static_cast<std::uint32_t>(key[0]), static_cast<std::uint32_t>(key[0] >> 32),
          static_cast<std::uint32_t>(key[1])};
}

TriangleMatcher::Bucket& TriangleMatcher::bucket_of(const TriangleKey& key)
{
  return buckets_[hash_of(key) >> 58];
}

void TriangleMatcher::take_open(std::span<const TriangleSide> sides)
{
  std::vector<std::size_t> num_sides(buckets_.size(), 0);
  for (const TriangleSide& side : sides)
    ++num_sides[static_cast<std::size_t>(&bucket_of(side.key) - buckets_.data())];
  for (std::size_t b = 0; b < buckets_.size(); ++b)
    buckets_[b].open.reserve(buckets_[b].open.size() + num_sides[b]);
  for (const TriangleSide& side : sides) bucket_of(side.key).open.push_back(packed(side));
}

void TriangleMatcher::take_inner(std::span<const TriangleRecord> records)
{
  for (const TriangleRecord& record : records) {
    Bucket& bucket = bucket_of(record.key);
    OpenSide& side =
        bucket.open.emplace_back(packed({record.key, record.piece, kNoIndex, record.component,
                                         record.attribute, record.subdomain, record.is_odd}));
    side.row = -1 - static_cast<LocalIndex>(bucket.inner.size());
    bucket.inner.push_back(record);
  }
}

TriangleMatcher::OpenSide TriangleMatcher::packed(const TriangleSide& side)
{
  const Region region{side.piece, side.component, side.attribute, side.subdomain};
  if (regions_.empty() || regions_[last_region_] != region) {
    const auto next = static_cast<std::uint32_t>(regions_.size());
    const auto [found, is_new] = region_row_.try_emplace(region, next);
    if (is_new) regions_.push_back(region);
    last_region_ = found->second;
  }
  return {side.key, 2 * last_region_ + (side.is_odd ? 1U : 0U), side.row};
}

TriangleSide TriangleMatcher::unpacked(const OpenSide& side) const
{
  const Region& region = regions_[side.region_and_parity / 2];
  return {.key = side.key,
          .piece = region.piece,
          .row = std::max(side.row, kNoIndex),
          .component = region.component,
          .attribute = region.attribute,
          .subdomain = region.subdomain,
          .is_odd = side.region_and_parity % 2 == 1};
}

// Keeps the sides on whose triangles there is no verdict yet.
void TriangleMatcher::match(Bucket& bucket, std::vector<TriangleVerdict>& verdicts)
{
  const std::vector<OpenSide> open = std::exchange(bucket.open, {});
  const std::vector<TriangleRecord> inner = std::exchange(bucket.inner, {});
  std::vector<OpenSide> kept;
  std::vector<ShortKey> keys;
  comm::for_each_group(
      std::span<const OpenSide>(open), [](const OpenSide& side) { return side.key; },
      [&](const OpenSide& side) {
        return std::make_tuple(regions_[side.region_and_parity / 2].piece, side.row);
      },
      [&](std::span<const std::size_t> rows) {
        if (rows.size() == 2
            && match_two(unpacked(open[rows[0]]), unpacked(open[rows[1]]), verdicts)) {
          keys.push_back(short_key(open[rows[0]].key));
          return;
        }
        for (const std::size_t row : rows) {
          OpenSide& side = kept.emplace_back(open[row]);
          if (side.row >= 0) continue;
          bucket.inner.push_back(inner[static_cast<std::size_t>(-1 - side.row)]);
          side.row = -static_cast<LocalIndex>(bucket.inner.size());
        }
      });
  bucket.open = {kept.begin(), kept.end()};  // Without room to spare.
  std::sort(keys.begin(), keys.end());
  std::vector<ShortKey> complete(bucket.complete.size() + keys.size());
  std::merge(bucket.complete.begin(), bucket.complete.end(), keys.begin(), keys.end(),
             complete.begin());
  bucket.complete = std::move(complete);
}

// Whether no side that is still to come can change what is said of the triangle. A third side can,
// but it is noticed by the key.
bool TriangleMatcher::match_two(const TriangleSide& a, const TriangleSide& b,
                                std::vector<TriangleVerdict>& verdicts)
{
  const TriangleRole role = role_between(a, b);
  if (role != TriangleRole::inner && role != TriangleRole::seam) return false;
  if (is_complete(a.key)) return false;
  ++counts_.num_triangles;
  if (role == TriangleRole::seam) ++counts_.num_seam;
  link_pieces(a, b, links_);
  if (a.row != kNoIndex) verdicts.push_back({a.piece, a.row, b.piece, role});
  if (b.row != kNoIndex) verdicts.push_back({b.piece, b.row, a.piece, role});
  return true;
}

bool TriangleMatcher::is_complete(const TriangleKey& key)
{
  const std::vector<ShortKey>& complete = bucket_of(key).complete;
  return std::binary_search(complete.begin(), complete.end(), short_key(key));
}

std::size_t TriangleMatcher::num_inner() const
{
  std::size_t num_inner = 0;
  for (const Bucket& bucket : buckets_) num_inner += bucket.inner.size();
  return num_inner;
}

void TriangleMatcher::drop_open()
{
  for (Bucket& bucket : buckets_) bucket.open = std::vector<OpenSide>();  // {} would keep memory.
  regions_ = std::vector<Region>();
  region_row_ = {};
}

std::vector<TriangleVerdict> TriangleMatcher::decide(std::vector<TriangleRecord> records,
                                                     TriangleRound round)
{
  records = comm::RecordExchange<TriangleRecord>(
                records, [](const TriangleRecord& record) { return hash_of(record.key); }, comm_)
                .take_received();
  for (const Bucket& bucket : buckets_)
    std::ranges::copy_if(bucket.inner, std::back_inserter(records),
                         [&](const auto& record) { return round.contains(record.key); });
  std::vector<TriangleVerdict> verdicts;
  comm::for_each_group(
      std::span<const TriangleRecord>(records),
      [](const TriangleRecord& record) { return record.key; },
      [](const TriangleRecord& r) {
        return std::make_tuple(r.is_listed, r.piece, r.cell, r.cell_id, r.is_odd);
      },
      [&](std::span<const std::size_t> rows) {
        const TriangleGroup group(records, rows);
        const bool is_late = group.num_sides() > 0 && is_complete(group.side(0).key);
        const TriangleRole role = is_late ? TriangleRole::faulty : group.role(boundary_);
        if (!is_late) count(group, role, counts_);
        for (std::size_t i = 1; i < group.num_sides(); ++i)
          link_pieces(group.side(0), group.side(i), links_);
        append_verdicts(group, role, verdicts);
        if (role == TriangleRole::faulty && group.num_sides() > 0)
          report_fault(group, is_late, findings_);
        if (boundary_ != BoundaryFile::none) check_boundary(group, role, findings_);
      });
  sort_unique(links_);
  return send_to_readers(verdicts, comm_);
}

}  // namespace tessera::check

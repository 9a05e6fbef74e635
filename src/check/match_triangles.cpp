// SPDX-License-Identifier: BSD-3-Clause
#include "check/match_triangles.hpp"

#include <algorithm>
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
    if (num_sides_ != 2 || side(0).is_odd == side(1).is_odd) return TriangleRole::faulty;
    if (side(0).attribute != side(1).attribute) return TriangleRole::interface;
    return side(0).subdomain == side(1).subdomain ? TriangleRole::inner : TriangleRole::seam;
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
  if (role == TriangleRole::outside || role == TriangleRole::interface) {
    check_listed(listed, side_meant(group, listed), findings);
  } else {
    findings.add(Kind::boundary_extra, place_of(listed), [&] {
      return fmt::format("{} is neither an outer triangle of the mesh nor between two materials",
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

void link_pieces(const TriangleGroup& group, std::vector<Link>& links)
{
  for (std::size_t i = 1; i < group.num_sides(); ++i) {
    const auto a = component_name(group.side(0).piece, group.side(0).component);
    const auto b = component_name(group.side(i).piece, group.side(i).component);
    if (a != b) links.push_back({a, b});
  }
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

// Whether no side that is still to come can change what is said of the triangle. A third side can,
// but it is noticed by the key.
bool is_final(TriangleRole role)
{
  return role == TriangleRole::inner || role == TriangleRole::seam;
}

std::vector<TriangleVerdict> send_to_readers(std::vector<TriangleVerdict> verdicts,
                                             const comm::Communicator& comm)
{
  const comm::RecordExchange<TriangleVerdict> exchange(
      verdicts,
      [](const TriangleVerdict& verdict) { return static_cast<std::uint64_t>(verdict.piece); },
      comm);
  const auto received = exchange.received();
  return {received.begin(), received.end()};
}

}  // namespace

std::vector<TriangleVerdict> TriangleMatcher::add(std::vector<TriangleRecord> records)
{
  comm::RecordExchange<TriangleRecord> exchange(
      records, [](const TriangleRecord& record) { return hash_of(record.key); }, comm_);
  records = std::move(exchange).take_received();
  records.insert(records.end(), open_.begin(), open_.end());
  open_ = {};
  std::vector<TriangleVerdict> verdicts = match(std::move(records), false);
  sort_unique(links_);
  return send_to_readers(std::move(verdicts), comm_);
}

std::vector<TriangleVerdict> TriangleMatcher::finish()
{
  return send_to_readers(match(std::exchange(open_, {}), true), comm_);
}

std::vector<TriangleVerdict> TriangleMatcher::match(std::vector<TriangleRecord> records,
                                                    bool is_last)
{
  std::vector<TriangleVerdict> verdicts;
  std::vector<TriangleKey> keys;
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
        if (!is_last && (is_late || !is_final(role))) {
          for (const std::size_t row : rows) open_.push_back(records[row]);
          return;
        }
        if (!is_late) count(group, role, counts_);
        link_pieces(group, links_);
        append_verdicts(group, role, verdicts);
        if (role == TriangleRole::faulty && group.num_sides() > 0)
          report_fault(group, is_late, findings_);
        if (boundary_ != BoundaryFile::none) check_boundary(group, role, findings_);
        if (!is_last) keys.push_back(group.side(0).key);
      });
  complete(std::move(keys));
  return verdicts;
}

bool TriangleMatcher::is_complete(const TriangleKey& key) const
{
  return std::binary_search(complete_.begin(), complete_.end(), key);
}

void TriangleMatcher::complete(std::vector<TriangleKey> keys)
{
  std::sort(keys.begin(), keys.end());
  const auto num_before = static_cast<std::ptrdiff_t>(complete_.size());
  complete_.insert(complete_.end(), keys.begin(), keys.end());
  std::inplace_merge(complete_.begin(), complete_.begin() + num_before, complete_.end());
}

}  // namespace tessera::check

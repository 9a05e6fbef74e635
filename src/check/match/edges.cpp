// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/edges.hpp"

#include <algorithm>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "tessera/comm/record_exchange.hpp"

namespace tessera::check {
namespace {

// Triangles at a smaller angle, in radians, lie on one another. It is far above the rounding of
// coordinates and far below the exterior angle of any meshed cusp.
constexpr double kFoldAngle = 1e-6;

class EdgeGroup {
 public:
  EdgeGroup(std::span<const EdgeRecord> records, std::span<const std::size_t> rows)
  {
    for (const std::size_t row : rows) {
      all_.push_back(&records[row]);
      if (records[row].is_on_boundary) triangles_.push_back(&records[row]);
    }
  }

  void check(EdgeMatch& match, Findings& findings) const
  {
    ++match.num_edges;
    for (const EdgeRecord* record : all_)
      if (record->twin != kNoPiece && !has_record_of(record->twin)) ++match.num_halves;
    if (triangles_.size() % 2 == 1)
      report(Kind::boundary_edge, findings);
    else if (triangles_.size() > 2)
      ++match.num_nonmanifold;
    if (has_fold()) report(Kind::folded_boundary, findings);
    for (std::size_t i = 1; i < triangles_.size(); ++i) {
      const GlobalIndex a = name(*triangles_[0]);
      const GlobalIndex b = name(*triangles_[i]);
      if (a != b && (match.links.empty() || match.links.back() != Link{a, b}))
        match.links.push_back({a, b});
    }
  }

 private:
  static Vec3 widened(const std::array<float, 3>& x) { return {x[0], x[1], x[2]}; }

  [[nodiscard]] bool has_record_of(LocalIndex piece) const
  {
    return std::any_of(all_.begin(), all_.end(),
                       [&](const EdgeRecord* record) { return record->piece == piece; });
  }

  static GlobalIndex name(const EdgeRecord& record)
  {
    return component_name(record.piece, record.boundary_component);
  }

  [[nodiscard]] bool has_fold() const
  {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      for (std::size_t j = i + 1; j < triangles_.size(); ++j) {
        if (triangles_[i]->is_on_split && triangles_[j]->is_on_split) continue;
        const Vec3 a = widened(triangles_[i]->inward);
        const Vec3 b = widened(triangles_[j]->inward);
        if (dot(a, b) > 0.5 && norm(a - b) <= kFoldAngle) return true;
      }
    }
    return false;
  }

  void report(Kind kind, Findings& findings) const
  {
    const EdgeRecord& first = *triangles_[0];
    findings.add(kind, {first.piece, first.cell}, [&] {
      const Vec3 near = widened(first.middle);
      std::string text = fmt::format("edge near {} has {} boundary triangles, of", to_text(near),
                                     triangles_.size());
      for (const EdgeRecord* triangle : triangles_) {
        text += fmt::format(" cell {} of piece {};", triangle->cell, triangle->piece);
      }
      return text;
    });
  }

  std::vector<const EdgeRecord*> all_{};
  std::vector<const EdgeRecord*> triangles_{};  // Of these, the ones on the boundary.
};

}  // namespace

EdgeMatch match_edges(std::span<const EdgeRecord> records, const comm::Communicator& comm,
                      Findings& findings)
{
  const comm::RecordExchange<EdgeRecord> exchange(
      records, [](const EdgeRecord& record) { return hash_of(record.key); }, comm);
  EdgeMatch match;
  match_own_edges(exchange.received(), match, findings);
  return match;
}

void match_own_edges(std::span<const EdgeRecord> records, EdgeMatch& match, Findings& findings)
{
  comm::for_each_group(
      records, [](const EdgeRecord& record) { return record.key; },
      [](const EdgeRecord& r) { return std::make_tuple(r.piece, r.cell, r.inward); },
      [&](std::span<const std::size_t> rows) { EdgeGroup(records, rows).check(match, findings); });
}

}  // namespace tessera::check

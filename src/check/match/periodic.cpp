// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/entity_key.hpp"
#include "tessera/base/error.hpp"
#include "tessera/comm/record_exchange.hpp"

namespace tessera::check {
namespace {

// Of the largest coordinate. Images differ by rounding, also where several transforms lead there.
constexpr double kTolerance = 1e-9;

// Points are told apart along a direction that no side of a model is likely to lie across. Those of
// one slab across it go to one rank.
constexpr Vec3 kDirection{0.5357, 0.6180, 0.5755};
constexpr double kSlab = 1e-3;  // Of the largest coordinate.

double along(const Vec3& point) { return dot(kDirection, point); }

}  // namespace

void PeriodicMatcher::add(const PieceMesh& boundary, Findings& findings)
{
  const auto texts = boundary.arrays.field_texts.find(mesh::kPeriodicPairsName);
  const auto patches = boundary.arrays.cell_ints.find("patch");
  const auto names = boundary.arrays.field_texts.find("patch_names");
  if (texts == boundary.arrays.field_texts.end() || patches == boundary.arrays.cell_ints.end()
      || names == boundary.arrays.field_texts.end()) {
    return;
  }
  try {
    pairs_ = mesh::periodic_pairs(texts->second);
  } catch (const InputError& error) {
    findings.add(Kind::arrays, {boundary.name.piece, 0}, [&] { return error.what(); });
    return;
  }
  std::set<std::tuple<LocalIndex, LocalIndex, bool>> known;
  const auto add_cell = [&](LocalIndex c, LocalIndex pair, bool is_image) {
    for (const LocalIndex v : boundary.cell(c)) {
      if (!known.emplace(v, pair, is_image).second) continue;
      const Vec3 position = boundary.position(v);
      points_.push_back({.place = is_image ? position : pairs_[at(pair)].there(position),
                         .position = position,
                         .id = boundary.point_id(v),
                         .piece = boundary.name.piece,
                         .point = v,
                         .pair = pair,
                         .is_image = is_image});
    }
  };
  for (LocalIndex c = 0; c < boundary.num_cells(); ++c) {
    const auto patch = static_cast<std::size_t>(patches->second[at(c)]);
    if (boundary.is_left_out(c) || patch >= names->second.size()) continue;
    for (LocalIndex pair = 0; pair < std::ssize(pairs_); ++pair) {
      if (names->second[patch] == pairs_[at(pair)].from) add_cell(c, pair, false);
      if (names->second[patch] == pairs_[at(pair)].to) add_cell(c, pair, true);
    }
  }
}

// Each point has a partner in the slab, or is there for another's sake only.
void PeriodicMatcher::compare(std::vector<SidePoint> points, double tolerance,
                              Findings& findings) const
{
  std::ranges::sort(points, {}, [](const SidePoint& one) {
    return std::tuple(one.pair, along(one.place), one.piece, one.point, one.is_image);
  });
  const auto is_near = [&](const SidePoint& one, const SidePoint& other) {
    return other.pair == one.pair && std::abs(along(other.place) - along(one.place)) <= tolerance;
  };
  const auto is_partner = [&](const SidePoint& one, const SidePoint& other) {
    return other.is_image != one.is_image && norm(other.place - one.place) <= tolerance;
  };
  const auto has_partner = [&](std::size_t i) {
    bool has = false;
    for (std::size_t j = i; !has && j < points.size() && is_near(points[i], points[j]); ++j) {
      has = is_partner(points[i], points[j]);
    }
    for (std::size_t j = i; !has && j-- > 0 && is_near(points[i], points[j]);) {
      has = is_partner(points[i], points[j]);
    }
    return has;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].is_answered && !has_partner(i)) report(points[i], findings);
  }
}

void PeriodicMatcher::report(const SidePoint& one, Findings& findings) const
{
  const mesh::PeriodicPair& pair = pairs_[at(one.pair)];
  findings.add(Kind::periodic_point, {one.piece, one.point}, [&] {
    return fmt::format(
        "boundary piece {}: point {}{} at {} of patch \"{}\" has no partner on \"{}\"", one.piece,
        one.point, one.id == kNoId ? "" : fmt::format(" (id {})", one.id), to_text(one.position),
        one.is_image ? pair.to : pair.from, one.is_image ? pair.from : pair.to);
  });
}

void PeriodicMatcher::finish(const comm::Communicator& comm, Findings& findings)
{
  double largest = 0.0;
  for (const SidePoint& one : points_) {
    for (const double x : one.place) largest = std::max(largest, std::abs(x));
  }
  largest = comm.max(largest);
  if (largest == 0.0) return;
  const double tolerance = kTolerance * largest;
  const auto slab_of = [&](double place) {
    return static_cast<std::int64_t>(std::floor(place / (kSlab * largest)));
  };
  // A point at the border of two slabs goes to both, and is reported by one.
  const std::size_t num_own = points_.size();
  for (std::size_t i = 0; i < num_own; ++i) {
    const double place = along(points_[i].place);
    points_[i].slab = slab_of(place);
    for (const double beside : {place - tolerance, place + tolerance}) {
      if (slab_of(beside) == points_[i].slab) continue;
      SidePoint copy = points_[i];
      copy.slab = slab_of(beside);
      copy.is_answered = false;
      points_.push_back(copy);
    }
  }
  const comm::RecordExchange<SidePoint> exchange(
      points_, [](const SidePoint& one) { return static_cast<std::uint64_t>(one.slab); }, comm);
  points_ = {};
  compare({exchange.received().begin(), exchange.received().end()}, tolerance, findings);
}

}  // namespace tessera::check

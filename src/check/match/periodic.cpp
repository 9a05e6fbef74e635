// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/periodic.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::check {

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
  const auto add_cell = [&](LocalIndex c, LocalIndex group, bool is_image) {
    for (const LocalIndex v : boundary.cell(c)) {
      if (!known.emplace(v, group, is_image).second) continue;
      const Vec3 position = boundary.position(v);
      places_.push_back({.place = is_image ? position : pairs_[at(group)].there(position),
                         .group = group,
                         .is_image = is_image});
      points_.push_back({.position = position,
                         .id = boundary.point_id(v),
                         .piece = boundary.name.piece,
                         .point = v});
    }
  };
  for (LocalIndex c = 0; c < boundary.num_cells(); ++c) {
    const auto patch = static_cast<std::size_t>(patches->second[at(c)]);
    if (boundary.is_left_out(c) || patch >= names->second.size()) continue;
    for (LocalIndex pair = 0; pair < std::ssize(pairs_); ++pair) {
      if (names->second[patch] == pairs_[at(pair)].from) add_cell(c, group_of(pair), false);
      if (names->second[patch] == pairs_[at(pair)].to) add_cell(c, group_of(pair), true);
    }
  }
}

// Several patches on one side may have one name, and those on the other side names of their own.
LocalIndex PeriodicMatcher::group_of(LocalIndex pair) const
{
  const auto first = std::ranges::find(pairs_, pairs_[at(pair)].there, &mesh::PeriodicPair::there);
  return static_cast<LocalIndex>(first - pairs_.begin());
}

void PeriodicMatcher::report(const Point& one, const comm::SidePoint& place,
                             Findings& findings) const
{
  const mesh::PeriodicPair& pair = pairs_[at(place.group)];
  findings.add(Kind::periodic_point, {one.piece, one.point}, [&] {
    return fmt::format(
        "boundary piece {}: point {}{} at {} of patch \"{}\" has no partner on \"{}\"", one.piece,
        one.point, one.id == kNoId ? "" : fmt::format(" (id {})", one.id), to_text(one.position),
        place.is_image ? pair.to : pair.from, place.is_image ? pair.from : pair.to);
  });
}

void PeriodicMatcher::finish(const comm::Communicator& comm, Findings& findings)
{
  const std::vector<GlobalIndex> partners = comm::find_partners(places_, comm);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (partners[i] == comm::kNoPartner) report(points_[i], places_[i], findings);
  }
  places_ = {};
  points_ = {};
}

}  // namespace tessera::check

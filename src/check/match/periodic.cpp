// SPDX-License-Identifier: BSD-3-Clause
#include "check/match/periodic.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::check {
namespace {

// Label of a point without an id.
constexpr GlobalIndex kNotSaid = std::numeric_limits<GlobalIndex>::max();

// None where a split lets several points stand at one position.
std::optional<GlobalIndex> partner_of_file(const PieceMesh& boundary, LocalIndex transform,
                                           LocalIndex point)
{
  const auto array = boundary.arrays.point_longs.find(mesh::name_of_partners(transform));
  if (array == boundary.arrays.point_longs.end() || !boundary.split_patches().empty()) return {};
  return array->second[at(point)];
}

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
  // Several patches on one side may have one name, and those on the other side names of their own.
  const std::vector<LocalIndex> transforms = mesh::transforms_of(pairs_);
  std::set<std::tuple<LocalIndex, LocalIndex, bool>> known;
  const auto add_cell = [&](LocalIndex c, LocalIndex pair, bool is_image) {
    const Side side{pair, transforms[at(pair)], is_image};
    for (const LocalIndex v : boundary.cell(c)) {
      if (known.emplace(v, side.transform, is_image).second) add_point(boundary, v, side);
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

void PeriodicMatcher::add_point(const PieceMesh& boundary, LocalIndex point, const Side& side)
{
  const Vec3 position = boundary.position(point);
  const GlobalIndex id = boundary.point_id(point);
  places_.push_back({.place = side.is_image ? position : pairs_[at(side.pair)].there(position),
                     .label = id == kNoId ? kNotSaid : id,
                     .group = side.transform,
                     .is_image = side.is_image});
  points_.push_back({.position = position,
                     .id = id,
                     .piece = boundary.name.piece,
                     .point = point,
                     .pair = side.pair,
                     .partner_of_file = side.is_image
                                            ? partner_of_file(boundary, side.transform, point)
                                            : std::nullopt});
}

void PeriodicMatcher::report(const Point& one, bool is_image, Findings& findings) const
{
  const mesh::PeriodicPair& pair = pairs_[at(one.pair)];
  findings.add(Kind::periodic_point, {one.piece, one.point}, [&] {
    const std::string point =
        fmt::format("boundary piece {}: point {}{} at {} of patch \"{}\"", one.piece, one.point,
                    one.id == kNoId ? "" : fmt::format(" (id {})", one.id), to_text(one.position),
                    is_image ? pair.to : pair.from);
    const std::string& other = is_image ? pair.from : pair.to;
    if (!one.partner_of_file) return fmt::format("{} has no partner on \"{}\"", point, other);
    return fmt::format("{} is not the image of that of \"{}\" with id {}, as the file says", point,
                       other, *one.partner_of_file);
  });
}

void PeriodicMatcher::finish(const comm::Communicator& comm, Findings& findings)
{
  const std::vector<GlobalIndex> partners = comm::find_partners(places_, comm);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const std::optional<GlobalIndex>& of_file = points_[i].partner_of_file;
    const bool is_said = of_file && partners[i] != kNotSaid;
    if (partners[i] != comm::kNoPartner && (!is_said || partners[i] == *of_file)) continue;
    if (partners[i] == comm::kNoPartner) points_[i].partner_of_file.reset();
    report(points_[i], places_[i].is_image, findings);
  }
  places_ = {};
  points_ = {};
}

}  // namespace tessera::check

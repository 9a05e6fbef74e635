// SPDX-License-Identifier: BSD-3-Clause
#include "surface/wrap/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tessera::surface {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr float kPutInside = 2.0F;
constexpr float kPutOutside = -1.0F;

// Where bodies meet along an edge the choice must be the same all along it.
constexpr double kNoDifference = 0.01;

// Corners that meet across a diagonal belong together if all is inside that is so near to it, in
// parts of the spacing. Where bodies only touch it is not.
constexpr double kNeck = 0.1;
constexpr int kPartsOfDiagonal = 8;

// 21 bits an axis. Sheets that lie behind each other enclose more than half far beyond their box,
// so places may be below zero.
constexpr std::int32_t kLowest = -(1 << 20);

std::uint64_t key_of(const LatticePlace& place)
{
  std::uint64_t key = 0;
  for (const std::int32_t i : place) key = (key << 21U) | static_cast<std::uint32_t>(i - kLowest);
  return key;
}

LatticePlace shifted(LatticePlace place, std::size_t axis, std::int32_t by)
{
  place[axis] += by;
  return place;
}

// Corner c of a cell: bit a of c says whether it is the farther one along axis a.
LatticePlace corner_of(const LatticePlace& cell, std::size_t c)
{
  return {cell[0] + static_cast<std::int32_t>(c & 1U),
          cell[1] + static_cast<std::int32_t>(c >> 1U & 1U),
          cell[2] + static_cast<std::int32_t>(c >> 2U)};
}

Corners halved(const Corners& p, std::size_t from, bool first)
{
  Corners half = p;
  half[first ? from : (from + 1) % 3] = midpoint(p[from], p[(from + 1) % 3]);
  return half;
}

std::size_t longest_edge(const Corners& p)
{
  std::size_t longest = 0;
  for (std::size_t e = 1; e < 3; ++e) {
    if (norm(p[(e + 1) % 3] - p[e]) > norm(p[(longest + 1) % 3] - p[longest])) longest = e;
  }
  return longest;
}

}  // namespace

WrapLattice::WrapLattice(const Vec3& origin, double spacing, Winding winding,
                         std::size_t most_cells)
    : origin_(origin), spacing_(spacing), winding_(std::move(winding)), most_cells_(most_cells)
{
}

Vec3 WrapLattice::position(const LatticePlace& point) const
{
  return origin_
         + spacing_
               * Vec3{static_cast<double>(point[0]), static_cast<double>(point[1]),
                      static_cast<double>(point[2])};
}

double WrapLattice::winding_at(const LatticePlace& point)
{
  const auto [place, is_new] = winding_of_.emplace(key_of(point), 0.0F);
  if (is_new) place->second = static_cast<float>(winding_(position(point)));
  return static_cast<double>(place->second);
}

bool WrapLattice::is_mixed(const LatticePlace& cell)
{
  const bool first = is_inside(cell);
  for (std::size_t c = 1; c < 8; ++c) {
    if (is_inside(corner_of(cell, c)) != first) return true;
  }
  return false;
}

void WrapLattice::add_cell(const LatticePlace& cell)
{
  if (is_known_.insert(key_of(cell)).second) cells_.push_back(cell);
}

// Halves the triangle until each part is about a cell large, and takes all cells of its box.
void WrapLattice::add_cells_of(const Corners& triangle)
{
  std::vector<Corners> parts{triangle};
  while (!parts.empty() && cells_.size() <= most_cells_) {
    const Corners p = parts.back();
    parts.pop_back();
    const std::size_t longest = longest_edge(p);
    if (norm(p[(longest + 1) % 3] - p[longest]) > 1.5 * spacing_) {
      parts.push_back(halved(p, longest, true));
      parts.push_back(halved(p, longest, false));
      continue;
    }
    LatticePlace low{};
    LatticePlace high{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto [least, most] = std::minmax({p[0][a], p[1][a], p[2][a]});
      low[a] = static_cast<std::int32_t>(std::floor((least - origin_[a]) / spacing_));
      high[a] = static_cast<std::int32_t>(std::floor((most - origin_[a]) / spacing_));
    }
    for (std::int32_t i = low[0]; i <= high[0]; ++i) {
      for (std::int32_t j = low[1]; j <= high[1]; ++j) {
        for (std::int32_t k = low[2]; k <= high[2]; ++k) add_cell({i, j, k});
      }
    }
  }
}

// Where a side of a cell has corners inside and outside, the boundary goes on in the next cell.
void WrapLattice::add_across_mixed_faces(const LatticePlace& cell)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      int num_inside = 0;
      for (std::size_t c = 0; c < 8; ++c) {
        if ((c >> axis & 1U) == side) num_inside += is_inside(corner_of(cell, c)) ? 1 : 0;
      }
      if (num_inside % 4 != 0) add_cell(shifted(cell, axis, side == 1 ? 1 : -1));
    }
  }
}

// False if there are too many cells.
bool WrapLattice::follow()
{
  for (; num_followed_ < cells_.size(); ++num_followed_) {
    if (cells_.size() > most_cells_) return false;
    const LatticePlace cell = cells_[num_followed_];
    if (is_mixed(cell)) add_across_mixed_faces(cell);
  }
  return true;
}

// A point on the other side, and the eight cells around it.
void WrapLattice::put(const LatticePlace& point, float winding)
{
  winding_of_[key_of(point)] = winding;
  for (std::size_t c = 0; c < 8; ++c) {
    const LatticePlace near = corner_of({point[0] - 1, point[1] - 1, point[2] - 1}, c);
    add_cell(near);
    if (is_mixed(near)) add_across_mixed_faces(near);
  }
}

// Pairs of corners of a cell that meet only across a side's or the cell's diagonal.
std::vector<WrapLattice::Meeting> WrapLattice::meetings(const LatticePlace& cell)
{
  std::array<bool, 8> in{};
  int num_inside = 0;
  for (std::size_t c = 0; c < 8; ++c) num_inside += (in[c] = is_inside(corner_of(cell, c))) ? 1 : 0;
  std::vector<Meeting> found;
  for (std::size_t c = 0; c < 8; ++c) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t beside = c ^ (1U << a);
      const std::size_t other = c ^ (1U << ((a + 1) % 3));
      const std::size_t across = beside ^ other ^ c;
      if (c < across && in[c] && in[across] && !in[beside] && !in[other])
        found.push_back({.inside = {c, across}, .outside = {beside, other}});
    }
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if (in[c] != in[7 - c] || num_inside != (in[c] ? 2 : 6)) continue;
    Meeting& meeting = found.emplace_back();
    for (std::size_t other = 0; other < 8; ++other)
      (in[other] ? meeting.inside : meeting.outside).push_back(other);
  }
  return found;
}

// Of some corners of a cell the one that is most inside, or least.
LatticePlace WrapLattice::extreme(const LatticePlace& cell, const std::vector<std::size_t>& corners,
                                  bool is_most)
{
  const double sign = is_most ? 1.0 : -1.0;
  LatticePlace best = corner_of(cell, corners.front());
  for (const std::size_t c : corners) {
    const LatticePlace point = corner_of(cell, c);
    if (sign * winding_at(point) > sign * winding_at(best) + kNoDifference) best = point;
  }
  return best;
}

// Whether all is inside around the way from one point to another.
bool WrapLattice::is_neck(const Vec3& from, const Vec3& to) const
{
  for (int i = 1; i < kPartsOfDiagonal; ++i) {
    const Vec3 middle = from + (static_cast<double>(i) / kPartsOfDiagonal) * (to - from);
    for (std::size_t a = 0; a < 3; ++a) {
      for (const double side : {-kNeck, kNeck}) {
        Vec3 beside = middle;
        beside[a] += side * spacing_;
        if (winding_(beside) < 0.5) return false;
      }
    }
  }
  return true;
}

// Bodies that touch at no more than an edge or a corner are taken apart there.
void WrapLattice::separate(const LatticePlace& cell)
{
  for (const Meeting& meeting : meetings(cell)) {
    if (meeting.inside.size() != 2) continue;
    const Vec3 from = position(corner_of(cell, meeting.inside[0]));
    const Vec3 to = position(corner_of(cell, meeting.inside[1]));
    if (!is_neck(from, to)) return put(extreme(cell, meeting.inside, false), kPutOutside);
  }
}

// Puts the point inside that is most so, of those that would join corners. Whether there are any.
bool WrapLattice::join(const LatticePlace& cell)
{
  std::vector<std::size_t> outside;
  for (const Meeting& meeting : meetings(cell))
    outside.insert(outside.end(), meeting.outside.begin(), meeting.outside.end());
  if (outside.empty()) return false;
  put(extreme(cell, outside, true), kPutInside);
  return true;
}

// No point is put outside after one was put inside, so this ends.
bool WrapLattice::compose()
{
  for (std::size_t i = 0; i < cells_.size() && cells_.size() <= most_cells_; ++i)
    separate(cells_[i]);
  for (bool has_changed = true; has_changed;) {
    if (!follow()) return false;
    has_changed = false;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const LatticePlace cell = cells_[i];
      while (join(cell)) has_changed = true;
      if (cells_.size() > most_cells_) return false;
    }
  }
  return true;
}

void WrapLattice::add_square(const LatticePlace& point, std::size_t axis, int direction,
                             const std::unordered_map<Key, LocalIndex>& rows, LatticeBoundary& to)
{
  const LatticePlace next = shifted(point, axis, direction);
  const std::size_t b = (axis + 1) % 3;
  const std::size_t c = (axis + 2) % 3;
  const LatticePlace low = direction > 0 ? point : next;
  LatticeBoundary::Square square{.inside = position(point), .outside = position(next)};
  constexpr std::array<std::array<std::int32_t, 2>, 4> kAround{
      {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [along_b, along_c] = kAround[direction > 0 ? i : 3 - i];
    square.cells[i] = rows.at(key_of(shifted(shifted(low, b, along_b), c, along_c)));
  }
  const double in = winding_at(point);
  const double out = winding_at(next);
  if (in < 1.5 && out > -0.5) square.share = std::clamp((in - 0.5) / (in - out), 0.05, 0.95);
  to.squares.push_back(square);
}

LatticeBoundary WrapLattice::squares()
{
  std::vector<LatticePlace> mixed;
  std::ranges::copy_if(cells_, std::back_inserter(mixed),
                       [this](const LatticePlace& cell) { return is_mixed(cell); });
  std::ranges::sort(mixed);
  LatticeBoundary boundary;
  std::unordered_map<Key, LocalIndex> rows;
  for (const LatticePlace& cell : mixed) {
    rows.emplace(key_of(cell), static_cast<LocalIndex>(boundary.cell_middles.size()));
    boundary.cell_middles.push_back(position(cell) + 0.5 * spacing_ * Vec3{1.0, 1.0, 1.0});
  }
  // All four cells around an edge that crosses are mixed, so the one that it begins at is there.
  for (const LatticePlace& cell : mixed) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const LatticePlace next = shifted(cell, axis, 1);
      if (is_inside(cell) == is_inside(next)) continue;
      if (is_inside(cell)) {
        add_square(cell, axis, 1, rows, boundary);
      } else {
        add_square(next, axis, -1, rows, boundary);
      }
    }
  }
  return boundary;
}

std::optional<LatticeBoundary> WrapLattice::boundary(std::span<const Corners> triangles)
{
  for (const Corners& triangle : triangles) add_cells_of(triangle);
  if (!follow() || !compose()) return std::nullopt;
  return squares();
}

}  // namespace tessera::surface

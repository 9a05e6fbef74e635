// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/lattice_stars.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "tessera/base/sort_unique.hpp"

namespace tessera::delaunay {
namespace {

using Key = std::int64_t;  // Of a cell: its place along each axis, one behind the other.

constexpr int kBitsOfAxis = 20;
constexpr std::array<Key, 3> kStep{Key{1} << (2 * kBitsOfAxis), Key{1} << kBitsOfAxis, 1};

// A point by the cell that it lies in.
struct Place {
  Key cell = 0;
  LocalIndex point = 0;

  friend auto operator<=>(const Place&, const Place&) = default;
};

// The cells of one size in which there is nothing but the lattice's corner and middle.
class PureCells {
 public:
  PureCells(std::span<const Vec3> points, std::span<const double> lattice_side, double side)
      : points_(points), lattice_side_(lattice_side), side_(side)
  {
    find_cells();
    for (std::size_t axis = 0; axis < 3; ++axis) link(axis);
  }

  void add_stars(LatticeStars& stars)
  {
    // The spheres at a middle stay within the cells around its own. Those at a corner reach the
    // second cells below it, and the first above, where it is the lowest of its cell.
    const std::vector<char> is_middle_closed = eroded(1);
    const std::vector<char> is_corner_closed = eroded(2);
    for (std::size_t i = 0; i < size(); ++i) {
      if (is_middle_closed[i] != 0) stars.is_closed[at(middle_[i])] = 1;
      if (is_corner_closed[i] != 0) stars.is_closed[at(corner_[i])] = 1;
    }
    for (LocalIndex i = 0; at(i) < size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) add_tets_across(i, axis, stars);
    }
  }

 private:
  [[nodiscard]] std::size_t size() const { return cells_.size(); }

  // The cell of a point; nothing if it is too far away.
  [[nodiscard]] std::optional<Key> cell_of(const Vec3& point) const
  {
    constexpr double kMost = 1 << (kBitsOfAxis - 2);  // So that no step leads to another row.
    Key cell = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = std::floor(point[axis] / side_);
      if (!(std::abs(place) < kMost)) return std::nullopt;
      cell += static_cast<Key>(place) * kStep[axis];
    }
    return cell;
  }

  // 0 for a corner, 1 for a middle, 2 for what is neither.
  [[nodiscard]] int kind_of(LocalIndex row) const
  {
    if (lattice_side_[at(row)] != side_) return 2;
    std::array<double, 3> part{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = points_[at(row)][axis] / side_;
      part[axis] = place - std::floor(place);
    }
    if (part == std::array{0.0, 0.0, 0.0}) return 0;
    return part == std::array{0.5, 0.5, 0.5} ? 1 : 2;
  }

  void find_cells()
  {
    std::vector<Place> places;
    places.reserve(points_.size());
    for (LocalIndex row = 0; at(row) < points_.size(); ++row) {
      if (const auto cell = cell_of(points_[at(row)])) places.push_back({*cell, row});
    }
    std::ranges::sort(places);
    for (std::size_t first = 0; first < places.size();) {
      std::size_t last = first;
      while (last < places.size() && places[last].cell == places[first].cell) ++last;
      if (last - first == 2) add_if_pure(places[first], places[first + 1]);
      first = last;
    }
  }

  void add_if_pure(const Place& a, const Place& b)
  {
    const int kind = kind_of(a.point);
    if (kind == 2 || kind_of(b.point) != 1 - kind) return;
    cells_.push_back(a.cell);
    corner_.push_back(kind == 0 ? a.point : b.point);
    middle_.push_back(kind == 0 ? b.point : a.point);
  }

  // Finds the cells beyond and before each along an axis.
  void link(std::size_t axis)
  {
    next_[axis].assign(size(), kNoIndex);
    previous_[axis].assign(size(), kNoIndex);
    std::size_t other = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      const Key wanted = cells_[i] + kStep[axis];
      while (other < size() && cells_[other] < wanted) ++other;
      if (other == size() || cells_[other] != wanted) continue;
      next_[axis][i] = static_cast<LocalIndex>(other);
      previous_[axis][other] = static_cast<LocalIndex>(i);
    }
  }

  // Whether the cells from so many before each to one beyond it are pure, along all axes.
  [[nodiscard]] std::vector<char> eroded(int num_before) const
  {
    std::vector<char> is_left(size(), 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<char> before = is_left;
      for (LocalIndex i = 0; at(i) < size(); ++i) {
        const auto all = [&](const std::vector<LocalIndex>& step, int count) {
          LocalIndex cell = i;
          for (int k = 0; k < count && cell != kNoIndex; ++k) {
            cell = step[at(cell)];
            if (cell != kNoIndex && before[at(cell)] == 0) return false;
          }
          return cell != kNoIndex;
        };
        if (!all(next_[axis], 1) || !all(previous_[axis], num_before)) is_left[at(i)] = 0;
      }
    }
    return is_left;
  }

  // The four tets of the middles of two cells and the edges of the face between them, if all of a
  // vertex of theirs are known.
  void add_tets_across(LocalIndex cell, std::size_t axis, LatticeStars& stars) const
  {
    const LocalIndex beyond = next_[axis][at(cell)];
    if (beyond == kNoIndex) return;
    const auto corner = [this](LocalIndex of) { return of == kNoIndex ? of : corner_[at(of)]; };
    const auto next = [this](LocalIndex of, std::size_t along) {
      return of == kNoIndex ? of : next_[along][at(of)];
    };
    const LocalIndex side = next(beyond, (axis + 1) % 3);
    const std::array<LocalIndex, 4> ring{corner(beyond), corner(side),
                                         corner(next(side, (axis + 2) % 3)),
                                         corner(next(beyond, (axis + 2) % 3))};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array tet{middle_[at(cell)], middle_[at(beyond)], ring[k], ring[(k + 1) % 4]};
      const auto is_closed = [&](LocalIndex v) {
        return v != kNoIndex && stars.is_closed[at(v)] != 0;
      };
      if (std::ranges::none_of(tet, is_closed)) continue;
      stars.tet_vertices.insert(stars.tet_vertices.end(), tet.begin(), tet.end());
    }
  }

  std::span<const Vec3> points_;
  std::span<const double> lattice_side_;
  double side_;
  std::vector<Key> cells_{};  // Ascending.
  std::vector<LocalIndex> corner_{};
  std::vector<LocalIndex> middle_{};
  std::array<std::vector<LocalIndex>, 3> next_{};
  std::array<std::vector<LocalIndex>, 3> previous_{};
};

}  // namespace

LatticeStars lattice_stars(std::span<const Vec3> points, std::span<const double> lattice_side)
{
  LatticeStars stars;
  stars.is_closed.assign(points.size(), 0);
  std::vector<double> sides(lattice_side.begin(), lattice_side.end());
  std::erase(sides, 0.0);
  sort_unique(sides);
  for (const double side : sides) PureCells(points, lattice_side, side).add_stars(stars);
  return stars;
}

}  // namespace tessera::delaunay

// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/domains/octree_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/base/threads.hpp"

namespace tessera::coarse {
namespace {

// A leaf has two points of its own; more cells would make more tets than a coarse mesh should have.
constexpr double kMostCells = 5e7;

constexpr std::size_t kDeepest = 30;

// Larger cells come first, so that most of a box in which nothing is needed is not divided.
constexpr double kMostRoots = 1000.0;

// How many times shorter than a cell's edges the wanted ones may be. On 27 files of the corpus G
// was 0.968 of NETGEN's with the square root of two, 0.955 with 1.6 and 0.951 with 1.8, and the 1st
// percentile 1.027, 1.025 and 1.017.
constexpr double kMostTooLong = 1.6;

// Place in units of the side of the cells of one level.
using Cell = std::array<std::int64_t, 3>;

double rounded_to_eight_digits(double x)
{
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::round(256.0 * mantissa), exponent - 8);
}

Cell parent_of(const Cell& cell) { return {cell[0] >> 1, cell[1] >> 1, cell[2] >> 1}; }

// The first (add = 0) or last (1) child.
Cell child_of(const Cell& cell, std::int64_t add)
{
  return {2 * cell[0] + add, 2 * cell[1] + add, 2 * cell[2] + add};
}

// Calls use(cell) for the cells from `low` to `high`, both included.
template <class Use>
void for_each_cell(const Cell& low, const Cell& high, const Use& use)
{
  for (std::int64_t x = low[0]; x <= high[0]; ++x) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t z = low[2]; z <= high[2]; ++z) use(Cell{x, y, z});
    }
  }
}

std::vector<Cell> children_of(const std::vector<Cell>& cells)
{
  std::vector<Cell> children;
  children.reserve(8 * cells.size());
  for (const Cell& cell : cells) {
    for_each_cell(child_of(cell, 0), child_of(cell, 1),
                  [&](const Cell& child) { children.push_back(child); });
  }
  return children;
}

void require_few(double num_cells)
{
  if (num_cells <= kMostCells) return;
  throw MeshError(fmt::format("a lattice of these sizes has {:g} cells", num_cells));
}

// Cells of a level that are halved have their children on the next one. What is not is a leaf.
class Octree {
 public:
  Octree(const Box& box, double unit, const LatticeSpace& space) : space_(space), root_side_(unit)
  {
    while (num_roots_in(box) > kMostRoots) root_side_ *= 2.0;
    for_each_cell(cell_at(box.low), cell_at(box.high),
                  [&](const Cell& cell) { roots_.push_back(cell); });
  }

  void build()
  {
    std::vector<Cell> cells = roots_;
    while (!cells.empty() && halved_.size() < kDeepest) {
      halved_.push_back(too_coarse_ones(cells));
      cells = children_of(halved_.back());
      require_few(static_cast<double>(cells.size()));
    }
    grade();
  }

  [[nodiscard]] std::vector<LatticePoint> points() const
  {
    std::vector<Place> places;
    std::vector<Cell> cells = roots_;
    for (std::size_t level = 0; level <= halved_.size(); ++level) {
      for (const Cell& cell : cells) {
        if (!is_halved(cell, level)) add_leaf(cell, level, places);
      }
      if (level < halved_.size()) cells = children_of(halved_[level]);
    }
    return merged(std::move(places));
  }

 private:
  // In units of half a cell of the last level. The order puts the finest level first.
  struct Place {
    Cell place{};
    std::size_t levels_above_last = 0;

    friend auto operator<=>(const Place&, const Place&) = default;
  };

  [[nodiscard]] double side_at(std::size_t level) const
  {
    return std::ldexp(root_side_, -static_cast<int>(level));
  }

  // The root cell that holds a place.
  [[nodiscard]] Cell cell_at(const Vec3& place) const
  {
    const auto of_axis = [&](double x) {
      return static_cast<std::int64_t>(std::floor(x / root_side_));
    };
    return {of_axis(place[0]), of_axis(place[1]), of_axis(place[2])};
  }

  [[nodiscard]] double num_roots_in(const Box& box) const
  {
    const Cell low = cell_at(box.low);
    const Cell high = cell_at(box.high);
    double num_roots = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      num_roots *= static_cast<double>(high[axis] - low[axis] + 1);
    }
    return num_roots;
  }

  [[nodiscard]] std::vector<Cell> too_coarse_ones(const std::vector<Cell>& cells) const
  {
    std::vector<char> is_one(cells.size());
    for_each_chunk_in_threads(cells.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) is_one[i] = is_too_coarse(cells[i]) ? 1 : 0;
    });
    std::vector<Cell> ones;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (is_one[i] != 0) ones.push_back(cells[i]);
    }
    return ones;
  }

  // Sizes are asked for in the middles of the children.
  [[nodiscard]] bool is_too_coarse(const Cell& cell) const
  {
    const double side = side_at(halved_.size());
    const Vec3 center =
        side
        * Vec3{static_cast<double>(cell[0]) + 0.5, static_cast<double>(cell[1]) + 0.5,
               static_cast<double>(cell[2]) + 0.5};
    std::array<Vec3, 8> middles{};
    std::size_t num_middles = 0;
    for_each_cell(child_of(cell, 0), child_of(cell, 1), [&](const Cell& child) {
      Vec3& middle = middles[num_middles++];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        middle[axis] = 0.5 * side * (static_cast<double>(child[axis]) + 0.5);
      }
    });
    return space_.is_wanted_below(rms_edge(side) / kMostTooLong, middles)
           && space_.is_needed(center, 0.5 * std::numbers::sqrt3 * side);
  }

  [[nodiscard]] bool is_halved(const Cell& cell, std::size_t level) const
  {
    return level < halved_.size() && std::ranges::binary_search(halved_[level], cell);
  }

  // Halves the cells around those whose children are halved: all that touch them must be there.
  void grade()
  {
    for (auto& cells : halved_) sort_unique(cells);
    for (std::size_t level = halved_.size(); level-- > 1;) {
      for (const Cell& cell : halved_[level]) {
        for_each_cell({cell[0] - 1, cell[1] - 1, cell[2] - 1},
                      {cell[0] + 1, cell[1] + 1, cell[2] + 1},
                      [&](const Cell& beside) { halved_[level - 1].push_back(parent_of(beside)); });
      }
      sort_unique(halved_[level - 1]);
    }
  }

  void add_leaf(const Cell& cell, std::size_t level, std::vector<Place>& places) const
  {
    const std::size_t above = halved_.size() - level;
    const auto width = std::int64_t{2} << above;
    const Cell low{width * cell[0], width * cell[1], width * cell[2]};
    places.push_back({{low[0] + width / 2, low[1] + width / 2, low[2] + width / 2}, above});
    for_each_cell({0, 0, 0}, {1, 1, 1}, [&](const Cell& corner) {
      places.push_back(
          {{low[0] + width * corner[0], low[1] + width * corner[1], low[2] + width * corner[2]},
           above});
    });
  }

  [[nodiscard]] std::vector<LatticePoint> merged(std::vector<Place> places) const
  {
    std::ranges::sort(places);
    const double unit = 0.5 * side_at(halved_.size());
    std::vector<LatticePoint> points;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i > 0 && places[i].place == places[i - 1].place) continue;
      const auto& [x, y, z] = places[i].place;
      const double side = side_at(halved_.size() - places[i].levels_above_last);
      points.push_back({{unit * static_cast<double>(x), unit * static_cast<double>(y),
                         unit * static_cast<double>(z)},
                        side});
    }
    return points;
  }

  const LatticeSpace& space_;
  double root_side_;
  std::vector<Cell> roots_{};
  std::vector<std::vector<Cell>> halved_{};  // By level; sorted, as soon as graded.
};

}  // namespace

double cell_side(double rms_edge) { return rms_edge * std::sqrt(6.0 / 5.0); }

double rms_edge(double side) { return side / cell_side(1.0); }

std::vector<LatticePoint> octree_lattice(const Box& box, double unit, const LatticeSpace& space)
{
  Octree octree(box, rounded_to_eight_digits(unit), space);
  octree.build();
  return octree.points();
}

}  // namespace tessera::coarse

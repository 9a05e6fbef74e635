// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

namespace tessera {

/// @brief The cheapest triangulation of a ring of corners, by dynamic programming over its chords
/// (Klincsek): O(n^3) triangles are looked at. Local.
/// @tparam MostCorners Of a ring; without it rings may have any number, and tables lie on the heap.
template <std::size_t MostCorners = std::dynamic_extent>
class CheapestTriangulation {
 public:
  /// @param[in] may_be_chord Whether triangles may lie on both sides of the line between corners
  /// i and k: may_be_chord(i, k). Not asked for sides of the ring.
  /// @param[in] with_triangle The cost of triangle (i, j, k) and of what lies behind two of its
  /// sides, which has the cost `behind`: with_triangle(behind, i, j, k); i < j < k.
  template <class MayBeChord, class WithTriangle>
  CheapestTriangulation(std::size_t num_corners, const MayBeChord& may_be_chord,
                        const WithTriangle& with_triangle)
      : num_corners_(num_corners)
  {
    if constexpr (kIsAny) {
      cost_.resize(num_corners * num_corners);
      apex_.resize(num_corners * num_corners);
    }
    for (std::size_t i = 0; i + 1 < num_corners; ++i) cost_[row(i, i + 1)] = 0.0;
    for (std::size_t length = 2; length < num_corners; ++length) {
      for (std::size_t i = 0; i + length < num_corners; ++i) {
        const std::size_t k = i + length;
        cost_[row(i, k)] = kNever;
        if (length + 1 == num_corners || may_be_chord(i, k)) choose_apex(i, k, with_triangle);
      }
    }
  }

  /// @brief Infinite if there is no triangulation.
  [[nodiscard]] double cost() const { return cost_[row(0, num_corners_ - 1)]; }

  /// @brief The third corner of the triangle on line (i, k), between the two. @pre i + 1 < k.
  [[nodiscard]] std::size_t apex(std::size_t i, std::size_t k) const { return apex_[row(i, k)]; }

  /// @brief Calls use(i, j, k) for all triangles, i < j < k. @pre cost() is finite.
  template <class Use>
  void for_each_triangle(const Use& use) const
  {
    for_each_behind(0, num_corners_ - 1, use);
  }

 private:
  static constexpr bool kIsAny = MostCorners == std::dynamic_extent;
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  template <class T>
  using Table = std::conditional_t<kIsAny, std::vector<T>,
                                   std::array<T, kIsAny ? 1 : MostCorners * MostCorners>>;

  [[nodiscard]] std::size_t row(std::size_t i, std::size_t k) const
  {
    return i * (kIsAny ? num_corners_ : MostCorners) + k;
  }

  template <class WithTriangle>
  void choose_apex(std::size_t i, std::size_t k, const WithTriangle& with_triangle)
  {
    double& least = cost_[row(i, k)];
    for (std::size_t j = i + 1; j < k; ++j) {
      const double cost = with_triangle(cost_[row(i, j)] + cost_[row(j, k)], i, j, k);
      if (!(cost < least)) continue;
      least = cost;
      apex_[row(i, k)] = j;
    }
  }

  template <class Use>
  void for_each_behind(std::size_t i, std::size_t k, const Use& use) const
  {
    if (k < i + 2) return;
    const std::size_t j = apex(i, k);
    use(i, j, k);
    for_each_behind(i, j, use);
    for_each_behind(j, k, use);
  }

  std::size_t num_corners_;
  Table<double> cost_;       // Of what lies behind the line from corner to corner.
  Table<std::size_t> apex_;  // Of the triangle there.
};

}  // namespace tessera

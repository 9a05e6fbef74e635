// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/fields.hpp"
#include "tessera/base/types.hpp"
#include "tessera/mesh/lattice.hpp"

namespace tessera::mesh {

/// @brief Kinds of skeleton entities that carry inner lattice points.
enum class LatticeCarrier : std::int32_t { edge, triangle };
[[nodiscard]] constexpr LatticeCarrier last_value(LatticeCarrier /*type*/)
{
  return LatticeCarrier::triangle;
}

/// @brief Names a lattice point that is born on a skeleton edge or triangle. The point has the same
/// key at every number of levels, so a plan made on few levels holds for more.
struct LatticePointKey {
  LatticeCarrier carrier = LatticeCarrier::edge;
  LocalIndex entity = kNoIndex;  ///< Row of the skeleton's edges or triangles.
  LocalIndex index = 0;          ///< Place among the inner points of the finest lattice there is.

  static auto fields(auto& self) { return std::tie(self.carrier, self.entity, self.index); }

  /// @brief Inner point `k` of an edge with `n` intervals.
  [[nodiscard]] static LatticePointKey on_edge(LocalIndex edge, LocalIndex n, LocalIndex k)
  {
    return {LatticeCarrier::edge, edge, k * (kFinest / n) - 1};
  }

  /// @brief Inner point `p` of a triangle with `n` intervals a side.
  [[nodiscard]] static LatticePointKey on_triangle(LocalIndex triangle, LocalIndex n,
                                                   const lattice::TrianglePoint& p)
  {
    const LocalIndex scale = kFinest / n;
    return {LatticeCarrier::triangle, triangle,
            lattice::inner_triangle_index(kFinest, p.i * scale, p.j * scale)};
  }

  friend auto operator<=>(const LatticePointKey&, const LatticePointKey&) = default;

 private:
  static constexpr LocalIndex kFinest = lattice::intervals(lattice::kMaxLevels);
};

/// @brief How far a point goes from its midpoint (0) to its projection (1).
struct PointLimit {
  LatticePointKey key{};
  double factor = 1.0;

  static auto fields(auto& self) { return std::tie(self.key, self.factor); }

  friend bool operator==(const PointLimit&, const PointLimit&) = default;
};

/// @brief The result of the plan stage: a sparse list of points whose projection is held back so
/// that no skin folds. Points that are not listed go all the way.
class ProjectionLimiter {
 public:
  ProjectionLimiter() = default;

  /// @brief Keeps the smallest factor of each point. Entries in any order.
  explicit ProjectionLimiter(std::vector<PointLimit> entries);

  /// @brief Factor of a point, 1 if it is not listed. O(log n); O(1) when the list is empty.
  [[nodiscard]] double factor(const LatticePointKey& key) const;

  [[nodiscard]] std::span<const PointLimit> entries() const { return entries_; }

  /// @throws InputError unless keys ascend and every factor is in [0, 1].
  void require_sound() const;

  /// @brief Whether both hold back the same points by the same factors.
  friend bool operator==(const ProjectionLimiter&, const ProjectionLimiter&) = default;

 private:
  friend FieldAccess;

  static auto fields(auto& self) { return std::tie(self.entries_); }

  std::vector<PointLimit> entries_{};  ///< By ascending key.
};

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::delaunay {

// A *corner* is 4 t + c: corner c of tet t, and the face opposite to it.
using Corner = LocalIndex;

[[nodiscard]] constexpr LocalIndex tet_of(Corner corner) noexcept { return corner >> 2; }

// Delaunay tets while points are put in. What is gone leaves a free slot.
//
// One vertex is at infinity. Tets that have it are *ghosts*: they lie across the faces of the hull,
// so each face has two tets. A ghost is positive if a point beyond its face is put in its place.
class Triangulation {
 public:
  // The first tet of these positions, of which no two are the same.
  // @throws MeshError if all lie on one plane.
  explicit Triangulation(std::vector<Vec3> points);

  // Puts in the vertices that are not of the first tet, in their order.
  void insert_all();

  [[nodiscard]] LocalIndex num_slots() const { return static_cast<LocalIndex>(tets_.size()); }
  // Whether a slot has a tet, and no ghost.
  [[nodiscard]] bool has_tet(LocalIndex slot) const;
  [[nodiscard]] std::span<const LocalIndex, 4> vertices(LocalIndex tet) const
  {
    return tets_[at(tet)].vertices;
  }
  [[nodiscard]] Corner across(Corner corner) const
  {
    return tets_[at(tet_of(corner))].across[at(corner & 3)];
  }

 private:
  // All tets and ghosts have four neighbours. What is read together lies together.
  struct alignas(32) Tet {
    std::array<LocalIndex, 4> vertices{};
    std::array<Corner, 4> across{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
  };

  [[nodiscard]] std::array<LocalIndex, 4> first_tet() const;
  void add_first_tets(const std::array<LocalIndex, 4>& first);
  LocalIndex add_tet(const std::array<LocalIndex, 4>& vertices);
  [[nodiscard]] Corner& across(Corner corner)
  {
    return tets_[at(tet_of(corner))].across[at(corner & 3)];
  }
  void link(Corner a, Corner b);

  [[nodiscard]] bool is_ghost(LocalIndex tet) const;
  [[nodiscard]] int side_with(const Vec3& point, Corner corner) const;
  [[nodiscard]] bool is_in_sphere(LocalIndex tet, const Vec3& point) const;
  [[nodiscard]] bool is_destroyed_by(const Vec3& point, LocalIndex tet) const;

  void insert(LocalIndex vertex);
  [[nodiscard]] LocalIndex find_destroyed(const Vec3& point) const;
  void find_cavity(LocalIndex first, LocalIndex vertex);
  void fill_cavity(LocalIndex vertex);
  [[nodiscard]] Corner across_side(Corner face, LocalIndex side) const;
  [[nodiscard]] LocalIndex place_of(LocalIndex vertex, LocalIndex tet) const;

  std::vector<Vec3> points_;
  std::vector<Tet> tets_{};
  std::vector<LocalIndex> tet_tested_{};  // Shape (num_slots): which vertex was last tested, and
                                          // whether it destroys the tet.
  std::vector<LocalIndex> free_slots_{};
  LocalIndex last_ = 0;  // A tet that was made last, no ghost: where the next walk begins.

  // Of one insertion; kept for their memory.
  std::vector<LocalIndex> cavity_{};       // Tets that go.
  std::vector<Corner> cavity_boundary_{};  // Their corners across which tets stay.
};

}  // namespace tessera::delaunay

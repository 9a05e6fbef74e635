// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/triangle_grading.hpp"

#include "subdomain/refine/split_surface.hpp"

namespace tessera::subdomain {

// A point of a triangle of the skeleton, in the lattice that this has after the split.
struct SkeletonPoint {
  LocalIndex triangle = kNoIndex;
  mesh::lattice::TrianglePoint p{};
};

// What layers call points of the skeleton after a split: those of a host are counted densely, also
// where its small triangles are no lattice.
class SplitNames {
 public:
  // Borrowed.
  SplitNames(const SplitSurface& surface, const mesh::Skeleton& skeleton);

  [[nodiscard]] mesh::HostEntity host_of(const SkeletonPoint& point) const;
  [[nodiscard]] mesh::HostPoint of(const SkeletonPoint& point);

  // Of a vertex that was there before the split.
  // @param[in] before Its name by the skeleton.
  [[nodiscard]] mesh::HostPoint of(const mesh::HostPoint& before);

 private:
  const mesh::SplitPointNumbers& numbers_of(LocalIndex triangle);

  const SplitSurface& surface_;
  const mesh::Skeleton& skeleton_;
  mesh::HostLayout hosts_;
  std::map<LocalIndex, mesh::SplitPointNumbers> numbers_{};  // By triangle.
};

}  // namespace tessera::subdomain

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::coarse {

using Tet = std::array<LocalIndex, 4>;

// Tets that go, and those that come in their place.
class TetChanges {
 public:
  explicit TetChanges(const mesh::CoarseMesh& mesh) : is_gone_(at(mesh.num_tets()), 0) {}

  [[nodiscard]] bool is_gone(LocalIndex t) const { return is_gone_[at(t)] != 0; }
  void remove(LocalIndex t) { is_gone_[at(t)] = 1; }
  // The new tet takes the material of tet `old`.
  void add(const Tet& tet, LocalIndex old);

  // Tets that stay keep their order; new ones follow. The old row of each tet, and of new ones that
  // of the tet they were added for.
  std::vector<LocalIndex> apply(mesh::CoarseMesh& mesh) const;

 private:
  std::vector<char> is_gone_;
  std::vector<Tet> new_tets_{};
  std::vector<LocalIndex> old_{};  // Shape (num_new_tets).
};

}  // namespace tessera::coarse

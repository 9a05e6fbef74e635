// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief Sides of a coarse mesh that are images of others: of a periodic side somewhere else, or
/// of the other side of a split, at the same place.
///
/// The vertices of a face and of its image have the same order. So what is made of the two has the
/// same form.
struct SideImages {
  std::vector<Affine> transforms{};  ///< The first is the identity, that of splits; or empty.
  /// Shape (num_patches), or empty: the patch whose image a patch is, or kNoIndex.
  FlatArray<LocalIndex> patch_origin{};
  /// Shape (num_patches), or empty: row of `transforms` that leads there from the origin.
  FlatArray<LocalIndex> patch_transform{};
  /// Shape (num_faces), or empty: the face whose image a face is, or kNoIndex.
  FlatArray<LocalIndex> face_origin{};

  static auto fields(auto& self)
  {
    return std::tie(self.transforms, self.patch_origin, self.patch_transform, self.face_origin);
  }

  [[nodiscard]] bool are_none() const { return transforms.empty(); }

  /// @brief Whether the patch is the minus side of a split.
  [[nodiscard]] bool is_of_split(LocalIndex patch) const
  {
    return !are_none() && patch_origin[at(patch)] != kNoIndex && patch_transform[at(patch)] == 0;
  }
};

}  // namespace tessera::mesh

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief Sides of a coarse mesh that are images of others: of a periodic side somewhere else, or
/// of the other side of a split or a joint, at the same place.
///
/// A *joint* is a patch between two materials that is open for layers. These end at the points of
/// the other side, so the mesh is closed there.
///
/// The vertices of a face and of its image have the same order. So what is made of the two has the
/// same form.
struct SideImages {
  /// The first is the identity, that of splits and joints; or empty.
  std::vector<Affine> transforms{};
  /// Shape (num_patches), or empty: the patch whose image a patch is, or kNoIndex.
  FlatArray<LocalIndex> patch_origin{};
  /// Shape (num_patches), or empty: row of `transforms` that leads there from the origin.
  FlatArray<LocalIndex> patch_transform{};
  FlatArray<char> patch_is_joint{};  ///< Shape (num_patches), or empty: whether it is of a joint.
  /// Shape (num_faces), or empty: the face whose image a face is, or kNoIndex.
  FlatArray<LocalIndex> face_origin{};

  static auto fields(auto& self)
  {
    return std::tie(self.transforms, self.patch_origin, self.patch_transform, self.patch_is_joint,
                    self.face_origin);
  }

  [[nodiscard]] bool are_none() const { return transforms.empty(); }

  /// @brief Images of nothing yet: the identity alone.
  void begin(LocalIndex num_patches, LocalIndex num_faces)
  {
    transforms.assign(1, {});
    patch_origin.assign(at(num_patches), kNoIndex);
    patch_transform.assign(at(num_patches), 0);
    patch_is_joint.assign(at(num_patches), 0);
    face_origin.assign(at(num_faces), kNoIndex);
  }

  /// @brief Whether the patch is a side of a joint.
  [[nodiscard]] bool is_joint(LocalIndex patch) const
  {
    return !are_none() && patch_is_joint[at(patch)] != 0;
  }

  /// @brief Whether the patch is the minus side of a joint. Files have the other one alone.
  [[nodiscard]] bool is_minus_of_joint(LocalIndex patch) const
  {
    return is_joint(patch) && patch_origin[at(patch)] != kNoIndex;
  }

  /// @brief Whether the patch is the minus side of a split.
  [[nodiscard]] bool is_of_split(LocalIndex patch) const
  {
    return !are_none() && patch_origin[at(patch)] != kNoIndex && patch_transform[at(patch)] == 0
           && !is_joint(patch);
  }
};

}  // namespace tessera::mesh

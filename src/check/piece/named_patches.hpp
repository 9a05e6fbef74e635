// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "check/piece/mesh.hpp"

namespace tessera::check {

/// @brief Which triangles of a boundary piece are on patches of a kind.
class NamedPatches {
 public:
  /// @param[in] is_one Tells by the name of a patch.
  template <class IsOne>
  NamedPatches(const PieceMesh& mesh, const IsOne& is_one)
  {
    const auto patches = mesh.arrays.cell_ints.find("patch");
    const auto names = mesh.arrays.field_texts.find("patch_names");
    if (patches == mesh.arrays.cell_ints.end() || names == mesh.arrays.field_texts.end()) return;
    patches_ = patches->second;
    for (const std::string& name : names->second) is_one_.push_back(is_one(name));
  }

  [[nodiscard]] bool have(LocalIndex cell) const
  {
    if (patches_.empty()) return false;
    const auto patch = static_cast<std::size_t>(patches_[static_cast<std::size_t>(cell)]);
    return patch < is_one_.size() && is_one_[patch];
  }

 private:
  std::span<const std::int32_t> patches_{};
  std::vector<bool> is_one_{};  // By patch.
};

/// @brief Those on one side of a split. @param[in] side 0: plus, 1: minus.
[[nodiscard]] inline NamedPatches patches_of_splits(const PieceMesh& mesh, std::ptrdiff_t side)
{
  return {mesh, [side, split = mesh.split_patches()](const std::string& name) {
            const auto found = std::ranges::find(split, name) - split.begin();
            return found < std::ssize(split) && found % 2 == side;
          }};
}

/// @brief Those with one material on both sides.
[[nodiscard]] inline NamedPatches patches_inside(const PieceMesh& mesh)
{
  return {mesh, [inside = mesh.inside_patches()](const std::string& name) {
            return std::ranges::find(inside, name) != inside.end();
          }};
}

}  // namespace tessera::check

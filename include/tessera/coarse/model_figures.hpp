// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

#include "tessera/base/types.hpp"

namespace tessera::coarse {

/// @brief What a model has, as far as it says how long its coarse mesh may take and how large its
/// mesh becomes. Area and volume are estimates, of triangles that follow curved faces roughly.
struct ModelFigures {
  LocalIndex num_faces = 0;
  double area = 0.0;             ///< Of all faces, length unit squared.
  double volume = 0.0;           ///< Of all solids, length unit cubed; 0: not known.
  LocalIndex num_triangles = 0;  ///< Of the file, if it has any.

  static auto fields(auto& self)
  {
    return std::tie(self.num_faces, self.area, self.volume, self.num_triangles);
  }
};

}  // namespace tessera::coarse

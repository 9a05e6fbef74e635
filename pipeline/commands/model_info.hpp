// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tessera/model/description.hpp"
#include "tessera/model/model.hpp"

namespace tessera::pipeline {

/// @brief An edge length for `tessera mesh MODEL --size`, and about how many tets it makes.
struct SuggestedSize {
  std::string name{};  ///< "coarse", "medium", "fine".
  double size = 0.0;   ///< File length unit.
  double num_tets = 0.0;
};

/// @brief How much there is of a model, in file length units.
struct Extent {
  double volume = 0.0;  ///< Of all solids, > 0.
  double area = 0.0;    ///< Of all faces.
};

/// @brief Two solids that share faces.
struct Touch {
  std::array<LocalIndex, 2> solids{};  ///< From 1, ascending.
  LocalIndex num_faces = 0;
  double area = 0.0;  ///< File length unit squared.
};

/// @brief All of them, by numbers. Local. @pre description.require_sound() does not throw.
[[nodiscard]] std::vector<Touch> touches_of(const model::ModelDescription& description);

/// @brief Of a model. Local.
[[nodiscard]] Extent extent_of(const model::ModelDescription& description);

/// @brief About how many tets an edge length makes: (`per_cube` + `per_thinness` * thinness²) *
/// volume / size³, where thinness is area * size / volume. Up to twice or half of it.
struct TetsOfSize {
  double per_cube = 0.0;
  double per_thinness = 0.0;
};
[[nodiscard]] TetsOfSize tets_of_size();

/// @brief The size that makes about so many tets. Local.
[[nodiscard]] double size_for(const Extent& extent, double num_tets);

/// @brief Two digits, such as 1.3 or 0.087: nobody wants to type more. Local.
[[nodiscard]] double rounded_size(double size);

/// @brief Three sizes that suit a model. Local.
[[nodiscard]] std::vector<SuggestedSize> suggested_sizes(const Extent& extent);

/// @brief What `tessera info MODEL` prints. Local. @pre description.require_sound() does not throw.
/// @param[in] lists_edges Whether each edge gets a line; else they are only counted.
[[nodiscard]] std::string model_text(const model::ModelSource& source,
                                     const model::ModelDescription& description, bool lists_edges);

/// @brief The same as JSON, with all edges. Local. @pre As model_text().
[[nodiscard]] std::string model_json(const model::ModelSource& source,
                                     const model::ModelDescription& description);

}  // namespace tessera::pipeline

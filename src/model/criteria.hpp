// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/options.hpp"

namespace tessera::model {

/// @brief One thing that faces or solids must have, as `[[geometry.name]]` gives it.
struct Criterion {
  std::string text{};           ///< For messages: "pattern = \"in*\"".
  std::vector<bool> fits{};     ///< By row of the description.
  std::string what_there_is{};  ///< If nothing fits.
};

/// @brief Faces or solids of a description, for messages.
struct PartKind {
  std::string_view word{};            ///< "face", "solid".
  std::vector<LocalIndex> numbers{};  ///< By row.
};

/// @brief "1-4, 7" of ascending numbers. Local.
[[nodiscard]] std::string ranges_text(std::span<const LocalIndex> numbers);

/// @brief Holds the criteria of an entry against a model.
class CriteriaTest {
 public:
  /// @param[in] model Must outlive it.
  CriteriaTest(const ModelDescription& model, double scale);

  [[nodiscard]] PartKind faces() const;
  [[nodiscard]] PartKind solids() const;

  /// @brief Those that are given, at least one.
  /// @throws ConfigError if a number is none of the model's.
  [[nodiscard]] std::vector<Criterion> criteria(const FaceCriteria& of) const;
  [[nodiscard]] std::vector<Criterion> criteria(const SolidCriteria& of) const;

 private:
  [[nodiscard]] Criterion of_numbers(std::string_view key, const std::vector<LocalIndex>& wanted,
                                     const PartKind& kind) const;
  [[nodiscard]] Criterion of_normal(const FaceCriteria& of) const;
  [[nodiscard]] Criterion of_box(const Vec3& min, const Vec3& max,
                                 const std::vector<Box>& boxes) const;

  const ModelDescription* model_;
  std::vector<Box> face_boxes_{};  // Output length unit.
  std::vector<Box> solid_boxes_{};
  Box box_{};
};

}  // namespace tessera::model

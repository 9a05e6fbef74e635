// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/types.hpp"

/// How files of OpenFOAM are written, those of meshes in its binary form with labels of 32 bits.
namespace tessera::formats {

/// @brief What the head of a file says of it.
struct FoamKind {
  std::string_view format = "binary";
  std::string_view kind{};  ///< Such as "labelList".
  std::string_view location = "constant/polyMesh";
  std::string note{};
};

/// @brief The head of a file. Local.
[[nodiscard]] std::string foam_header(const FoamKind& kind, std::string_view name);

/// @brief What stands before and after the values of a list; nothing but its length if it is empty.
[[nodiscard]] std::string foam_list_head(GlobalIndex length);
[[nodiscard]] std::string_view foam_list_tail(GlobalIndex length);

/// @brief The bytes of values as they stand in a list. Local.
template <class Value>
[[nodiscard]] std::string_view foam_bytes(std::span<const Value> values)
{
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

/// @brief A whole list. Local.
template <class Value>
[[nodiscard]] std::string foam_list(std::span<const Value> values, GlobalIndex length)
{
  std::string text = foam_list_head(length);
  return text.append(foam_bytes(values)).append(foam_list_tail(length));
}
[[nodiscard]] std::string foam_labels(std::span<const std::int32_t> labels);

/// @brief The partner of a periodic patch.
struct FoamCyclic {
  std::string neighbour{};
  Affine there{};  ///< Leads to the partner.
};

/// @brief A patch of the file `boundary`.
struct FoamBoundary {
  std::string name{};
  GlobalIndex num_faces = 0;
  GlobalIndex first_face = 0;
  LocalIndex processor = kNoIndex;        ///< Set if it is between two processors: whose it is.
  LocalIndex other_processor = kNoIndex;  ///< And the one behind it.
  std::optional<FoamCyclic> cyclic{};     ///< Set if it is periodic.
  std::string through{};  ///< Of a patch between two processors: the periodic patch that it is of.
};

/// @brief The file `boundary`. Local.
[[nodiscard]] std::string foam_boundary(const std::vector<FoamBoundary>& patches);

/// @brief The head of one zone in the file `cellZones`, up to its list. Local.
[[nodiscard]] std::string foam_zone_head(const std::string& name);
inline constexpr std::string_view kFoamZoneTail = ";\n}\n";

/// @brief Names as words of OpenFOAM: letters, digits and "_-." with a letter or "_" first, all
/// else as "_"; of equal ones the later get "_2", "_3", … Local.
[[nodiscard]] std::vector<std::string> foam_words(const std::vector<std::string>& names);

}  // namespace tessera::formats

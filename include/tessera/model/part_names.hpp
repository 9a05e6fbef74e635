// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/options.hpp"

namespace tessera::model {

/// @brief A number of `tessera info` and the name that it got.
struct NumberedName {
  LocalIndex number = 0;
  std::string name{};

  static auto fields(auto& self) { return std::tie(self.number, self.name); }
  friend bool operator==(const NumberedName&, const NumberedName&) = default;
};

/// @brief The faces and solids that got names, each by number.
struct NamedParts {
  std::vector<NumberedName> faces{};
  std::vector<NumberedName> solids{};

  static auto fields(auto& self) { return std::tie(self.faces, self.solids); }
};

/// @brief Unit normals of the triangles of each face. Triangles too thin to have one are left out.
/// Local.
[[nodiscard]] std::vector<std::vector<Vec3>> face_normals(const ModelDescription& model);

/// @brief Which faces and solids the names are of. Local; a pure function.
/// @param[in] scale Output length units per file length unit.
/// @pre model.require_sound() and defect_of() find nothing.
/// @throws ConfigError naming the entry if it fits nothing, with what there is, or if a face or
/// solid gets two names.
[[nodiscard]] NamedParts find_named_parts(const ModelDescription& model,
                                          std::span<const PartName> names, double scale);

/// @brief Gives patches and materials their names. Patches that then have the same name, and have
/// it from `parts` at least once, get one row in files. Local.
void apply_names(const NamedParts& parts, mesh::CoarseMesh& coarse);

}  // namespace tessera::model

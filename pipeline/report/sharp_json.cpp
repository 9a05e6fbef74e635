// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/sharp_json.hpp"

#include <fmt/format.h>

#include "tessera/subdomain/piece_arrays.hpp"

namespace tessera::pipeline {

Json sharp_json(const coarse::SharpTets& sharp, const mesh::CoarseMesh& coarse)
{
  const std::vector<std::string> names = subdomain::names_of_rows(coarse);
  Json worst = Json::array();
  for (const coarse::SharpTet& tet : sharp.worst) {
    Json patches = Json::array();
    for (const LocalIndex patch : tet.patches) patches.push_back(names.at(at(patch)));
    worst.push_back({{"min_dihedral_deg", tet.angle_deg},
                     {"shortest_edge", tet.shortest_edge},
                     {"centre", tet.centre},
                     {"patches", patches}});
  }
  return {{"below_deg", kSharpAngle_deg},
          {"num_tets", sharp.num_others},
          {"num_forced", sharp.num_forced},
          {"worst", worst}};
}

std::optional<std::string> sharp_warning(const coarse::SharpTets& sharp)
{
  if (sharp.num_others == 0) return std::nullopt;
  const coarse::SharpTet& worst = sharp.worst.front();
  return fmt::format(
      "{} coarse tets have an angle below {:g} degrees that no sharp angle of the model forces, "
      "the "
      "smallest {:.2g} at ({:g}), with an edge of {:.2g}; size.min merges short edges and narrow "
      "faces of the model up to the length it is given",
      sharp.num_others, kSharpAngle_deg, worst.angle_deg, fmt::join(worst.centre, ", "),
      worst.shortest_edge);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/sharp_json.hpp"

#include "tessera/subdomain/piece_arrays.hpp"

#include "pipeline/stages/coarse/coarse_warnings.hpp"

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

}  // namespace tessera::pipeline

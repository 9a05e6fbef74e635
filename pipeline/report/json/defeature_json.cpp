// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/defeature_json.hpp"

#include <algorithm>
#include <vector>

#include "pipeline/stages/coarse/coarse_warnings.hpp"

namespace tessera::pipeline {
namespace {

Json parts_json(const std::vector<surface::MergedPart>& parts, const char* measure)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(kMostMergedNamed, parts.size()); ++i) {
    list.push_back({{"number", parts[i].number + 1},
                    {"centre", parts[i].centre},
                    {measure, parts[i].measure}});
  }
  return list;
}

}  // namespace

Json defeatured_json(const CoarseResult& coarse)
{
  const surface::Defeatured& merged = coarse.defeatured;
  Json faces = parts_json(merged.patches, "area");
  for (std::size_t i = 0; i < faces.size(); ++i) {
    faces[i]["name"] = name_of_merged_face(merged.patches[i].number, coarse.mesh);
  }
  return {{"tolerance", coarse.options.defeature},
          {"num_edges", merged.curves.size()},
          {"edges", parts_json(merged.curves, "length")},
          {"num_faces", merged.patches.size()},
          {"faces", faces},
          {"num_vertices", coarse.distance.num_merged},
          {"distance_max", coarse.distance.largest_merged}};
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/defeature_json.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace tessera::pipeline {
namespace {

constexpr std::size_t kMostListed = 20;

Json parts_json(const std::vector<surface::MergedPart>& parts, const char* measure)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(kMostListed, parts.size()); ++i) {
    list.push_back({{"number", parts[i].number + 1},
                    {"centre", parts[i].centre},
                    {measure, parts[i].measure}});
  }
  return list;
}

std::string name_of(LocalIndex surface, const mesh::CoarseMesh& mesh)
{
  const auto found = std::ranges::find(mesh.patch_surface, surface);
  if (found == mesh.patch_surface.end()) return {};
  return mesh.patch_names[static_cast<std::size_t>(found - mesh.patch_surface.begin())];
}

}  // namespace

Json defeatured_json(const CoarseResult& coarse)
{
  const surface::Defeatured& merged = coarse.defeatured;
  Json faces = parts_json(merged.patches, "area");
  for (std::size_t i = 0; i < faces.size(); ++i) {
    faces[i]["name"] = name_of(merged.patches[i].number, coarse.mesh);
  }
  return {{"tolerance", coarse.options.defeature},
          {"num_edges", merged.curves.size()},
          {"edges", parts_json(merged.curves, "length")},
          {"num_faces", merged.patches.size()},
          {"faces", faces},
          {"num_vertices", coarse.distance.num_merged},
          {"distance_max", coarse.distance.largest_merged}};
}

std::string defeatured_words(const CoarseResult& coarse)
{
  const surface::Defeatured& merged = coarse.defeatured;
  std::vector<std::string> faces;
  for (std::size_t i = 0; i < std::min(kMostListed, merged.patches.size()); ++i) {
    faces.push_back(name_of(merged.patches[i].number, coarse.mesh));
  }
  return fmt::format(
      "what is smaller than {:g} was merged (size.min), {} edges and {} faces of the model{}{}; {} "
      "vertices are off the geometry by at most {:.3g} for it",
      merged.tolerance, merged.curves.size(), merged.patches.size(), faces.empty() ? "" : ": ",
      fmt::join(faces, ", "), coarse.distance.num_merged, coarse.distance.largest_merged);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_warnings.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace tessera::pipeline {
namespace {

// In wanted sizes. A mesh is made finer from 1.5 on; where that works, some edges still have as
// much, and next to none twice the size.
constexpr double kMostMissed = 2.0;

}  // namespace

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

std::optional<std::string> size_warning(const CoarseResult& coarse)
{
  const sizing::PartInSizes& longest = coarse.missed_size;
  if (longest.in_sizes == 0.0) return std::nullopt;
  return fmt::format(
      "no finer coarse mesh could be made for the wanted sizes, so the one before stays: near "
      "({:.6g}) "
      "edges of {:.3g} are wanted, and they are up to {:.3g} times as long",
      fmt::join(longest.place, ", "), longest.size, longest.in_sizes);
}

bool misses_sizes(const CoarseResult& coarse) { return coarse.missed_size.in_sizes > kMostMissed; }

std::string name_of_merged_face(LocalIndex face, const mesh::CoarseMesh& mesh)
{
  const auto found = std::ranges::find(mesh.patch_surface, face);
  if (found == mesh.patch_surface.end()) return {};
  return mesh.patch_names[static_cast<std::size_t>(found - mesh.patch_surface.begin())];
}

std::string defeatured_words(const CoarseResult& coarse)
{
  const surface::Defeatured& merged = coarse.defeatured;
  std::vector<std::string> faces;
  for (std::size_t i = 0; i < std::min(kMostMergedNamed, merged.patches.size()); ++i) {
    faces.push_back(name_of_merged_face(merged.patches[i].number, coarse.mesh));
  }
  return fmt::format(
      "what is smaller than {:g} was merged (size.min), {} edges and {} faces of the model{}{}; {} "
      "vertices are off the geometry by at most {:.3g} for it",
      merged.tolerance, merged.curves.size(), merged.patches.size(), faces.empty() ? "" : ": ",
      fmt::join(faces, ", "), coarse.distance.num_merged, coarse.distance.largest_merged);
}

}  // namespace tessera::pipeline

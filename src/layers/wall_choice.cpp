// SPDX-License-Identifier: BSD-3-Clause
#include "layers/wall_choice.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/name_patterns.hpp"
#include "tessera/mesh/face_tets.hpp"

namespace tessera::layers {
namespace {

// Which patches of a mesh can be walls.
class WallChoice {
 public:
  explicit WallChoice(const mesh::CoarseMesh& mesh)
      : mesh_(mesh),
        final_names_(mesh::final_patch_names(mesh)),
        bodies_(mesh::body_names(mesh)),
        bodies_behind_(at(mesh.num_patches())),
        obstacles_(at(mesh.num_patches()))
  {
    const std::vector<mesh::TriangleTets> faces = mesh::tets_of_faces(mesh);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto patch = at(mesh.face_patch[f]);
      if (faces[f].tets[1] != kNoIndex) obstacles_[patch] = kInnerObstacle;
      for (const LocalIndex tet : faces[f].tets) {
        if (tet != kNoIndex) bodies_behind_[patch].insert(mesh.body(mesh.tet_material[at(tet)]));
      }
    }
    for (LocalIndex p = 0; p < static_cast<LocalIndex>(mesh.images.patch_origin.size()); ++p) {
      const LocalIndex origin = mesh.images.patch_origin[at(p)];
      if (origin == kNoIndex || mesh.images.patch_transform[at(p)] == 0) continue;
      obstacles_[at(p)] = obstacles_[at(origin)] = kPeriodicObstacle;
    }
  }

  // The patches that an entry fits. Those that can be no wall are left out; it is an error if
  // nothing is left.
  [[nodiscard]] std::vector<bool> walls_of(const LayerOptions& entry) const
  {
    std::vector<bool> fits = patches_that_fit(entry);
    const std::vector<LocalIndex> solids =
        entry.side.empty() ? std::vector<LocalIndex>{} : matching_solids(entry.side, bodies_);
    std::string obstacle;
    for (std::size_t p = 0; p < fits.size(); ++p) {
      const std::string found =
          fits[p] ? obstacle_of(static_cast<LocalIndex>(p), entry, solids) : "";
      if (found.empty()) continue;
      fits[p] = false;
      if (mesh_.patch_names[p] == entry.patch) obstacle = found;
    }
    if (std::ranges::count(fits, true) > 0) return fits;
    if (!obstacle.empty()) {
      throw ConfigError(fmt::format("patch \"{}\" lies {}", entry.patch, obstacle));
    }
    throw ConfigError(
        fmt::format("no patch that \"{}\" fits can have layers{}: these are for the outside of the "
                    "model but sides of [[periodic]], for the sides of a [[split]], and, with "
                    "side = for one of them, for patches between two solids",
                    entry.patch, entry.side.empty() ? "" : " in \"" + entry.side + "\""));
  }

  // With _plus or _minus, if it is a side of a split.
  [[nodiscard]] const std::string& final_name(std::size_t patch) const
  {
    return final_names_[patch];
  }

 private:
  static constexpr const char* kInnerObstacle =
      "inside of the model; layers there are for the sides of a [[split]], and between two solids "
      "for the one that side = names";
  static constexpr const char* kPeriodicObstacle =
      "on a side of [[periodic]]; layers end there, and go on from its partner";

  // A split patch by its own name, or one of its sides by that of the side.
  [[nodiscard]] std::vector<bool> patches_that_fit(const LayerOptions& entry) const
  {
    std::vector<bool> fits(final_names_.size());
    for (std::size_t p = 0; p < fits.size(); ++p) {
      fits[p] = matches_pattern(entry.patch, mesh_.patch_names[p])
                || matches_pattern(entry.patch, final_names_[p]);
    }
    return std::ranges::count(fits, true) > 0 ? fits
                                              : matching_names("patch", entry.patch, final_names_);
  }

  // Empty: there is none. @param[in] solids That the side fits.
  [[nodiscard]] std::string obstacle_of(LocalIndex patch, const LayerOptions& entry,
                                        const std::vector<LocalIndex>& solids) const
  {
    const std::string& obstacle = obstacles_[at(patch)];
    if (entry.side.empty() && obstacle.empty()) {
      return mesh_.images.is_joint(patch) && !mesh_.is_wake(patch) ? kInnerObstacle : "";
    }
    const std::set<LocalIndex>& behind = bodies_behind_[at(patch)];
    const auto is_named = [&](LocalIndex body) { return std::ranges::binary_search(solids, body); };
    const bool is_beside = obstacle.empty() ? std::ranges::all_of(behind, is_named)
                                            : std::ranges::any_of(behind, is_named);
    if (entry.side.empty() || is_beside) return obstacle;
    return fmt::format("beside other solids than \"{}\"", entry.side);
  }

  const mesh::CoarseMesh& mesh_;
  std::vector<std::string> final_names_;
  std::vector<std::string> bodies_;
  std::vector<std::set<LocalIndex>> bodies_behind_;  // Of each patch.
  std::vector<std::string> obstacles_;               // Of each patch; empty: it can be a wall.
};

std::string text_of(const LayerOptions& entry)
{
  return entry.side.empty() ? fmt::format("\"{}\"", entry.patch)
                            : fmt::format("\"{}\" in \"{}\"", entry.patch, entry.side);
}

}  // namespace

std::vector<LocalIndex> entries_of_patches(const mesh::CoarseMesh& mesh,
                                           std::span<const LayerOptions> options)
{
  const WallChoice choice(mesh);
  std::vector<LocalIndex> entries(at(mesh.num_patches()), kNoIndex);
  for (std::size_t i = 0; i < options.size(); ++i) {
    const std::vector<bool> walls = choice.walls_of(options[i]);
    for (std::size_t p = 0; p < walls.size(); ++p) {
      if (!walls[p]) continue;
      if (entries[p] != kNoIndex) {
        throw ConfigError(fmt::format("patch \"{}\" fits {} and {}; it must fit one entry only",
                                      choice.final_name(p), text_of(options[at(entries[p])]),
                                      text_of(options[i])));
      }
      entries[p] = static_cast<LocalIndex>(i);
    }
  }
  return entries;
}

}  // namespace tessera::layers

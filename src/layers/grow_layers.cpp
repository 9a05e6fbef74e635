// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/layers/grow_layers.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/name_patterns.hpp"
#include "tessera/mesh/face_tets.hpp"

#include "layers/interior.hpp"
#include "layers/wall_mover.hpp"
#include "layers/wall_surface.hpp"

namespace tessera::layers {
namespace {

// So many steps; after each the tets are made better. Then some more for what was held back.
constexpr int kSteps = 6;
constexpr int kMoreSteps = 3;

constexpr double kCovered = 0.1;
constexpr double kFull = 0.9;

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
    if (entry.side.empty() && obstacle.empty())
      return mesh_.images.is_joint(patch) ? kInnerObstacle : "";
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

// Which entry each patch has, or kNoIndex.
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

void require_thinner_than_model(const mesh::CoarseMesh& mesh, std::span<const LayerOptions> options)
{
  const double diagonal = box_diagonal(mesh.vertex_xyz);
  for (const LayerOptions& one : options) {
    if (thickness(one) <= diagonal) continue;
    throw ConfigError(fmt::format(
        "the {} layers of \"{}\" are {:g} thick, and the diagonal of the model's box is "
        "{:g}; choose a smaller {}",
        num_layers(one), one.patch, thickness(one), diagonal,
        one.thickness > 0.0 ? "thickness" : "first, growth or count"));
  }
}

LayerCover measure(const mesh::CoarseMesh& mesh, const WallMover& mover)
{
  std::map<LocalIndex, PatchCover> covers;
  const WallSurface& walls = mover.walls();
  for (const SurfaceTriangle& triangle : walls.triangles) {
    if (!triangle.is_wall) continue;
    std::array<Vec3, 3> corners{};
    double least = 1.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto row = at(walls.wall_of_vertex[at(triangle.vertices[c])]);
      const WallVertex& vertex = walls.vertices[row];
      corners[c] = vertex.wall;
      const double wanted = norm(vertex.column);
      const double found = norm(mesh.position(vertex.vertex) - vertex.wall);
      least = std::min(least, wanted > 0.0 ? found / wanted : 0.0);
    }
    const LocalIndex patch = mesh.face_patch[at(triangle.face)];
    PatchCover& cover = covers[patch];
    cover.patch = patch;
    const double area = triangle_area(corners[0], corners[1], corners[2]);
    cover.area += area;
    if (least >= kCovered) cover.covered += area;
    if (least >= kFull) cover.full += area;
  }
  LayerCover all;
  for (const auto& [patch, cover] : covers) all.patches.push_back(cover);
  return all;
}

// Entries whose layers end at the same parts share a stack. @return Which one each entry has.
std::vector<LocalIndex> make_stacks(std::span<const LayerOptions> options, mesh::WallLayers& layers)
{
  for (const LayerOptions& one : options) {
    layers.most_layers = std::max<LocalIndex>(layers.most_layers, num_layers(one));
  }
  std::map<std::vector<double>, LocalIndex> stacks;
  std::vector<LocalIndex> of_entry;
  for (const LayerOptions& one : options) {
    std::vector<double> ends = layer_ends(one);
    ends.insert(ends.begin(), at(layers.most_layers) - ends.size(), 0.0);
    const auto next = static_cast<LocalIndex>(stacks.size());
    const auto [found, is_new] = stacks.try_emplace(std::move(ends), next);
    if (is_new) layers.ends.insert(layers.ends.end(), found->first.begin(), found->first.end());
    of_entry.push_back(found->second);
  }
  return of_entry;
}

void note_columns(const mesh::CoarseMesh& mesh, const WallMover& mover, mesh::WallLayers& layers)
{
  layers.wall_xyz = mesh.vertex_xyz;
  layers.vertex_stack.resize(at(mesh.num_vertices()), 0);
  for (const WallVertex& vertex : mover.walls().vertices) {
    std::ranges::copy(vertex.wall, &layers.wall_xyz[3 * at(vertex.vertex)]);
    layers.vertex_stack[at(vertex.vertex)] = vertex.stack;
  }
}

}  // namespace

PatchCover LayerCover::sum() const
{
  PatchCover sum{.patch = kNoIndex};
  for (const PatchCover& patch : patches) sum.add(patch);
  return sum;
}

LayerCover grow_layers(mesh::CoarseMesh& mesh, std::span<const LayerOptions> options,
                       const model::Model& model, bool keep_tets)
{
  const std::vector<LocalIndex> entries = entries_of_patches(mesh, options);
  require_thinner_than_model(mesh, options);
  mesh::WallLayers layers;
  const std::vector<LocalIndex> stacks = make_stacks(options, layers);
  std::vector<PatchLayers> patches(entries.size());
  for (std::size_t p = 0; p < entries.size(); ++p) {
    layers.patch_is_wall.push_back(entries[p] == kNoIndex ? 0 : 1);
    if (entries[p] == kNoIndex) continue;
    patches[p] = {.thickness = thickness(options[at(entries[p])]), .stack = stacks[at(entries[p])]};
  }
  WallMover mover(mesh, model, find_walls(mesh, patches), layers);
  if (mover.walls().vertices.empty()) {
    throw ConfigError("the patches that are named have no triangle in the coarse mesh");
  }
  for (int step = 1; step <= kSteps + kMoreSteps; ++step) {
    mover.move_to(std::min(1.0, static_cast<double>(step) / kSteps));
    if (!keep_tets) mover.renumber(improve_interior(mesh));
  }
  mover.update_parameters();
  const LayerCover cover = measure(mesh, mover);
  note_columns(mesh, mover, layers);
  mesh.layers = std::move(layers);
  mesh::validate(mesh);
  return cover;
}

}  // namespace tessera::layers

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/layers/grow_layers.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"

#include "layers/interior.hpp"
#include "layers/wall_choice.hpp"
#include "layers/wall_mover.hpp"
#include "layers/wall_surface.hpp"

namespace tessera::layers {
namespace {

// So many steps; after each the tets are made better. Then some more for what was held back.
constexpr int kSteps = 6;
constexpr int kMoreSteps = 3;

constexpr double kCovered = 0.1;
constexpr double kFull = 0.9;

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
    const LocalIndex patch = mesh.face_patch[at(triangle.face)];
    if (!triangle.is_wall || mesh.is_wake(patch)) continue;
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

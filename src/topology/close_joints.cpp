// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "tessera/base/rows.hpp"
#include "tessera/mesh/image_edges.hpp"
#include "tessera/topology/split_patches.hpp"

#include "topology/add_patch.hpp"

namespace tessera::topology {
namespace {

// Makes one vertex of the copies without layers; lives for one call.
class Closer {
 public:
  explicit Closer(mesh::CoarseMesh& mesh) : mesh_(mesh) {}

  void run()
  {
    number_vertices();
    renumber(mesh_.tet_vertices);
    renumber(mesh_.face_vertices);
    renumber(mesh_.segment_vertices);
    drop_faces();
  }

 private:
  [[nodiscard]] bool has_column(LocalIndex v) const
  {
    return !mesh_.layers.are_none() && mesh_.layers.wall(v) != mesh_.position(v);
  }

  // Copies keep their order, so both sides of a joint still have the same one.
  void number_vertices()
  {
    const mesh::OrbitTable places =
        mesh::find_vertex_orbits(mesh_, mesh::ImageKind::joints).vertices;
    std::vector<LocalIndex> closed(at(mesh_.num_vertices()), kNoIndex);  // By place.
    std::vector<LocalIndex> kept;
    for (LocalIndex v = 0; v < mesh_.num_vertices(); ++v) {
      LocalIndex& of_place = closed[at(places.base_of(v))];
      if (!has_column(v) && of_place != kNoIndex) {
        number_.push_back(of_place);
        continue;
      }
      number_.push_back(static_cast<LocalIndex>(kept.size()));
      if (!has_column(v)) of_place = number_.back();
      kept.push_back(v);
    }
    mesh_.vertex_xyz = rows_of<3>(mesh_.vertex_xyz, kept);
    if (mesh_.layers.are_none()) return;
    mesh_.layers.wall_xyz = rows_of<3>(mesh_.layers.wall_xyz, kept);
    mesh_.layers.vertex_stack = rows_of(mesh_.layers.vertex_stack, kept);
  }

  void renumber(FlatArray<LocalIndex>& vertices) const
  {
    for (LocalIndex& v : vertices) v = number_[at(v)];
  }

  [[nodiscard]] bool is_closed(LocalIndex face) const
  {
    const LocalIndex origin = mesh_.images.face_origin[at(face)];
    if (origin == kNoIndex || !mesh_.images.is_joint(mesh_.face_patch[at(face)])) return false;
    // Both have the same order.
    return std::equal(corners(face), corners(face) + 3, corners(origin));
  }

  [[nodiscard]] const LocalIndex* corners(LocalIndex face) const
  {
    return &mesh_.face_vertices[3 * at(face)];
  }

  // Of what is closed all over, one face stays, which is no wall. Of a wake none does.
  void drop_faces()
  {
    std::vector<char> is_dropped(at(mesh_.num_faces()), 0);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (!is_closed(f)) continue;
      is_dropped[at(f)] = 1;
      const LocalIndex origin = mesh_.images.face_origin[at(f)];
      LocalIndex& patch = mesh_.face_patch[at(origin)];
      if (mesh_.is_wake(patch)) {
        is_dropped[at(origin)] = 1;
      } else if (mesh_.layers.is_wall(patch)) {
        patch = patch_without_layers(patch);
      }
    }
    std::vector<LocalIndex> kept;
    std::vector<LocalIndex> number(at(mesh_.num_faces()), kNoIndex);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (is_dropped[at(f)] != 0) continue;
      number[at(f)] = static_cast<LocalIndex>(kept.size());
      kept.push_back(f);
    }
    mesh_.face_vertices = rows_of<3>(mesh_.face_vertices, kept);
    mesh_.face_patch = rows_of(mesh_.face_patch, kept);
    if (!mesh_.face_uv.empty()) mesh_.face_uv = rows_of<6>(mesh_.face_uv, kept);
    mesh_.images.face_origin = rows_of(mesh_.images.face_origin, kept);
    for (LocalIndex& origin : mesh_.images.face_origin) {
      if (origin != kNoIndex) origin = number[at(origin)];
    }
  }

  [[nodiscard]] LocalIndex patch_without_layers(LocalIndex wall)
  {
    const auto found = without_layers_.find(wall);
    if (found != without_layers_.end()) return found->second;
    return without_layers_[wall] = add_patch(mesh_, wall);
  }

  mesh::CoarseMesh& mesh_;
  std::vector<LocalIndex> number_{};                   // Of each vertex before.
  std::map<LocalIndex, LocalIndex> without_layers_{};  // By wall.
};

}  // namespace

void close_joints(mesh::CoarseMesh& mesh)
{
  if (std::ranges::find(mesh.images.patch_is_joint, 1) == mesh.images.patch_is_joint.end()) return;
  Closer(mesh).run();
  mesh::validate(mesh);
}

}  // namespace tessera::topology

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/topology/split_patches.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/index_lists.hpp"

#include "topology/add_patch.hpp"
#include "topology/split_faces.hpp"

namespace tessera::topology {
namespace {

// The sides of a joint are one patch in files.
void begin_rows(mesh::CoarseMesh& mesh)
{
  if (!mesh.patch_row.empty()) return;
  mesh.patch_row.resize(at(mesh.num_patches()));
  std::iota(mesh.patch_row.begin(), mesh.patch_row.end(), 0);
}

// Faces of wakes, each kind on a patch of its own, which has the name and the row of a wall.
void add_faces(std::span<const mesh::WakeTriangle> wakes, mesh::CoarseMesh& mesh)
{
  begin_rows(mesh);
  if (mesh.images.are_none()) mesh.images.begin(mesh.num_patches(), mesh.num_faces());
  std::map<LocalIndex, LocalIndex> patches;  // By wall.
  for (const mesh::WakeTriangle& triangle : wakes) {
    const auto [patch, is_new] = patches.try_emplace(triangle.wall, kNoIndex);
    if (is_new) {
      patch->second = add_patch(mesh, triangle.wall);
      mesh.patch_surface[at(patch->second)] = kNoIndex;
    }
    mesh.face_vertices.insert(mesh.face_vertices.end(), triangle.vertices.begin(),
                              triangle.vertices.end());
    mesh.face_patch.push_back(LocalIndex{patch->second});
    mesh.images.face_origin.push_back(kNoIndex);
    if (!mesh.face_uv.empty()) mesh.face_uv.resize(mesh.face_uv.size() + 6, 0.0);
  }
}

// Gives every side of a vertex a vertex of its own.
class Opener {
 public:
  Opener(mesh::CoarseMesh& mesh, SplitFaces split) : mesh_(mesh), split_(std::move(split))
  {
    for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
      first_copy_.push_back(static_cast<LocalIndex>(origin_.size()));
      origin_.insert(origin_.end(), at(split_.num_sides(v)), v);
    }
  }

  void run()
  {
    if (split_.faces().empty()) return;
    make_patches();
    // All of it is found on the closed mesh, whose tets know their sides.
    FlatArray<LocalIndex> tets = open_tets();
    open_segments();
    open_faces();
    mesh_.tet_vertices = std::move(tets);
    copy_vertices();
  }

 private:
  [[nodiscard]] LocalIndex copy(LocalIndex tet, LocalIndex vertex) const
  {
    return first_copy_[at(vertex)] + split_.side(tet, vertex);
  }

  // Copies of a vertex stand at one place.
  void copy_vertices()
  {
    FlatArray<double> all;
    for (const LocalIndex v : origin_) {
      const Vec3 place = mesh_.position(v);
      all.insert(all.end(), place.begin(), place.end());
    }
    mesh_.vertex_xyz = std::move(all);
  }

  // What is opened of a patch alike is patches of its own, unless it is all of the patch: then that
  // is one side.
  void make_patches()
  {
    std::map<LocalIndex, std::set<Opening>> openings;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      openings[mesh_.face_patch[at(f)]].insert(split_.opening(f));
    }
    if (mesh_.images.are_none()) mesh_.images.begin(mesh_.num_patches(), mesh_.num_faces());
    for (const auto& [patch, ways] : openings) {
      for (const Opening& way : ways) {
        if (way.is_open) make_sides(patch, way, ways.size() == 1);
      }
    }
    name_rows_anew();
  }

  void make_sides(LocalIndex patch, const Opening& way, bool is_all)
  {
    if (way.is_joint()) begin_rows(mesh_);
    const LocalIndex plus = is_all ? patch : add_patch(mesh_, patch);
    if (!mesh_.patch_is_inside.empty()) mesh_.patch_is_inside[at(plus)] = 0;
    const LocalIndex minus = add_patch(mesh_, patch);
    mesh::SideImages& images = mesh_.images;
    images.patch_origin[at(minus)] = plus;
    images.patch_is_joint[at(plus)] = images.patch_is_joint[at(minus)] = way.is_joint() ? 1 : 0;
    sides_[{patch, way}] = {plus, minus};
  }

  // Patches that were of one row still are if they will have one name.
  void name_rows_anew()
  {
    if (mesh_.patch_row.empty()) return;
    const std::vector<std::string> names = mesh::final_patch_names(mesh_);
    std::map<std::pair<LocalIndex, std::string>, LocalIndex> rows;
    for (LocalIndex p = 0; p < mesh_.num_patches(); ++p) {
      const auto next = static_cast<LocalIndex>(rows.size());
      const auto key = std::pair(LocalIndex{mesh_.patch_row[at(p)]}, names[at(p)]);
      mesh_.patch_row[at(p)] = rows.try_emplace(key, next).first->second;
    }
  }

  [[nodiscard]] FlatArray<LocalIndex> open_tets() const
  {
    FlatArray<LocalIndex> opened;
    opened.reserve(mesh_.tet_vertices.size());
    for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
      for (const LocalIndex v : mesh_.tet(t)) opened.push_back(copy(t, v));
    }
    return opened;
  }

  // A segment gets a copy for each pair of copies that a tet has.
  void open_segments()
  {
    const IndexLists tets_at = rows_by_key(mesh_.tet_vertices, mesh_.num_vertices(), 4);
    const LocalIndex num_before = mesh_.num_segments();
    for (LocalIndex s = 0; s < num_before; ++s) {
      const std::array<LocalIndex, 2> ends{mesh_.segment_vertices[2 * at(s)],
                                           mesh_.segment_vertices[2 * at(s) + 1]};
      std::set<std::array<LocalIndex, 2>> copies;
      for (const LocalIndex t : tets_at[ends[0]]) {
        if (std::ranges::find(mesh_.tet(t), ends[1]) == mesh_.tet(t).end()) continue;
        copies.insert({copy(t, ends[0]), copy(t, ends[1])});
      }
      for (const auto& one : copies) {
        if (one == *copies.begin()) {
          std::ranges::copy(one, &mesh_.segment_vertices[2 * at(s)]);
          continue;
        }
        mesh_.segment_vertices.insert(mesh_.segment_vertices.end(), one.begin(), one.end());
        mesh_.segment_curve.push_back(LocalIndex{mesh_.segment_curve[at(s)]});
        if (mesh_.segment_t.empty()) continue;
        const std::array<double, 2> t{mesh_.segment_t[2 * at(s)], mesh_.segment_t[2 * at(s) + 1]};
        mesh_.segment_t.insert(mesh_.segment_t.end(), t.begin(), t.end());
      }
    }
  }

  void open_faces()
  {
    const LocalIndex num_before = mesh_.num_faces();
    for (LocalIndex f = 0; f < num_before; ++f) {
      std::array<LocalIndex, 3> corners{};
      std::copy_n(&mesh_.face_vertices[3 * at(f)], 3, corners.begin());
      const auto set_corners = [&](LocalIndex face, LocalIndex tet) {
        for (std::size_t c = 0; c < 3; ++c) {
          mesh_.face_vertices[3 * at(face) + c] = copy(tet, corners[c]);
        }
      };
      set_corners(f, split_.tets(f)[0]);
      if (!split_.is_split(f)) continue;
      const auto [plus, minus] = sides_.at({mesh_.face_patch[at(f)], split_.opening(f)});
      mesh_.face_patch[at(f)] = plus;
      add_other_side(f, minus);
      set_corners(mesh_.num_faces() - 1, split_.tets(f)[1]);
    }
  }

  void add_other_side(LocalIndex f, LocalIndex patch)
  {
    mesh_.face_vertices.resize(mesh_.face_vertices.size() + 3);
    mesh_.face_patch.push_back(patch);
    mesh_.images.face_origin.push_back(f);
    if (mesh_.face_uv.empty()) return;
    std::array<double, 6> uv{};
    std::copy_n(&mesh_.face_uv[6 * at(f)], 6, uv.begin());
    mesh_.face_uv.insert(mesh_.face_uv.end(), uv.begin(), uv.end());
  }

  mesh::CoarseMesh& mesh_;
  SplitFaces split_;
  // Of a patch before, what is opened of it in one way: the plus and the minus side.
  std::map<std::pair<LocalIndex, Opening>, std::array<LocalIndex, 2>> sides_{};
  std::vector<LocalIndex> first_copy_{};  // Of each vertex, as a vertex of the opened mesh.
  std::vector<LocalIndex> origin_{};      // Of each vertex of the opened mesh.
};

}  // namespace

void split_patches(mesh::CoarseMesh& mesh, const SplitOptions& options)
{
  Opener(mesh, SplitFaces(mesh, options)).run();
  mesh::validate(mesh);
}

void open_wakes(mesh::CoarseMesh& mesh, std::span<const mesh::WakeTriangle> wakes)
{
  if (wakes.empty()) return;
  add_faces(wakes, mesh);
  Opener(mesh, SplitFaces(mesh)).run();
  mesh::validate(mesh);
}

}  // namespace tessera::topology

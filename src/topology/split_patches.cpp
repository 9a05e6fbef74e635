// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/topology/split_patches.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tessera/base/index_lists.hpp"

#include "topology/split_faces.hpp"

namespace tessera::topology {
namespace {

// Gives every side of a vertex a vertex of its own.
class Opener {
 public:
  Opener(mesh::CoarseMesh& mesh, const SplitOptions& options) : mesh_(mesh), split_(mesh, options)
  {
    for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
      first_copy_.push_back(static_cast<LocalIndex>(origin_.size()));
      origin_.insert(origin_.end(), at(split_.num_sides(v)), v);
    }
  }

  void run()
  {
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

  // What is opened of a patch is patches of its own, unless it is all of it: then that is one side.
  void make_patches()
  {
    const LocalIndex num_before = mesh_.num_patches();
    std::vector<bool> has_open(at(num_before), false);
    std::vector<bool> has_closed(at(num_before), false);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      (split_.is_split(f) ? has_open : has_closed)[at(mesh_.face_patch[at(f)])] = true;
    }
    mesh::SideImages& images = mesh_.images;
    if (images.are_none()) {
      images.transforms.push_back({});
      images.patch_origin.assign(at(num_before), kNoIndex);
      images.patch_transform.assign(at(num_before), 0);
      images.face_origin.assign(at(mesh_.num_faces()), kNoIndex);
    }
    plus_.assign(at(num_before), kNoIndex);
    for (LocalIndex p = 0; p < num_before; ++p) {
      if (!has_open[at(p)]) continue;
      plus_[at(p)] = has_closed[at(p)] ? add_patch(p) : p;
      if (!mesh_.patch_is_inside.empty()) mesh_.patch_is_inside[at(plus_[at(p)])] = 0;
      const LocalIndex minus = add_patch(p);
      images.patch_origin[at(minus)] = plus_[at(p)];
      minus_of_[plus_[at(p)]] = minus;
    }
    name_rows_anew();
  }

  // On the same surface.
  LocalIndex add_patch(LocalIndex like)
  {
    mesh_.patch_names.push_back(std::string(mesh_.patch_names[at(like)]));
    mesh_.patch_surface.push_back(LocalIndex{mesh_.patch_surface[at(like)]});
    mesh_.images.patch_origin.push_back(kNoIndex);
    mesh_.images.patch_transform.push_back(0);
    if (!mesh_.patch_row.empty()) mesh_.patch_row.push_back(LocalIndex{mesh_.patch_row[at(like)]});
    if (!mesh_.patch_is_inside.empty()) mesh_.patch_is_inside.push_back(0);
    return mesh_.num_patches() - 1;
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
      mesh_.face_patch[at(f)] = plus_[at(mesh_.face_patch[at(f)])];
      add_other_side(f, minus_of_.at(mesh_.face_patch[at(f)]));
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
  std::vector<LocalIndex> plus_{};  // Of each patch before: one side of what is opened of it.
  std::map<LocalIndex, LocalIndex> minus_of_{};  // Of such a side.
  std::vector<LocalIndex> first_copy_{};         // Of each vertex, as a vertex of the opened mesh.
  std::vector<LocalIndex> origin_{};             // Of each vertex of the opened mesh.
};

}  // namespace

void split_patches(mesh::CoarseMesh& mesh, const SplitOptions& options)
{
  Opener(mesh, options).run();
  mesh::validate(mesh);
}

}  // namespace tessera::topology

// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/own/own_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "tessera/base/union_find.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::coarse {
namespace {

Vec3 unit_normal(const mesh::CoarseMesh& mesh, const BoundaryFace& face)
{
  const Vec3 a = mesh.position(face.vertices[0]);
  const Vec3 n = cross(mesh.position(face.vertices[1]) - a, mesh.position(face.vertices[2]) - a);
  return (1.0 / norm(n)) * n;
}

// Of faces without a tag: connected over edges where nothing but two of them meet, smoothly. Each
// set is called by its first face; of others kNoIndex.
std::vector<LocalIndex> smooth_sets(const std::vector<BoundaryFace>& faces,
                                    const mesh::CoarseMesh& mesh, double feature_angle_deg)
{
  const double least_cosine = std::cos(feature_angle_deg * std::numbers::pi / 180.0);
  UnionFind sets(static_cast<LocalIndex>(faces.size()));
  for (const auto& [edge, around] : faces_of_edges(mesh.face_vertices)) {
    if (around.size() != 2) continue;
    const BoundaryFace& a = faces[at(around[0])];
    const BoundaryFace& b = faces[at(around[1])];
    if (a.tag || b.tag || a.materials != b.materials) continue;
    if (dot(unit_normal(mesh, a), unit_normal(mesh, b)) < least_cosine) continue;
    sets.join(around[0], around[1]);
  }
  std::vector<LocalIndex> first_of_set;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    first_of_set.push_back(faces[f].tag ? kNoIndex : sets.find(static_cast<LocalIndex>(f)));
  }
  return first_of_set;
}

class PatchMaker {
 public:
  PatchMaker(const std::map<std::int32_t, std::string>& group_names, OwnMesh& own)
      : group_names_(group_names), own_(own)
  {
  }

  // Patches of tags come first, by tag, so that numbers follow those of the file.
  void add(const std::vector<BoundaryFace>& faces, const std::vector<LocalIndex>& first_of_set)
  {
    std::map<FaceTag, LocalIndex> patch_of_tag;
    for (const BoundaryFace& face : faces) {
      if (face.tag) patch_of_tag.emplace(*face.tag, kNoIndex);
      has_groups_ = has_groups_ || (face.tag && face.tag->group != 0);
    }
    for (auto& [tag, patch] : patch_of_tag) patch = add_patch(tag);
    std::map<LocalIndex, LocalIndex> patch_of_set;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!faces[f].tag) {
        const auto [entry, is_new] = patch_of_set.try_emplace(first_of_set[f], kNoIndex);
        if (is_new) entry->second = add_patch({});
        own_.mesh.face_patch.push_back(entry->second);
      } else {
        own_.mesh.face_patch.push_back(patch_of_tag.at(*faces[f].tag));
      }
    }
  }

 private:
  LocalIndex add_patch(const FaceTag& tag)
  {
    mesh::CoarseMesh& mesh = own_.mesh;
    const LocalIndex patch = mesh.num_patches();
    const std::int32_t called = tag.group != 0 ? tag.group : tag.entity;
    const auto known = row_of_tag_.find({tag.group != 0, called});
    const bool is_shared = called != 0 && known != row_of_tag_.end();
    const LocalIndex row = is_shared ? known->second : num_rows_++;
    if (called != 0) row_of_tag_.emplace(std::pair(tag.group != 0, called), row);
    mesh.patch_row.push_back(row);
    mesh.patch_surface.push_back(patch);
    mesh.patch_names.push_back(name_of(tag, called, row));
    used_names_.insert(mesh.patch_names.back());
    own_.patch_entity.push_back(tag.entity);
    own_.patch_is_named.push_back(tag.group != 0 && group_names_.contains(tag.group) ? 1 : 0);
    return patch;
  }

  // The group's name; else patch_N, N being what the file calls it.
  std::string name_of(const FaceTag& tag, std::int32_t called, LocalIndex row)
  {
    const auto name = group_names_.find(tag.group);
    if (tag.group != 0 && name != group_names_.end()) return name->second;
    if (called != 0 && (tag.group != 0 || !has_groups_)) return fmt::format("patch_{}", called);
    std::string free = fmt::format("patch_{}", row + 1);
    for (LocalIndex n = row + 2; used_names_.contains(free); ++n) free = fmt::format("patch_{}", n);
    return free;
  }

  const std::map<std::int32_t, std::string>& group_names_;
  OwnMesh& own_;
  bool has_groups_ = false;
  LocalIndex num_rows_ = 0;
  std::map<std::pair<bool, std::int32_t>, LocalIndex> row_of_tag_{};
  std::set<std::string> used_names_{};
};

}  // namespace

void add_patches(const std::vector<BoundaryFace>& faces,
                 const std::map<std::int32_t, std::string>& group_names, double feature_angle_deg,
                 OwnMesh& own)
{
  for (const BoundaryFace& face : faces) {
    own.mesh.face_vertices.insert(own.mesh.face_vertices.end(), face.vertices.begin(),
                                  face.vertices.end());
    own.face_materials.push_back(face.materials);
  }
  const auto first_of_set = smooth_sets(faces, own.mesh, feature_angle_deg);
  PatchMaker(group_names, own).add(faces, first_of_set);
}

std::map<std::array<LocalIndex, 2>, std::vector<LocalIndex>> faces_of_edges(
    std::span<const LocalIndex> face_vertices)
{
  std::map<std::array<LocalIndex, 2>, std::vector<LocalIndex>> faces;
  for (std::size_t c = 0; c < face_vertices.size(); ++c) {
    const LocalIndex a = face_vertices[c];
    const LocalIndex b = face_vertices[c - c % 3 + (c + 1) % 3];
    faces[{std::min(a, b), std::max(a, b)}].push_back(static_cast<LocalIndex>(c / 3));
  }
  return faces;
}

}  // namespace tessera::coarse

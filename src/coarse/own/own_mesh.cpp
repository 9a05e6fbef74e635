// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/own_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_edges.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/surface/touching_faces.hpp"

#include "coarse/own/own_patches.hpp"

namespace tessera::coarse {
namespace {

// A tet of less volume, as a part of the cube of its longest edge, is flat: no child of it could be
// any better. A regular one has 0.118.
constexpr double kFlat = 1e-9;

// What counts as touching, as a part of the box diagonal.
constexpr double kTouching = 1e-9;

std::string place_text(const Vec3& p) { return fmt::format("({:g})", fmt::join(p, ", ")); }

class OwnMeshBuilder {
 public:
  OwnMeshBuilder(const model::TetMeshFile& file, const std::string& name) : file_(file), name_(name)
  {
  }

  OwnMesh run(double feature_angle_deg)
  {
    merge_points();
    add_tets();
    turn_tets();
    add_materials();
    find_triangles();
    add_faces(feature_angle_deg);
    require_matching_faces();
    return std::move(own_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  [[nodiscard]] Vec3 file_point(LocalIndex row) const
  {
    return point_at(std::span(file_.point_xyz), row);
  }

  [[nodiscard]] static Vec3 middle_of(std::span<const Vec3> corners)
  {
    Vec3 sum{};
    for (const Vec3& corner : corners) sum = sum + corner;
    return (1.0 / static_cast<double>(corners.size())) * sum;
  }

  [[nodiscard]] std::string tet_text(std::size_t row) const
  {
    std::array<Vec3, 4> corners{};
    for (std::size_t c = 0; c < 4; ++c) corners[c] = file_point(file_.tets.points[4 * row + c]);
    return fmt::format("tet {} at {}", file_.tets.number[row], place_text(middle_of(corners)));
  }

  // By coordinates: of the points that are equal, the first one stands for all.
  void merge_points()
  {
    std::vector<LocalIndex> order(file_.point_number.size());
    for (std::size_t p = 0; p < order.size(); ++p) order[p] = static_cast<LocalIndex>(p);
    std::ranges::stable_sort(order, {}, [this](LocalIndex p) { return file_point(p); });
    first_of_.resize(order.size());
    std::size_t num_equal = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_equal = i > 0 && file_point(order[i]) == file_point(order[i - 1]);
      first_of_[at(order[i])] = is_equal ? first_of_[at(order[i - 1])] : order[i];
      num_equal += is_equal ? 1 : 0;
    }
    if (num_equal == 0) return;
    own_.repairs.push_back(
        fmt::format("{} points have the coordinates of another one and were joined", num_equal));
  }

  void add_tets()
  {
    if (file_.tets.size() == 0) fail("it has no tets; a coarse mesh is one of volume elements");
    std::set<std::array<LocalIndex, 4>> known;
    std::vector<LocalIndex> vertex_of(file_.point_number.size(), kNoIndex);
    for (std::size_t t = 0; t < file_.tets.size(); ++t) {
      std::array<LocalIndex, 4> points{};
      for (std::size_t c = 0; c < 4; ++c) points[c] = first_of_[at(file_.tets.points[4 * t + c])];
      auto sorted = points;
      std::ranges::sort(sorted);
      if (std::ranges::adjacent_find(sorted) != sorted.end()) {
        fail(tet_text(t) + " has one corner twice");
      }
      if (!known.insert(sorted).second) continue;
      file_row_.push_back(t);
      for (const LocalIndex p : points) own_.mesh.tet_vertices.push_back(vertex(p, vertex_of));
    }
    if (const std::size_t num = file_.tets.size() - file_row_.size(); num > 0) {
      own_.repairs.push_back(fmt::format("{} tets stand twice and count once", num));
    }
    vertex_of_ = std::move(vertex_of);
  }

  LocalIndex vertex(LocalIndex point, std::vector<LocalIndex>& vertex_of)
  {
    LocalIndex& number = vertex_of[at(point)];
    if (number != kNoIndex) return number;
    number = own_.mesh.num_vertices();
    const Vec3 xyz = file_point(point);
    own_.mesh.vertex_xyz.insert(own_.mesh.vertex_xyz.end(), xyz.begin(), xyz.end());
    return number;
  }

  // Programs differ in what they call positive. What all tets have alike is no defect.
  void turn_tets()
  {
    std::array<std::size_t, 2> num{};
    std::array<std::size_t, 2> first{};
    for (std::size_t t = file_row_.size(); t-- > 0;) {
      const auto sign = static_cast<std::size_t>(signed_volume(t) > 0.0 ? 1 : 0);
      ++num[sign];
      first[sign] = t;
    }
    if (num[0] > 0 && num[1] > 0) {
      const std::size_t odd = num[0] <= num[1] ? 0 : 1;
      fail(
          fmt::format("{} is inside out, as {} of {} tets are, and the others are not; repair the "
                      "mesh in the program that made it",
                      tet_text(file_row_[first[odd]]), num[odd], num[0] + num[1]));
    }
    if (num[0] == 0) return;
    for (std::size_t t = 0; t < file_row_.size(); ++t) {
      std::swap(own_.mesh.tet_vertices[4 * t + 2], own_.mesh.tet_vertices[4 * t + 3]);
    }
    own_.repairs.emplace_back("all tets were inside out and have been turned");
  }

  [[nodiscard]] double signed_volume(std::size_t t) const
  {
    const auto corners = corners_at<4>(own_.mesh.vertex_xyz, own_.mesh.tet_vertices, t);
    const double longest = mesh::longest_edge(corners);
    const double volume = tet_volume(corners);
    if (std::abs(volume) > kFlat * longest * longest * longest) return volume;
    fail(
        fmt::format("{} is flat: its volume is {:g}, and its longest edge {:g}; repair the mesh in "
                    "the program that made it",
                    tet_text(file_row_[t]), volume, longest));
  }

  void add_materials()
  {
    const bool has_groups = std::ranges::any_of(file_.tets.group, [](auto g) { return g != 0; });
    const auto& tags = has_groups ? file_.tets.group : file_.tets.entity;
    std::map<std::int32_t, LocalIndex> material_of;
    for (const std::size_t row : file_row_) material_of[tags[row]] = 0;
    for (auto& [tag, material] : material_of) {
      material = own_.mesh.num_materials() + 1;
      const auto name = file_.tet_group_names.find(tag);
      const bool is_named = has_groups && name != file_.tet_group_names.end();
      own_.material_is_named.push_back(is_named ? 1 : 0);
      const bool is_tagged = tag != 0 || material_of.size() > 1;
      own_.mesh.material_names.push_back(
          is_named ? name->second : fmt::format("material_{}", is_tagged ? tag : material));
    }
    for (const std::size_t row : file_row_) {
      own_.mesh.tet_material.push_back(material_of[tags[row]]);
    }
  }

  void find_triangles()
  {
    try {
      triangles_ = mesh::triangles_of_tets(own_.mesh.tet_vertices);
    } catch (const MeshError& error) {
      fail(three_tets_text(error));
    }
  }

  // The numbers in the message are rows, which nobody knows.
  [[nodiscard]] std::string three_tets_text(const MeshError& error) const
  {
    std::map<std::array<LocalIndex, 3>, std::vector<std::size_t>> around;
    for (std::size_t t = 0; t < file_row_.size(); ++t) {
      const LocalIndex* v = &own_.mesh.tet_vertices[4 * t];
      for (const auto& [a, b, c] : mesh::kTetFaceCorners) {
        auto& tets = around[mesh::sorted_triangle(v[a], v[b], v[c])];
        tets.push_back(file_row_[t]);
        if (tets.size() < 3) continue;
        return fmt::format("{}, tet {} and tet {} share one triangle; they overlap",
                           tet_text(tets[0]), file_.tets.number[tets[1]],
                           file_.tets.number[tets[2]]);
      }
    }
    return error.what();
  }

  [[nodiscard]] bool is_boundary(const mesh::TriangleTets& triangle) const
  {
    return triangle.tets[1] == kNoIndex
           || own_.mesh.tet_material[at(triangle.tets[0])]
                  != own_.mesh.tet_material[at(triangle.tets[1])];
  }

  // Tags of the triangles of the file, by their row in triangles_.
  [[nodiscard]] std::map<std::size_t, FaceTag> tags_of_triangles()
  {
    std::map<std::size_t, FaceTag> tags;
    std::size_t num_inside = 0;
    for (std::size_t t = 0; t < file_.triangles.size(); ++t) {
      std::array<LocalIndex, 3> v{};
      std::array<Vec3, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        const LocalIndex point = file_.triangles.points[3 * t + c];
        corners[c] = file_point(point);
        v[c] = vertex_of_[at(first_of_[at(point)])];
      }
      const auto key = mesh::sorted_triangle(v[0], v[1], v[2]);
      const auto found =
          std::ranges::lower_bound(triangles_, key, {}, &mesh::TriangleTets::vertices);
      if (found == triangles_.end() || found->vertices != key) {
        fail(fmt::format("triangle {} at {} is no face of a tet", file_.triangles.number[t],
                         place_text(middle_of(corners))));
      }
      if (!is_boundary(*found)) {
        ++num_inside;
        continue;
      }
      tags.emplace(static_cast<std::size_t>(found - triangles_.begin()),
                   FaceTag{file_.triangles.group[t], file_.triangles.entity[t]});
    }
    if (num_inside > 0) {
      own_.repairs.push_back(
          fmt::format("{} triangles lie inside of one material and were left out", num_inside));
    }
    return tags;
  }

  void add_faces(double feature_angle_deg)
  {
    const auto tags = tags_of_triangles();
    std::vector<BoundaryFace> faces;
    std::size_t num_made_up = 0;
    for (std::size_t row = 0; row < triangles_.size(); ++row) {
      if (!is_boundary(triangles_[row])) continue;
      const auto tag = tags.find(row);
      faces.push_back(face_of(triangles_[row]));
      if (tag != tags.end()) faces.back().tag = tag->second;
      if (tag == tags.end()) ++num_made_up;
    }
    if (num_made_up > 0) {
      own_.repairs.push_back(
          fmt::format("{} of {} boundary triangles are not in the file; their patches are by "
                      "feature angle",
                      num_made_up, faces.size()));
    }
    add_patches(faces, file_.triangle_group_names, feature_angle_deg, own_);
  }

  // Seen from outside of the tet with the lower material.
  [[nodiscard]] BoundaryFace face_of(const mesh::TriangleTets& triangle) const
  {
    BoundaryFace face;
    std::size_t side = 0;
    face.materials[0] = own_.mesh.tet_material[at(triangle.tets[0])];
    if (triangle.tets[1] != kNoIndex) {
      face.materials[1] = own_.mesh.tet_material[at(triangle.tets[1])];
      side = face.materials[1] < face.materials[0] ? 1 : 0;
      if (side == 1) std::swap(face.materials[0], face.materials[1]);
    }
    const auto tet = own_.mesh.tet(triangle.tets[side]);
    const auto& corners = mesh::kTetFaceCorners[at(triangle.corners[side])];
    for (std::size_t c = 0; c < 3; ++c) face.vertices[c] = tet[corners[c]];
    return face;
  }

  void require_matching_faces() const
  {
    std::vector<std::array<LocalIndex, 3>> outer;
    std::vector<LocalIndex> tets;
    for (const mesh::TriangleTets& triangle : triangles_) {
      if (triangle.tets[1] != kNoIndex) continue;
      outer.push_back(triangle.vertices);
      tets.push_back(triangle.tets[0]);
    }
    const std::span<const double> xyz = own_.mesh.vertex_xyz;
    const auto touching = surface::find_touching_faces(xyz, outer, kTouching * box_diagonal(xyz));
    if (!touching) return;
    fail(fmt::format(
        "{} and tet {} meet at {} but do not share a face there; the mesh must conform",
        tet_text(file_row_[at(tets[touching->first])]),
        file_.tets.number[file_row_[at(tets[touching->second])]], place_text(touching->place)));
  }

  const model::TetMeshFile& file_;
  const std::string& name_;
  std::vector<LocalIndex> first_of_{};   // Of each point of the file, the one that stands for it.
  std::vector<LocalIndex> vertex_of_{};  // Of these, kNoIndex if it is in no tet.
  std::vector<std::size_t> file_row_{};  // Of each tet.
  std::vector<mesh::TriangleTets> triangles_{};
  OwnMesh own_{};
};

}  // namespace

void OwnMesh::require_sound() const
{
  const bool is_sound = patch_entity.size() == mesh.patch_names.size()
                        && patch_is_named.size() == mesh.patch_names.size()
                        && material_is_named.size() == mesh.material_names.size()
                        && face_materials.size() == mesh.face_patch.size();
  if (!is_sound) throw InputError("the arrays of a mesh do not fit together");
}

OwnMesh make_own_mesh(const model::TetMeshFile& file, const std::string& name,
                      double feature_angle_deg)
{
  OwnMesh own = OwnMeshBuilder(file, name).run(feature_angle_deg);
  mesh::validate(own.mesh);
  return own;
}

}  // namespace tessera::coarse

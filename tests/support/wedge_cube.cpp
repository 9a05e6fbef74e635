// SPDX-License-Identifier: BSD-3-Clause
#include "support/wedge_cube.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/meshes.hpp"

namespace tessera::testing {
namespace {

constexpr double kMiddle = 0.5;

// Opens a cube in the middle; lives for one call.
class Cutter {
 public:
  explicit Cutter(double thickness) : thickness_(thickness), cube_(kuhn_cube(4)) {}

  mesh::CoarseMesh run()
  {
    for (LocalIndex f = 0; f < cube_.num_faces(); ++f) {
      patch_of_[sorted(&cube_.face_vertices[3 * at(f)])] = cube_.face_patch[at(f)];
    }
    open_tets();
    open_segments();
    for (const char* name : {"upper", "lower"}) {
      cube_.patch_names.emplace_back(name);
      cube_.patch_surface.push_back(cube_.num_patches() - 1);
    }
    make_faces();
    return std::move(cube_);
  }

 private:
  static std::array<LocalIndex, 3> sorted(const LocalIndex* v)
  {
    return mesh::sorted_triangle(v[0], v[1], v[2]);
  }

  // Vertices between both sides: the old one stays below.
  LocalIndex upper(LocalIndex v)
  {
    const Vec3 place = cube_.position(v);
    if (place[2] != kMiddle || place[0] >= kMiddle) return v;
    const auto [found, is_new] = upper_.try_emplace(v, cube_.num_vertices());
    if (is_new) {
      const double off = thickness_ * (kMiddle - place[0]);
      cube_.vertex_xyz.insert(cube_.vertex_xyz.end(), {place[0], place[1], kMiddle + off});
      origin_[found->second] = v;
    }
    return found->second;
  }

  void open_tets()
  {
    for (LocalIndex t = 0; t < cube_.num_tets(); ++t) {
      const Vec3 middle = tet_centroid(corners_at<4>(cube_.vertex_xyz, cube_.tet_vertices, t));
      is_above_.push_back(middle[2] > kMiddle);
      for (std::size_t c = 0; c < 4 && is_above_.back(); ++c) {
        LocalIndex& v = cube_.tet_vertices[4 * at(t) + c];
        v = upper(v);
      }
    }
    for (const auto& [low, high] : upper_) {
      cube_.vertex_xyz[3 * at(low) + 2] = 2.0 * kMiddle - cube_.vertex_xyz[3 * at(high) + 2];
    }
  }

  void open_segments()
  {
    for (std::size_t s = 0; s < cube_.segment_curve.size(); ++s) {
      LocalIndex* ends = &cube_.segment_vertices[2 * s];
      for (std::size_t end = 0; end < 2; ++end) {
        const bool is_above = cube_.position(ends[1 - end])[2] > kMiddle;
        const auto found = upper_.find(ends[end]);
        if (is_above && found != upper_.end()) ends[end] = found->second;
      }
    }
  }

  [[nodiscard]] LocalIndex origin(LocalIndex v) const
  {
    const auto found = origin_.find(v);
    return found == origin_.end() ? v : found->second;
  }

  void make_faces()
  {
    cube_.face_vertices.clear();
    cube_.face_patch.clear();
    for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(cube_.tet_vertices)) {
      if (triangle.tets[1] != kNoIndex) continue;
      const auto& v = triangle.vertices;
      const auto found =
          patch_of_.find(mesh::sorted_triangle(origin(v[0]), origin(v[1]), origin(v[2])));
      const LocalIndex of_wedge = is_above_[at(triangle.tets[0])] ? 6 : 7;
      cube_.face_vertices.insert(cube_.face_vertices.end(), v.begin(), v.end());
      cube_.face_patch.push_back(found == patch_of_.end() ? of_wedge : found->second);
      for (std::size_t c = 0; c < 3; ++c) add_edge({v[c], v[(c + 1) % 3]});
    }
  }

  // Each side of the wedge has the edge once.
  void add_edge(const std::array<LocalIndex, 2>& ends)
  {
    const bool is_its = std::ranges::all_of(ends, [&](LocalIndex v) {
      return cube_.position(v)[0] == kMiddle && cube_.position(v)[2] == kMiddle;
    });
    if (!is_its || !known_.insert(mesh::sorted_edge(ends[0], ends[1])).second) return;
    cube_.segment_vertices.insert(cube_.segment_vertices.end(), ends.begin(), ends.end());
    cube_.segment_curve.push_back(12);
  }

  double thickness_;
  mesh::CoarseMesh cube_;
  std::map<std::array<LocalIndex, 3>, LocalIndex> patch_of_{};  // Of the faces before.
  std::map<LocalIndex, LocalIndex> upper_{};                    // By lower vertex.
  std::map<LocalIndex, LocalIndex> origin_{};                   // By upper vertex.
  std::vector<bool> is_above_{};                                // Of each tet.
  std::set<std::array<LocalIndex, 2>> known_{};                 // Of the wedge's edge.
};

}  // namespace

mesh::CoarseMesh wedge_cube(double thickness) { return Cutter(thickness).run(); }

}  // namespace tessera::testing

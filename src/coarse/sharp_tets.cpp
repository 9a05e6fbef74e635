// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/sharp_tets.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_edges.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::coarse {
namespace {

using Edge = std::array<LocalIndex, 2>;  // Lower vertex first.
constexpr std::size_t kNumEdges = mesh::kTetEdgeCorners.size();

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

class SharpFinder {
 public:
  SharpFinder(const mesh::CoarseMesh& mesh, double angle_deg)
      : mesh_(mesh), angle_deg_(angle_deg), wide_deg_(2.0 * angle_deg)
  {
  }

  SharpTets run()
  {
    for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
      if (smallest_angle(t) < angle_deg_) sharp_.push_back(t);
    }
    if (sharp_.empty()) return {};
    find_boundary();
    find_wedges();
    find_cusps();
    return sort_out();
  }

 private:
  [[nodiscard]] std::array<Vec3, 4> corners(LocalIndex t) const
  {
    return corners_at<4>(mesh_.vertex_xyz, mesh_.tet_vertices, t);
  }

  [[nodiscard]] double smallest_angle(LocalIndex t) const
  {
    double least = 180.0;
    for (std::size_t e = 0; e < kNumEdges; ++e) {
      least = std::min(least, degrees(mesh::dihedral_angle(corners(t), e)));
    }
    return least;
  }

  [[nodiscard]] double shortest_edge(LocalIndex t) const
  {
    const auto p = corners(t);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : mesh::kTetEdgeCorners) least = std::min(least, norm(p[b] - p[a]));
    return least;
  }

  // Edges of faces, and which of them are on curves: between patches, or segments.
  void find_boundary()
  {
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
      for (std::size_t c = 0; c < 3; ++c) {
        faces_at_[mesh::sorted_edge(v[c], v[(c + 1) % 3])].push_back(f);
        vertex_patches_[v[c]].insert(mesh_.face_patch[at(f)]);
      }
    }
    for (LocalIndex s = 0; s < mesh_.num_segments(); ++s) {
      on_curve_.insert(mesh::sorted_edge(mesh_.segment_vertices[2 * at(s)],
                                         mesh_.segment_vertices[2 * at(s) + 1]));
    }
    for (const auto& [edge, faces] : faces_at_) {
      const LocalIndex patch = mesh_.face_patch[at(faces.front())];
      const auto is_other = [&](LocalIndex f) { return mesh_.face_patch[at(f)] != patch; };
      if (std::ranges::any_of(faces, is_other)) on_curve_.insert(edge);
    }
  }

  // What the tets of a material fill at each edge of the boundary that a sharp tet has.
  void find_wedges()
  {
    for (const LocalIndex t : sharp_) {
      for (std::size_t e = 0; e < kNumEdges; ++e) {
        if (faces_at_.contains(ends(t, e))) wedges_[{ends(t, e), material(t)}] = 0.0;
      }
    }
    for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
      for (std::size_t e = 0; e < kNumEdges; ++e) {
        const auto found = wedges_.find({ends(t, e), material(t)});
        if (found == wedges_.end()) continue;
        found->second += degrees(mesh::dihedral_angle(corners(t), e));
      }
    }
  }

  [[nodiscard]] Edge ends(LocalIndex t, std::size_t edge) const
  {
    const auto& [a, b] = mesh::kTetEdgeCorners[edge];
    return mesh::sorted_edge(mesh_.tet(t)[a], mesh_.tet(t)[b]);
  }
  [[nodiscard]] LocalIndex material(LocalIndex t) const { return mesh_.tet_material[at(t)]; }

  // Triangles between two curves that meet, then sharp ones beside them.
  void find_cusps()
  {
    std::vector<LocalIndex> to_visit;
    std::vector<char> is_in_cusp(at(mesh_.num_faces()), 0);
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (is_tip(f)) to_visit.push_back(f);
    }
    while (!to_visit.empty()) {
      const LocalIndex f = to_visit.back();
      to_visit.pop_back();
      if (std::exchange(is_in_cusp[at(f)], 1) != 0) continue;
      const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
      for (std::size_t c = 0; c < 3; ++c) {
        const Edge edge = mesh::sorted_edge(v[c], v[(c + 1) % 3]);
        cusp_edges_.insert(edge);
        for (const LocalIndex other : faces_at_.at(edge)) {
          if (mesh_.face_patch[at(other)] == mesh_.face_patch[at(f)] && is_sharp(other)) {
            to_visit.push_back(other);
          }
        }
      }
    }
  }

  [[nodiscard]] double corner_angle(LocalIndex f, std::size_t c) const
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    const Vec3 tip = mesh_.position(v[c]);
    return degrees(
        angle_between(mesh_.position(v[(c + 1) % 3]) - tip, mesh_.position(v[(c + 2) % 3]) - tip));
  }

  [[nodiscard]] bool is_tip(LocalIndex f) const
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    for (std::size_t c = 0; c < 3; ++c) {
      const bool between = on_curve_.contains(mesh::sorted_edge(v[c], v[(c + 1) % 3]))
                           && on_curve_.contains(mesh::sorted_edge(v[c], v[(c + 2) % 3]));
      if (between && corner_angle(f, c) < wide_deg_) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_sharp(LocalIndex f) const
  {
    return std::min({corner_angle(f, 0), corner_angle(f, 1), corner_angle(f, 2)}) < wide_deg_;
  }

  [[nodiscard]] bool is_forced(LocalIndex t) const
  {
    for (std::size_t e = 0; e < kNumEdges; ++e) {
      if (cusp_edges_.contains(ends(t, e))) return true;
      const auto wedge = wedges_.find({ends(t, e), material(t)});
      if (wedge != wedges_.end() && wedge->second < wide_deg_) return true;
    }
    return false;
  }

  SharpTets sort_out()
  {
    SharpTets result;
    std::vector<std::pair<double, LocalIndex>> others;
    for (const LocalIndex t : sharp_) {
      if (is_forced(t)) {
        ++result.num_forced;
      } else {
        others.emplace_back(smallest_angle(t), t);
      }
    }
    result.num_others = static_cast<LocalIndex>(others.size());
    std::ranges::sort(others);
    others.resize(std::min(others.size(), SharpTets::kMost));
    for (const auto& [angle, t] : others) result.worst.push_back(described(t, angle));
    return result;
  }

  [[nodiscard]] SharpTet described(LocalIndex t, double angle) const
  {
    SharpTet tet{.angle_deg = angle, .shortest_edge = shortest_edge(t)};
    tet.centre = tet_centroid(corners(t));
    std::set<LocalIndex> rows;
    for (const LocalIndex v : mesh_.tet(t)) {
      const auto found = vertex_patches_.find(v);
      if (found == vertex_patches_.end()) continue;
      for (const LocalIndex patch : found->second) {
        rows.insert(mesh_.patch_row.empty() ? patch : mesh_.patch_row[at(patch)]);
      }
    }
    tet.patches.assign(rows.begin(), rows.end());
    return tet;
  }

  const mesh::CoarseMesh& mesh_;
  double angle_deg_;
  double wide_deg_;
  std::vector<LocalIndex> sharp_{};
  std::map<Edge, std::vector<LocalIndex>> faces_at_{};
  std::map<LocalIndex, std::set<LocalIndex>> vertex_patches_{};
  std::set<Edge> on_curve_{};
  std::set<Edge> cusp_edges_{};
  std::map<std::pair<Edge, LocalIndex>, double> wedges_{};  // By edge and material.
};

}  // namespace

SharpTets find_sharp_tets(const mesh::CoarseMesh& mesh, double angle_deg)
{
  return SharpFinder(mesh, angle_deg).run();
}

}  // namespace tessera::coarse

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "tessera/mesh/tet_topology.hpp"

#include "surface/crossings.hpp"
#include "surface/editable_surface.hpp"
#include "surface/wrap/corners.hpp"

namespace tessera::surface {
namespace {

// Of the spacing: an edge whose middle is so far off the file cuts an edge of it short.
constexpr double kShort = 0.1;
constexpr double kLeastArea = 1e-3;      // Twice a triangle's, of the spacing squared.
constexpr double kLeastCosine = -0.985;  // Between neighbours.
constexpr int kMostSweeps = 3;

class Flipper {
 public:
  Flipper(const PatchSurface& surface, double spacing, const FileTriangles& file)
      : given_(surface),
        surface_(surface, std::vector<double>(surface.vertex_xyz.size(), spacing)),
        guard_(surface),
        spacing_(spacing),
        file_(file)
  {
  }

  PatchSurface run()
  {
    std::vector<PatchSurface::Edge> edges = surface_.edges();
    for (int sweep = 0; sweep < kMostSweeps && !edges.empty(); ++sweep) {
      short_.clear();
      bool has_flipped = false;
      for (const auto& edge : edges) has_flipped = try_flip(edge) || has_flipped;
      if (!has_flipped) break;
      std::swap(edges, short_);
    }
    return surface_.take(given_);
  }

 private:
  [[nodiscard]] double miss(LocalIndex a, LocalIndex b) const
  {
    return file_.distance(midpoint(surface_.xyz(a), surface_.xyz(b)));
  }

  [[nodiscard]] PlacedTriangle placed(const PatchSurface::Triangle& v) const
  {
    return {v, {surface_.xyz(v[0]), surface_.xyz(v[1]), surface_.xyz(v[2])}};
  }

  [[nodiscard]] bool is_sound(const EditableSurface::Flip& flip) const
  {
    std::vector<Vec3> normals;
    for (const auto& v : flip.made) {
      const Vec3 normal = normal_of(placed(v).corners);
      if (norm(normal) <= kLeastArea * spacing_ * spacing_) return false;
      normals.push_back(unit(normal));
    }
    if (dot(normals[0], normals[1]) < kLeastCosine) return false;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto edge = mesh::sorted_edge(flip.made[i][c], flip.made[i][(c + 1) % 3]);
        for (const LocalIndex t : surface_.triangles_at(edge)) {
          if (std::ranges::find(flip.triangles, t) != flip.triangles.end()) continue;
          if (dot(normals[i], unit(normal_of(surface_.corners(t)))) < kLeastCosine) return false;
        }
      }
    }
    return true;
  }

  bool try_flip(const PatchSurface::Edge& edge)
  {
    if (!surface_.has_edge(edge[0], edge[1])) return false;
    const double before = miss(edge[0], edge[1]);
    if (before < kShort * spacing_) return false;
    short_.push_back(edge);
    const std::optional<EditableSurface::Flip> flip = surface_.flipped(edge);
    if (!flip) return false;
    const LocalIndex a = opposite(surface_.triangle(flip->triangles[0]), edge);
    const LocalIndex b = opposite(surface_.triangle(flip->triangles[1]), edge);
    if (miss(a, b) > 0.5 * before || !is_sound(*flip)) return false;
    const std::array made{placed(flip->made[0]), placed(flip->made[1])};
    if (!guard_.allows(flip->triangles, made)) return false;
    surface_.flip(*flip);
    short_.back() = mesh::sorted_edge(a, b);
    for (std::size_t i = 0; i < 2; ++i) guard_.change(flip->triangles[i], made[i]);
    return true;
  }

  const PatchSurface& given_;
  EditableSurface surface_;
  CrossingGuard guard_;
  double spacing_;
  const FileTriangles& file_;
  std::vector<PatchSurface::Edge> short_{};  // Of this sweep, flipped or not.
};

}  // namespace

PatchSurface flipped_to_file(const PatchSurface& surface, double spacing, const FileTriangles& file)
{
  return Flipper(surface, spacing, file).run();
}

}  // namespace tessera::surface

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tessera/model/model.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/patch_surface.hpp"

#include "surface/editable_surface.hpp"

namespace tessera::surface {

// A CoarseSurface as EditableSurface takes it, and back. Triangles of one patch between the same
// domains are a *group*, which has the place of the patch. Edges that may not change have a curve
// whose ends are fixed.
class SurfaceGroups {
 public:
  SurfaceGroups(const CoarseSurface& surface, const model::Model& model);

  [[nodiscard]] const PatchSurface& surface() const { return groups_; }

  // The Model's numbers; kNoIndex: of a cut.
  [[nodiscard]] LocalIndex model_surface(LocalIndex group) const;
  [[nodiscard]] LocalIndex model_curve(LocalIndex curve) const { return curve_number_[at(curve)]; }

  // The nearest points of a group or curve, searched near what is known of a vertex there.
  // A group or curve of cuts gives the point itself.
  [[nodiscard]] Vec3 on_group(LocalIndex group, LocalIndex near, const Vec3& point) const;
  [[nodiscard]] Vec3 on_curve(LocalIndex curve, LocalIndex near, const Vec3& point) const;

  // Whether curves lie in each other there. Such an edge may not be cut.
  [[nodiscard]] bool is_on_several_curves(const PatchSurface::Edge& edge) const
  {
    return on_several_curves_.contains(edge);
  }

  // Whether a closed curve begins and ends there.
  [[nodiscard]] bool is_seam(LocalIndex curve, LocalIndex v) const;

  // Notes that a vertex was put or moved there, with `near` as the guess for its parameters.
  void place_on_group(LocalIndex group, LocalIndex v, LocalIndex near, const Vec3& point);
  void place_on_curve(LocalIndex curve, LocalIndex v, LocalIndex near, const Vec3& point);

  // Notes that a vertex is another one now, which has its curves as well.
  void merge(LocalIndex gone, LocalIndex kept, const Vec3& point);

  // What became of it.
  [[nodiscard]] CoarseSurface take(const EditableSurface& edited) const;

 private:
  using Edge = PatchSurface::Edge;
  using Uv = model::SurfaceParameters;

  void add_triangles();
  void add_segments();
  void add_other_edges();
  void add_edge(const Edge& edge, LocalIndex curve, bool is_fixed);
  [[nodiscard]] bool has_uv() const { return !given_.mesh.face_uv.empty(); }
  [[nodiscard]] bool has_t() const { return !given_.mesh.segment_t.empty(); }
  [[nodiscard]] Uv uv_near(LocalIndex group, LocalIndex v) const;
  [[nodiscard]] double t_near(LocalIndex curve, LocalIndex v) const;
  void take_face(const EditableSurface& edited, LocalIndex t, CoarseSurface& to) const;
  void take_segments(const EditableSurface& edited, CoarseSurface& to) const;
  [[nodiscard]] std::array<double, 2> ends_on(LocalIndex curve, const Edge& edge) const;

  const CoarseSurface& given_;
  const model::Model& model_;
  PatchSurface groups_{};
  std::vector<std::array<LocalIndex, 3>> group_{};  // Patch and domains.
  std::vector<LocalIndex> curve_number_{};
  std::set<Edge> edges_{};
  std::set<Edge> on_several_curves_{};
  std::map<std::pair<LocalIndex, LocalIndex>, Uv> uv_{};                  // By group and vertex.
  std::map<std::pair<LocalIndex, LocalIndex>, std::vector<double>> t_{};  // By curve and vertex.
  std::set<LocalIndex> changed_{};                                        // Vertices.
};

}  // namespace tessera::surface

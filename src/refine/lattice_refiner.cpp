// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/lattice_refiner.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tessera::refine {
namespace {

namespace lattice = mesh::lattice;
using lattice::TrianglePoint;
using model::SurfaceParameters;

SurfaceParameters middle(const SurfaceParameters& a, const SurfaceParameters& b)
{
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

// Refines one complex; lives for one call of refine_lattice().
class LatticeRefiner {
 public:
  LatticeRefiner(const mesh::Complex& complex, mesh::LatticeLevels levels,
                 const RefineContext& context)
      : complex_(complex), context_(context), result_(std::move(levels))
  {
    if (!context.model.has_parameters()) return;
    edge_parameters_.resize(result_.edge_points().size());
    triangle_uv_.resize(result_.triangle_points().size());
  }

  mesh::RefinedLattice run()
  {
    for (LocalIndex e = 0; e < complex_.num_edges(); ++e) place_ends(e);
    for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) place_corners(t);
    for (int level = 1; level <= result_.levels().largest(); ++level) {
      for (LocalIndex e = 0; e < complex_.num_edges(); ++e) {
        if (level <= result_.levels().edge(e)) refine_edge(e, result_.edge_intervals(e) >> level);
      }
      for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) {
        if (level > result_.levels().triangle(t)) continue;
        refine_triangle(t, result_.triangle_intervals(t) >> level);
      }
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool has_parameters() const { return !triangle_uv_.empty(); }

  [[nodiscard]] Vec3 coarse_position(LocalIndex vertex) const
  {
    return context_.coarse.position(complex_.vertex_coarse[at(vertex)]);
  }

  void place_ends(LocalIndex e)
  {
    const LocalIndex edge = complex_.edge_skeleton[at(e)];
    for (LocalIndex end = 0; end < 2; ++end) {
      const LocalIndex k = end * result_.edge_intervals(e);
      result_.place_edge_point(e, k, coarse_position(complex_.edge_vertices[2 * at(e) + at(end)]));
      if (edge == kNoIndex || !has_parameters()) continue;
      const double* p = &context_.skeleton.edge_parameters[2 * (2 * at(edge) + at(end))];
      edge_parameters_[result_.edge_place(e, k)] = {p[0], p[1]};
    }
  }

  void place_corners(LocalIndex t)
  {
    const LocalIndex triangle = complex_.triangle_skeleton[at(t)];
    const LocalIndex n = result_.triangle_intervals(t);
    const std::array<TrianglePoint, 3> corners{{{0, 0}, {n, 0}, {0, n}}};
    for (std::size_t c = 0; c < 3; ++c) {
      result_.place_triangle_point(t, corners[c],
                                   coarse_position(complex_.triangle_vertices[3 * at(t) + c]));
      if (triangle == kNoIndex || !has_parameters()) continue;
      const double* uv = &context_.skeleton.triangle_uv[2 * (3 * at(triangle) + c)];
      triangle_uv_[result_.triangle_place(t, corners[c])] = {uv[0], uv[1]};
    }
  }

  void refine_edge(LocalIndex e, LocalIndex step)
  {
    const LocalIndex edge = complex_.edge_skeleton[at(e)];
    for (LocalIndex k = step; k < result_.edge_intervals(e); k += 2 * step) {
      const Vec3 chord = midpoint(result_.edge_point(e, k - step), result_.edge_point(e, k + step));
      const bool is_free = edge == kNoIndex || context_.skeleton.edge_patch[at(edge)] == kNoIndex;
      result_.place_edge_point(e, k, is_free ? chord : place_on_geometry(e, k, step, chord));
    }
  }

  // Onto the edge's curve if it has one, else onto the patch of its canonical record.
  Vec3 place_on_geometry(LocalIndex e, LocalIndex k, LocalIndex step, const Vec3& chord)
  {
    const std::size_t edge = at(complex_.edge_skeleton[at(e)]);
    SurfaceParameters parameters{};
    if (has_parameters()) {
      parameters = middle(edge_parameters_[result_.edge_place(e, k - step)],
                          edge_parameters_[result_.edge_place(e, k + step)]);
    }
    const LocalIndex curve = context_.skeleton.edge_curve[edge];
    const auto project = [&](const Vec3& point, const SurfaceParameters& guess) {
      if (curve == kNoIndex) {
        return context_.model.project_to_surface(surface_of(context_.skeleton.edge_patch[edge]),
                                                 point, guess);
      }
      const model::CurvePoint on_curve = context_.model.project_to_curve(curve, point, guess[0]);
      return model::SurfacePoint{on_curve.xyz, {on_curve.t, 0.0}};
    };
    const model::SurfacePoint projected = project(chord, parameters);
    if (has_parameters()) edge_parameters_[result_.edge_place(e, k)] = projected.uv;
    return limit(
        chord, projected,
        mesh::LatticePointKey::on_edge(complex_.edge_skeleton[at(e)], result_.edge_intervals(e), k),
        project);
  }

  void refine_triangle(LocalIndex t, LocalIndex step)
  {
    const LocalIndex n = result_.triangle_intervals(t);
    for (std::size_t side = 0; side < 3; ++side) {
      for (LocalIndex k = step; k < n; k += 2 * step) copy_side_point(t, side, k, step);
    }
    for (LocalIndex j = step; j < n; j += step) {
      const bool row_is_old = (j / step) % 2 == 0;
      for (LocalIndex i = step; i + j < n; i += step) {
        if (row_is_old && (i / step) % 2 == 0) continue;
        refine_inner_point(t, {i, j}, step);
      }
    }
  }

  // The points of a side are those of its edge. The triangle only finds its own parameters for
  // them, because triangles on two sides of a periodic seam need different branches.
  void copy_side_point(LocalIndex t, std::size_t side, LocalIndex k, LocalIndex step)
  {
    const TrianglePoint p = lattice::side_point(result_.triangle_intervals(t), side, k);
    const LocalIndex e = complex_.triangle_edges[3 * at(t) + side];
    const int finer_by = result_.levels().edge(e) - result_.levels().triangle(t);
    const Vec3 point = result_.edge_point(e, k << finer_by);
    result_.place_triangle_point(t, p, point);
    const LocalIndex patch = patch_of(t);
    if (patch == kNoIndex || !has_parameters()) return;
    triangle_uv_[result_.triangle_place(t, p)] =
        context_.model.project_to_surface(surface_of(patch), point, guess_uv(t, p, step)).uv;
  }

  void refine_inner_point(LocalIndex t, const TrianglePoint& p, LocalIndex step)
  {
    const auto [a, b] = lattice::parents(p, step);
    const Vec3 chord = midpoint(result_.triangle_point(t, a), result_.triangle_point(t, b));
    Vec3 point = chord;
    if (const LocalIndex patch = patch_of(t); patch != kNoIndex) {
      const auto project = [&](const Vec3& at_point, const SurfaceParameters& guess) {
        return context_.model.project_to_surface(surface_of(patch), at_point, guess);
      };
      const model::SurfacePoint projected =
          project(chord, has_parameters() ? guess_uv(t, p, step) : SurfaceParameters{});
      if (has_parameters()) triangle_uv_[result_.triangle_place(t, p)] = projected.uv;
      point = limit(chord, projected,
                    mesh::LatticePointKey::on_triangle(complex_.triangle_skeleton[at(t)],
                                                       result_.triangle_intervals(t), p),
                    project);
    }
    result_.place_triangle_point(t, p, point);
  }

  [[nodiscard]] SurfaceParameters guess_uv(LocalIndex t, const TrianglePoint& p,
                                           LocalIndex step) const
  {
    const auto [a, b] = lattice::parents(p, step);
    return middle(triangle_uv_[result_.triangle_place(t, a)],
                  triangle_uv_[result_.triangle_place(t, b)]);
  }

  [[nodiscard]] LocalIndex patch_of(LocalIndex t) const
  {
    const LocalIndex triangle = complex_.triangle_skeleton[at(t)];
    return triangle == kNoIndex ? kNoIndex : context_.skeleton.triangle_patch[at(triangle)];
  }

  [[nodiscard]] LocalIndex surface_of(LocalIndex patch) const
  {
    return context_.coarse.patch_surface[at(patch)];
  }

  // As far towards its projection as the limiter lets a point go; measures how far off the geometry
  // that is.
  template <class Project>
  Vec3 limit(const Vec3& chord, const model::SurfacePoint& projected,
             const mesh::LatticePointKey& key, const Project& project)
  {
    const double factor = context_.limiter.factor(key);
    const Vec3 point = factor == 1.0 ? projected.xyz : chord + factor * (projected.xyz - chord);
    if (context_.measure_distance) {
      mesh::ModelDistance& distance = result_.distance;
      const double off = norm(project(point, projected.uv).xyz - point);
      double& largest = factor == 1.0 ? distance.largest : distance.largest_held_back;
      largest = std::max(largest, off);
      distance.num_held_back += factor == 1.0 ? 0 : 1;
    }
    return point;
  }

  const mesh::Complex& complex_;
  const RefineContext& context_;
  mesh::RefinedLattice result_;
  std::vector<SurfaceParameters> edge_parameters_{};  ///< As edge_points(), of parametric models.
  std::vector<SurfaceParameters> triangle_uv_{};      ///< As triangle_points(), likewise.
};

}  // namespace

mesh::RefinedLattice refine_lattice(const mesh::Complex& complex, mesh::LatticeLevels levels,
                                    const RefineContext& context)
{
  return LatticeRefiner(complex, std::move(levels), context).run();
}

mesh::RefinedLattice refine_lattice(const mesh::Complex& complex, const RefineContext& context)
{
  return refine_lattice(complex, mesh::lattice_levels(complex, context.levels), context);
}

}  // namespace tessera::refine

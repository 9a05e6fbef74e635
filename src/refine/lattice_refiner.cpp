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

void store(std::vector<double>& xyz, std::size_t row, const Vec3& point)
{
  std::copy(point.begin(), point.end(), xyz.begin() + static_cast<std::ptrdiff_t>(3 * row));
}

// Refines one complex; lives for one call of refine_lattice().
class LatticeRefiner {
 public:
  LatticeRefiner(const mesh::Complex& complex, const RefineContext& context)
      : complex_(complex),
        context_(context),
        n_(lattice::intervals(context.levels)),
        edge_row_(at(n_) + 1),
        triangle_row_(at(lattice::num_triangle_points(n_)))
  {
    const std::size_t edge_points = edge_row_ * at(complex.num_edges());
    const std::size_t triangle_points = triangle_row_ * at(complex.num_triangles());
    result_.n = n_;
    result_.edge_xyz.resize(3 * edge_points);
    result_.triangle_xyz.resize(3 * triangle_points);
    if (context.model.has_parameters()) {
      edge_parameters_.resize(edge_points);
      triangle_uv_.resize(triangle_points);
    }
  }

  mesh::RefinedLattice run()
  {
    for (LocalIndex e = 0; e < complex_.num_edges(); ++e) place_ends(e);
    for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) place_corners(t);
    for (LocalIndex step = n_ / 2; step >= 1; step /= 2) {
      for (LocalIndex e = 0; e < complex_.num_edges(); ++e) refine_edge(e, step);
      for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) refine_triangle(t, step);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool has_parameters() const { return !triangle_uv_.empty(); }

  [[nodiscard]] std::size_t edge_place(LocalIndex e, LocalIndex k) const
  {
    return at(e) * edge_row_ + at(k);
  }

  [[nodiscard]] std::size_t triangle_place(LocalIndex t, const TrianglePoint& p) const
  {
    return at(t) * triangle_row_ + at(lattice::triangle_index(n_, p.i, p.j));
  }

  [[nodiscard]] Vec3 coarse_position(LocalIndex vertex) const
  {
    return context_.coarse.position(complex_.vertex_coarse[at(vertex)]);
  }

  void place_ends(LocalIndex e)
  {
    const LocalIndex edge = complex_.edge_skeleton[at(e)];
    for (LocalIndex end = 0; end < 2; ++end) {
      const std::size_t place = edge_place(e, end * n_);
      store(result_.edge_xyz, place, coarse_position(complex_.edge_vertices[2 * at(e) + at(end)]));
      if (edge == kNoIndex || !has_parameters()) continue;
      const double* p = &context_.skeleton.edge_parameters[2 * (2 * at(edge) + at(end))];
      edge_parameters_[place] = {p[0], p[1]};
    }
  }

  void place_corners(LocalIndex t)
  {
    const LocalIndex triangle = complex_.triangle_skeleton[at(t)];
    const std::array<TrianglePoint, 3> corners{{{0, 0}, {n_, 0}, {0, n_}}};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t place = triangle_place(t, corners[c]);
      store(result_.triangle_xyz, place,
            coarse_position(complex_.triangle_vertices[3 * at(t) + c]));
      if (triangle == kNoIndex || !has_parameters()) continue;
      const double* uv = &context_.skeleton.triangle_uv[2 * (3 * at(triangle) + c)];
      triangle_uv_[place] = {uv[0], uv[1]};
    }
  }

  void refine_edge(LocalIndex e, LocalIndex step)
  {
    const LocalIndex edge = complex_.edge_skeleton[at(e)];
    for (LocalIndex k = step; k < n_; k += 2 * step) {
      const Vec3 chord = midpoint(result_.edge_point(e, k - step), result_.edge_point(e, k + step));
      const bool is_free = edge == kNoIndex || context_.skeleton.edge_patch[at(edge)] == kNoIndex;
      store(result_.edge_xyz, edge_place(e, k),
            is_free ? chord : place_on_geometry(e, k, step, chord));
    }
  }

  // Onto the edge's curve if it has one, else onto the patch of its canonical record.
  Vec3 place_on_geometry(LocalIndex e, LocalIndex k, LocalIndex step, const Vec3& chord)
  {
    const std::size_t edge = at(complex_.edge_skeleton[at(e)]);
    SurfaceParameters parameters{};
    if (has_parameters()) {
      parameters = middle(edge_parameters_[edge_place(e, k - step)],
                          edge_parameters_[edge_place(e, k + step)]);
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
    if (has_parameters()) edge_parameters_[edge_place(e, k)] = projected.uv;
    return limit(chord, projected,
                 mesh::LatticePointKey::on_edge(complex_.edge_skeleton[at(e)], n_, k), project);
  }

  void refine_triangle(LocalIndex t, LocalIndex step)
  {
    for (std::size_t side = 0; side < 3; ++side) {
      for (LocalIndex k = step; k < n_; k += 2 * step) copy_side_point(t, side, k, step);
    }
    for (LocalIndex j = step; j < n_; j += step) {
      const bool row_is_old = (j / step) % 2 == 0;
      for (LocalIndex i = step; i + j < n_; i += step) {
        if (row_is_old && (i / step) % 2 == 0) continue;
        refine_inner_point(t, {i, j}, step);
      }
    }
  }

  // The points of a side are those of its edge. The triangle only finds its own parameters for
  // them, because triangles on two sides of a periodic seam need different branches.
  void copy_side_point(LocalIndex t, std::size_t side, LocalIndex k, LocalIndex step)
  {
    const TrianglePoint p = lattice::side_point(n_, side, k);
    const Vec3 point = result_.edge_point(complex_.triangle_edges[3 * at(t) + side], k);
    store(result_.triangle_xyz, triangle_place(t, p), point);
    const LocalIndex patch = patch_of(t);
    if (patch == kNoIndex || !has_parameters()) return;
    triangle_uv_[triangle_place(t, p)] =
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
      if (has_parameters()) triangle_uv_[triangle_place(t, p)] = projected.uv;
      point = limit(chord, projected,
                    mesh::LatticePointKey::on_triangle(complex_.triangle_skeleton[at(t)], n_, p),
                    project);
    }
    store(result_.triangle_xyz, triangle_place(t, p), point);
  }

  [[nodiscard]] SurfaceParameters guess_uv(LocalIndex t, const TrianglePoint& p,
                                           LocalIndex step) const
  {
    const auto [a, b] = lattice::parents(p, step);
    return middle(triangle_uv_[triangle_place(t, a)], triangle_uv_[triangle_place(t, b)]);
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
  LocalIndex n_;
  std::size_t edge_row_;
  std::size_t triangle_row_;
  mesh::RefinedLattice result_{};
  std::vector<SurfaceParameters> edge_parameters_{};  ///< As edge_xyz; only for parametric models.
  std::vector<SurfaceParameters> triangle_uv_{};      ///< As triangle_xyz; likewise.
};

}  // namespace

mesh::RefinedLattice refine_lattice(const mesh::Complex& complex, const RefineContext& context)
{
  return LatticeRefiner(complex, context).run();
}

}  // namespace tessera::refine

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/lattice_refiner.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "refine/image_points.hpp"
#include "refine/limited.hpp"
#include "refine/sides.hpp"

namespace tessera::refine {
namespace {

namespace lattice = mesh::lattice;
using lattice::TrianglePoint;
using model::SurfaceParameters;

SurfaceParameters middle(const SurfaceParameters& a, const SurfaceParameters& b)
{
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

// Points inside of a triangle with `n` intervals a side that are new with this step.
template <class Visit>
void for_each_new_inner_point(LocalIndex n, LocalIndex step, const Visit& visit)
{
  for (LocalIndex j = step; j < n; j += step) {
    const bool row_is_old = (j / step) % 2 == 0;
    for (LocalIndex i = step; i + j < n; i += step) {
      if (!row_is_old || (i / step) % 2 != 0) visit(TrianglePoint{i, j});
    }
  }
}

// Refines one complex; lives for one call of refine_lattice(). On the side of the walls only what
// lies on them gets points; on the side of the tets these follow from the walls' points.
//
// What is the image of something at another place gets the points of that.
class LatticeRefiner {
 public:
  LatticeRefiner(const mesh::Complex& complex, mesh::LatticeLevels levels,
                 const RefineContext& context, Side side = Side::tets)
      : complex_(complex),
        context_(context),
        orbits_(context.skeleton.orbits),
        side_(side),
        result_(std::move(levels))
  {
    if (!context.model.has_parameters()) return;
    edge_parameters_.resize(result_.edge_points().size());
    triangle_uv_.resize(result_.triangle_points().size());
  }

  // What is an image is not where it belongs yet: move_to_images().
  // @param[in] walls Points of the other side; null without layers.
  mesh::RefinedLattice run(const mesh::RefinedLattice* walls = nullptr)
  {
    for (LocalIndex e = 0; e < complex_.num_edges(); ++e) place_ends(e);
    for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) place_corners(t);
    walls_ = walls;
    for (int level = 1; level <= result_.levels().largest(); ++level) {
      for (LocalIndex e = 0; e < complex_.num_edges(); ++e) {
        if (level <= result_.levels().edge(e)) refine_edge_on(level, e);
      }
      for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) {
        if (level <= result_.levels().triangle(t)) refine_triangle_on(level, t);
      }
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool has_parameters() const { return context_.model.has_parameters(); }

  void refine_edge_on(int level, LocalIndex e)
  {
    const LocalIndex step = result_.edge_intervals(e) >> level;
    if (is_wall_edge(complex_, context_, e) == (side_ == Side::walls)) return refine_edge(e, step);
    if (walls_ != nullptr) refine_edge_behind_wall(e, step);
  }

  void refine_triangle_on(int level, LocalIndex t)
  {
    const LocalIndex step = result_.triangle_intervals(t) >> level;
    if (is_wall_triangle(complex_, context_, t) == (side_ == Side::walls)) {
      return refine_triangle(t, step);
    }
    if (walls_ != nullptr) refine_triangle_behind_wall(t, step);
  }

  // The skeleton's edge or triangle that one of the complex is refined as; kNoIndex inside.
  [[nodiscard]] LocalIndex edge_origin(LocalIndex e) const
  {
    const LocalIndex edge = complex_.edge_skeleton[at(e)];
    return edge == kNoIndex ? kNoIndex : orbits_of_edge(context_, side_, edge).origin_of(edge);
  }
  [[nodiscard]] LocalIndex triangle_origin(LocalIndex t) const
  {
    const LocalIndex triangle = complex_.triangle_skeleton[at(t)];
    return triangle == kNoIndex ? kNoIndex : orbits_.triangles.origin_of(triangle);
  }

  // Coarse vertex of a corner of what is refined; `local` is that of the complex.
  [[nodiscard]] LocalIndex coarse_vertex(const FlatArray<LocalIndex>& of_skeleton,
                                         std::size_t corner, LocalIndex origin,
                                         LocalIndex local) const
  {
    return origin == kNoIndex ? complex_.vertex_coarse[at(local)]
                              : context_.skeleton.vertex_coarse[at(of_skeleton[corner])];
  }

  // Coarse vertex of an end of the edge that one of the complex is refined as.
  [[nodiscard]] LocalIndex end_of_edge(LocalIndex e, LocalIndex end) const
  {
    const LocalIndex edge = edge_origin(e);
    return coarse_vertex(context_.skeleton.edge_vertices, 2 * at(edge) + at(end), edge,
                         complex_.edge_vertices[2 * at(e) + at(end)]);
  }

  // Where an edge is refined. The other side of a joint may have a column there.
  [[nodiscard]] Vec3 position_of_end(LocalIndex e, LocalIndex end) const
  {
    const LocalIndex own = complex_.vertex_coarse[at(complex_.edge_vertices[2 * at(e) + at(end)])];
    const bool is_on_geometry = !context_.coarse.layers.are_none() && !has_column(context_, own);
    return end_of_column(context_, is_on_geometry ? Side::walls : side_, end_of_edge(e, end));
  }

  [[nodiscard]] Vec3 coarse_position(LocalIndex v) const
  {
    return end_of_column(context_, side_, v);
  }

  // Length of the column of a coarse vertex.
  [[nodiscard]] double coarse_length(LocalIndex v) const
  {
    return norm(context_.coarse.position(v) - context_.coarse.layers.wall(v));
  }

  // A column in the middle of two others, from the wall to the tets. Columns that lean apart are
  // shorter in between; so it gets the length that is wanted, as far as its point may go onto the
  // geometry. If it may not go at all, its end is in the middle of the others' ends, as without
  // layers.
  [[nodiscard]] Vec3 column_between(const Vec3& a, const Vec3& b, double wanted_length,
                                    const mesh::LatticePointKey& key) const
  {
    const Vec3 column = midpoint(a, b);
    const double length = norm(column);
    if (!(length > 0.0)) return column;
    return (1.0 + context_.limiter.factor(key) * (wanted_length / length - 1.0)) * column;
  }

  void refine_edge_behind_wall(LocalIndex e, LocalIndex step)
  {
    const LocalIndex n = result_.edge_intervals(e);
    if (!has_columns(context_, complex_.edge_skeleton[at(e)])) {
      for (LocalIndex k = step; k < n; k += 2 * step) {
        result_.place_edge_point(e, k, walls_->edge_point(e, k));
      }
      return;
    }
    const LocalIndex edge = edge_origin(e);
    const double first = coarse_length(end_of_edge(e, 0));
    const double last = coarse_length(end_of_edge(e, 1));
    const auto column = [&](LocalIndex k) {
      return result_.edge_point(e, k) - walls_->edge_point(e, k);
    };
    for (LocalIndex k = step; k < n; k += 2 * step) {
      const double part = static_cast<double>(k) / n;
      const Vec3 straight =
          walls_->edge_point(e, k)
          + column_between(column(k - step), column(k + step), first + part * (last - first),
                           mesh::LatticePointKey::on_edge(edge, n, k));
      // Along the rim of a wall columns begin on the patch beside it.
      result_.place_edge_point(e, k, side_point_of_edge(context_, edge, n, k, straight));
    }
  }

  void refine_triangle_behind_wall(LocalIndex t, LocalIndex step)
  {
    const LocalIndex n = result_.triangle_intervals(t);
    for (std::size_t side = 0; side < 3; ++side) {
      for (LocalIndex k = step; k < n; k += 2 * step) {
        result_.place_triangle_point(t, lattice::side_point(n, side, k), side_point(t, side, k));
      }
    }
    for_each_new_inner_point(n, step, [&](const TrianglePoint& p) {
      const auto [a, b] = lattice::parents(p, step);
      const auto key = mesh::LatticePointKey::on_triangle(complex_.triangle_skeleton[at(t)], n, p);
      result_.place_triangle_point(
          t, p,
          walls_->triangle_point(t, p)
              + column_between(column_at(t, a), column_at(t, b), wanted_length(t, p), key));
    });
  }

  [[nodiscard]] Vec3 column_at(LocalIndex t, const TrianglePoint& p) const
  {
    return result_.triangle_point(t, p) - walls_->triangle_point(t, p);
  }

  [[nodiscard]] double wanted_length(LocalIndex t, const TrianglePoint& p) const
  {
    const LocalIndex* v = &complex_.triangle_vertices[3 * at(t)];
    const auto length = [&](std::size_t c) {
      return coarse_length(complex_.vertex_coarse[at(v[c])]);
    };
    const LocalIndex n = result_.triangle_intervals(t);
    return length(0) + static_cast<double>(p.i) / n * (length(1) - length(0))
           + static_cast<double>(p.j) / n * (length(2) - length(0));
  }

  // Of the edge that is this side of a triangle, where the triangle is refined.
  [[nodiscard]] Vec3 side_point(LocalIndex t, std::size_t side, LocalIndex k) const
  {
    const Vec3 point = point_of_side(complex_, result_, t, side, k);
    if (orbits_.are_none()) return point;
    const LocalIndex origin = triangle_origin(t);
    const LocalIndex edge =
        origin == kNoIndex ? complex_.edge_skeleton[at(complex_.triangle_edges[3 * at(t) + side])]
                           : context_.skeleton.triangle_edges[3 * at(origin) + side];
    if (edge == kNoIndex) return point;
    return orbits_.image(orbits_of_edge(context_, side_, edge).image_of(edge), point);
  }

  void place_ends(LocalIndex e)
  {
    const LocalIndex edge = edge_origin(e);
    for (LocalIndex end = 0; end < 2; ++end) {
      const LocalIndex k = end * result_.edge_intervals(e);
      result_.place_edge_point(e, k, position_of_end(e, end));
      if (edge == kNoIndex || !has_parameters()) continue;
      const double* p = &context_.skeleton.edge_parameters[2 * (2 * at(edge) + at(end))];
      edge_parameters_[result_.edge_place(e, k)] = {p[0], p[1]};
    }
  }

  void place_corners(LocalIndex t)
  {
    const LocalIndex triangle = triangle_origin(t);
    const LocalIndex n = result_.triangle_intervals(t);
    const std::array<TrianglePoint, 3> corners{{{0, 0}, {n, 0}, {0, n}}};
    for (std::size_t c = 0; c < 3; ++c) {
      result_.place_triangle_point(
          t, corners[c],
          coarse_position(coarse_vertex(context_.skeleton.triangle_vertices, 3 * at(triangle) + c,
                                        triangle, complex_.triangle_vertices[3 * at(t) + c])));
      if (triangle == kNoIndex || !has_parameters()) continue;
      const double* uv = &context_.skeleton.triangle_uv[2 * (3 * at(triangle) + c)];
      triangle_uv_[result_.triangle_place(t, corners[c])] = {uv[0], uv[1]};
    }
  }

  void refine_edge(LocalIndex e, LocalIndex step)
  {
    const LocalIndex edge = edge_origin(e);
    for (LocalIndex k = step; k < result_.edge_intervals(e); k += 2 * step) {
      const Vec3 chord = midpoint(result_.edge_point(e, k - step), result_.edge_point(e, k + step));
      const bool is_free = edge == kNoIndex || context_.skeleton.edge_patch[at(edge)] == kNoIndex;
      result_.place_edge_point(e, k, is_free ? chord : place_on_geometry(e, k, step, chord));
    }
  }

  // Onto the edge's curve if it has one, else onto the patch of its canonical record.
  Vec3 place_on_geometry(LocalIndex e, LocalIndex k, LocalIndex step, const Vec3& chord)
  {
    const std::size_t edge = at(edge_origin(e));
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
    return limit(chord, projected,
                 mesh::LatticePointKey::on_edge(edge_origin(e), result_.edge_intervals(e), k),
                 project);
  }

  void refine_triangle(LocalIndex t, LocalIndex step)
  {
    const LocalIndex n = result_.triangle_intervals(t);
    for (std::size_t side = 0; side < 3; ++side) {
      for (LocalIndex k = step; k < n; k += 2 * step) copy_side_point(t, side, k, step);
    }
    for_each_new_inner_point(n, step,
                             [&](const TrianglePoint& p) { refine_inner_point(t, p, step); });
  }

  // The points of a side are those of its edge. The triangle only finds its own parameters for
  // them, because triangles on two sides of a periodic seam need different branches.
  void copy_side_point(LocalIndex t, std::size_t side, LocalIndex k, LocalIndex step)
  {
    const TrianglePoint p = lattice::side_point(result_.triangle_intervals(t), side, k);
    const Vec3 point = side_point(t, side, k);
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
      point = limit(
          chord, projected,
          mesh::LatticePointKey::on_triangle(triangle_origin(t), result_.triangle_intervals(t), p),
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

  // kNoIndex: it lies on no geometry.
  [[nodiscard]] LocalIndex patch_of(LocalIndex t) const
  {
    const LocalIndex triangle = triangle_origin(t);
    if (triangle == kNoIndex) return kNoIndex;
    const LocalIndex patch = context_.skeleton.triangle_patch[at(triangle)];
    return context_.coarse.is_wake(patch) ? kNoIndex : patch;
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
    const Vec3 point = limited(chord, projected.xyz, factor);
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
  const mesh::Orbits& orbits_;
  Side side_;
  const mesh::RefinedLattice* walls_ = nullptr;  // Points of the other side; none without layers.
  mesh::RefinedLattice result_;
  std::vector<SurfaceParameters> edge_parameters_{};  ///< As edge_points(), of parametric models.
  std::vector<SurfaceParameters> triangle_uv_{};      ///< As triangle_points(), likewise.
};

// What is not on a wall ends where it begins.
void place_beside_walls(const mesh::Complex& complex, const RefineContext& context,
                        const mesh::RefinedLattice& tets, mesh::RefinedLattice& walls)
{
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    if (is_wall_edge(complex, context, e)) continue;
    for (LocalIndex k = 1; k < tets.edge_intervals(e); ++k) {
      walls.place_edge_point(e, k, tets.edge_point(e, k));
    }
  }
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    if (is_wall_triangle(complex, context, t)) continue;
    const LocalIndex n = tets.triangle_intervals(t);
    for (LocalIndex j = 1; j < n; ++j) {
      for (LocalIndex i = 1; i + j < n; ++i) {
        walls.place_triangle_point(t, {i, j}, tets.triangle_point(t, {i, j}));
      }
    }
  }
}

void add(const mesh::ModelDistance& more, mesh::ModelDistance& sum)
{
  sum.largest = std::max(sum.largest, more.largest);
  sum.largest_held_back = std::max(sum.largest_held_back, more.largest_held_back);
  sum.num_held_back += more.num_held_back;
}

}  // namespace

mesh::RefinedLattice refine_lattice(const mesh::Complex& complex, mesh::LatticeLevels levels,
                                    const RefineContext& context)
{
  const auto move = [&](Side side, mesh::RefinedLattice& points) {
    move_to_images(
        complex, context.skeleton.orbits,
        [&](LocalIndex edge) -> const mesh::OrbitTable& {
          return orbits_of_edge(context, side, edge);
        },
        [&](LocalIndex v) { return end_of_column(context, side, v); }, points);
  };
  if (context.coarse.layers.are_none()) {
    mesh::RefinedLattice points = LatticeRefiner(complex, std::move(levels), context).run();
    move(Side::tets, points);
    return points;
  }
  auto walls = std::make_shared<mesh::RefinedLattice>(
      LatticeRefiner(complex, levels, context, Side::walls).run());
  mesh::RefinedLattice tets = LatticeRefiner(complex, std::move(levels), context).run(walls.get());
  move(Side::walls, *walls);
  move(Side::tets, tets);
  place_beside_walls(complex, context, tets, *walls);
  add(walls->distance, tets.distance);
  tets.walls = std::move(walls);
  return tets;
}

mesh::RefinedLattice refine_lattice(const mesh::Complex& complex, const RefineContext& context)
{
  return refine_lattice(complex, mesh::lattice_levels(complex, context.levels), context);
}

}  // namespace tessera::refine

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Vec.hxx>

#include "tessera/model/model.hpp"

#include "cad/project/curve.hpp"
#include "cad/project/trim.hpp"

namespace tessera::cad {

/// @brief The surface of one CAD face within its trimming edges, and projection onto it.
///
/// Evaluates the Geom_Surface itself, not an adaptor, for the reason given at OccCurve. Parameters
/// of a periodic surface are never wrapped: an answer stays on the branch of its guess.
class OccSurface {
 public:
  using Uv = model::SurfaceParameters;

  /// @param box_diagonal Diagonal of the model's box; the unit of the tolerances.
  /// @param num_faces Of the model: with many, each keeps a coarser grid over its parameters.
  OccSurface(const TopoDS_Face& face, double box_diagonal, int num_faces);

  /// @brief The face's own tolerance, at least 1e-8 of the box diagonal.
  [[nodiscard]] double tolerance() const { return tolerance_; }

  /// @brief The local nearest point that a descent from `guess` reaches, if it lies within the
  /// trimming edges; else the nearest point of the whole face.
  [[nodiscard]] model::SurfacePoint project(const Vec3& point, const Uv& guess) const;

  /// @brief Like project(), for a point known to lie on the face. If the local answer is farther
  /// off than the tolerance, gives the nearer of it and the global one.
  [[nodiscard]] model::SurfacePoint locate(const Vec3& point, const Uv& guess) const;

  /// @brief Parameters of the corners of a triangle on this face, all on one branch. No side of the
  /// triangle jumps a seam in parameters. A corner at a pole has the others' free parameter.
  /// @param guesses Where to look first; may be far off.
  [[nodiscard]] std::array<Uv, 3> triangle_parameters(const std::array<Vec3, 3>& corners,
                                                      const std::array<Uv, 3>& guesses) const;

 private:
  /// One parameter direction.
  struct Direction {
    double domain_first = 0.0;  ///< Where the surface can be evaluated; infinite if periodic.
    double domain_last = 0.0;
    double face_first = 0.0;  ///< What the trimmed face spans.
    double face_last = 0.0;
    double period = 0.0;  ///< 0: the surface does not close in this direction.

    [[nodiscard]] double span() const { return face_last - face_first; }
  };

  struct Descent {
    model::SurfacePoint point{};
    double distance = 0.0;
    bool converged = false;
    bool is_pole = false;
  };

  struct Evaluation {
    Uv uv{};
    gp_Pnt value{};
    std::array<gp_Vec, 2> first{};
    gp_Vec by_uu{};
    gp_Vec by_vv{};
    gp_Vec by_uv{};
    double distance = 0.0;  ///< To the target of the descent.
  };

  /// @see cad::descend()
  struct Step {
    Uv uv{};
    double length = 0.0;
    bool is_valley = false;
  };

  struct Boundary {
    OccCurve curve;
    Handle(Geom2d_Curve) on_surface;  ///< Along a seam, either of the two.
  };

  void close_at_seam(const std::array<double, 2>& width);
  void collect_boundaries(const TopoDS_Face& face, double box_diagonal);
  [[nodiscard]] Descent descend(const Vec3& point, const Uv& guess) const;
  [[nodiscard]] Evaluation evaluate(const gp_Pnt& target, const Uv& uv) const;
  [[nodiscard]] Step step_at(const gp_Pnt& target, const Evaluation& here) const;
  [[nodiscard]] bool is_degenerate(const std::array<gp_Vec, 2>& first, std::size_t direction) const;
  [[nodiscard]] std::array<bool, 2> degenerate_directions(const Uv& uv) const;
  [[nodiscard]] Uv clamped(const Uv& uv) const;
  [[nodiscard]] bool within_trim(const model::SurfacePoint& point) const;
  [[nodiscard]] bool is_on_boundary(const Vec3& point) const;
  [[nodiscard]] model::SurfacePoint nearest(const Vec3& point, const Uv& guess) const;
  [[nodiscard]] Descent nearest_inside(const Vec3& point) const;
  [[nodiscard]] Descent nearest_boundary(const Vec3& point) const;
  [[nodiscard]] std::vector<Uv> descent_starts(const Vec3& point) const;
  [[nodiscard]] Uv sample_parameters(int row, int column) const;
  [[nodiscard]] const std::vector<gp_Pnt>& samples() const;
  [[nodiscard]] static double on_branch_of(double value, double reference,
                                           const Direction& direction);
  static void unwrap(std::span<double* const> values, const Direction& direction);

  Handle(Geom_Surface) surface_;
  std::array<Direction, 2> directions_{};
  std::vector<Boundary> boundaries_{};
  std::unique_ptr<OccTrim> trim_{};
  double tolerance_ = 0.0;
  double box_diagonal_ = 0.0;
  std::array<int, 2> num_samples_{};       ///< Grid of the global search.
  mutable std::vector<gp_Pnt> samples_{};  ///< On that grid, row by row; made when first asked for.
};

}  // namespace tessera::cad

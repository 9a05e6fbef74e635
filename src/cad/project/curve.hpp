// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Bnd_Box.hxx>
#include <Geom_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "tessera/model/model.hpp"

namespace tessera::cad {

/// @brief The curve of one CAD edge between its ends, and projection onto it.
///
/// Evaluates the Geom_Curve itself, not an adaptor. Adaptors keep the polynomial of the last span,
/// so on a knot their bits would depend on what was asked before.
class OccCurve {
 public:
  /// @param box_diagonal Diagonal of the model's box; the unit of the tolerances.
  /// @throws GeometryError if the edge has no curve in space.
  OccCurve(const TopoDS_Edge& edge, double box_diagonal);

  /// @brief The edge's own tolerance, at least 1e-8 of the box diagonal.
  [[nodiscard]] double tolerance() const { return tolerance_; }

  /// @brief The tolerance of the vertex at that end of the edge which `point` lies within; the
  /// edge's own if it lies within none. At least the edge's own.
  [[nodiscard]] double end_tolerance(const Vec3& point) const;

  [[nodiscard]] double first() const { return first_; }
  [[nodiscard]] double last() const { return last_; }

  /// @brief The local nearest point that a descent from `guess` reaches; the global one if the
  /// descent does not converge. The parameter stays in [first, last].
  [[nodiscard]] model::CurvePoint project(const Vec3& point, double guess) const;

  /// @brief Like project(), for a point known to lie on the curve. If the local answer is farther
  /// off than the tolerance, gives the nearer of it and the global one.
  [[nodiscard]] model::CurvePoint locate(const Vec3& point, double guess) const;

  /// @brief The nearest point of the whole curve.
  [[nodiscard]] model::CurvePoint nearest(const Vec3& point) const;

  /// @brief Whether the curve comes within `distance` of the point.
  [[nodiscard]] bool is_within(double distance, const Vec3& point) const;

 private:
  struct Descent {
    model::CurvePoint point{};
    double distance = 0.0;
    bool converged = false;
  };

  struct Evaluation {
    double t = 0.0;
    gp_Pnt value{};
    gp_Vec first_derivative{};
    gp_Vec second_derivative{};
    double distance = 0.0;  ///< To the target of the descent.
  };

  /// @see cad::descend()
  struct Step {
    double t = 0.0;
    double length = 0.0;
    bool is_valley = false;
  };

  struct End {
    Vec3 point{};
    double tolerance = 0.0;
  };

  [[nodiscard]] Descent descend(const Vec3& point, double guess) const;
  [[nodiscard]] Evaluation evaluate(const gp_Pnt& target, double t) const;
  [[nodiscard]] Step step_at(const gp_Pnt& target, const Evaluation& here) const;
  [[nodiscard]] double sample_parameter(std::size_t i) const;

  double first_ = 0.0;
  double last_ = 0.0;
  Handle(Geom_Curve) curve_;  ///< Sets the two above when it is read from the edge.
  double tolerance_ = 0.0;
  std::vector<End> ends_{};
  double box_diagonal_ = 0.0;
  std::vector<gp_Pnt> samples_{};  ///< Starts of the global search, from end to end.
  Bnd_Box box_{};                  ///< Holds the curve, with room to spare.
};

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <BRepTopAdaptor_FClass2d.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <TopoDS_Face.hxx>

#include "tessera/model/model.hpp"

namespace tessera::cad {

/// @brief Tells whether parameters lie within the trimming edges of a face.
///
/// OpenCASCADE's classifier walks round all edges at each question, which took two thirds of the
/// time of a projection. A grid over the face's parameters, made once, answers for every cell that
/// no trimming edge comes near; the classifier answers for the rest.
class OccTrim {
 public:
  using Uv = model::SurfaceParameters;

  /// @brief Cells a side that each face of a model of so many faces can afford.
  [[nodiscard]] static int fewest_cells(int num_faces);

  /// @param periods Of the surface in u and v; 0 where it is not periodic.
  /// @param fewest_cells Of the grid, a side; a face with many edges gets more.
  OccTrim(const TopoDS_Face& face, const std::array<double, 2>& periods, int fewest_cells);

  /// @brief Whether `uv`, on any branch, is within or on the trimming edges.
  [[nodiscard]] bool contains(const Uv& uv) const;

  /// @brief Whether `uv` is in a cell that is all within the trimming edges. A quick answer: false
  /// says nothing.
  [[nodiscard]] bool is_inside_cell(const Uv& uv) const { return state_at(uv) == Cell::inside; }

 private:
  enum class Cell : char { unknown, boundary, inside, outside };
  using Place = std::array<int, 2>;
  struct CurvePoint {  // Of an edge in the face's parameters.
    double t = 0.0;
    Uv uv{};
  };

  [[nodiscard]] Cell state_at(const Uv& uv) const;
  [[nodiscard]] Cell state_on_branch(const Uv& uv) const;
  [[nodiscard]] Place place_of(const Uv& uv) const;
  [[nodiscard]] Uv centre_of(const Place& place) const;
  [[nodiscard]] bool is_on_grid(const Place& place) const;
  [[nodiscard]] std::size_t index_of(const Place& place) const
  {
    return at(place[0] * num_cells_ + place[1]);
  }
  [[nodiscard]] Cell& cell(const Place& place);
  [[nodiscard]] static CurvePoint point_on(const Geom2dAdaptor_Curve& curve, double t);
  void mark_boundary(const Geom2dAdaptor_Curve& curve, const CurvePoint& first,
                     const CurvePoint& last, int depth);
  void mark_around(const Place& place);
  void fill_from(const Place& start, Cell state);

  std::unique_ptr<BRepTopAdaptor_FClass2d> classifier_;
  std::array<double, 2> periods_;
  std::array<int, 2> num_rounds_{1, 1};  ///< Of the face; a thread goes round more than once.
  int num_cells_;                        ///< A side.
  Uv first_{};
  Uv cell_size_{};
  std::vector<Cell> cells_;  ///< Shape (num_cells_, num_cells_).
};

}  // namespace tessera::cad

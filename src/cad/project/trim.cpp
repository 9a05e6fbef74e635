// SPDX-License-Identifier: BSD-3-Clause
#include "cad/project/trim.hpp"

#include <algorithm>
#include <cmath>

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

namespace tessera::cad {
namespace {

// Cells a side. The classifier's time grows with the number of edges, and so does the part of the
// cells that it has to answer for. With at most 512, it took a third of a plate with some hundred
// holes.
constexpr int kMostCells = 2048;
constexpr int kCellsPerEdge = 8;

constexpr int kNumFirstSteps = 64;  // Along each edge, before steps are halved where they are long.
constexpr int kMaxHalvings = 12;

int cells_for(const TopoDS_Face& face, int fewest)
{
  int num_edges = 0;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) ++num_edges;
  return std::clamp(kCellsPerEdge * num_edges, fewest, kMostCells);
}

// How often a face may meet itself in a direction that closes. What is a little longer than a
// period, as bounds of splines are, is one.
int rounds_of(double span, double period)
{
  constexpr double kSlack = 1e-4;
  return period > 0.0 ? std::max(1, static_cast<int>(std::ceil(span / period - kSlack))) : 1;
}

bool is_in(const BRepTopAdaptor_FClass2d& classifier, const model::SurfaceParameters& uv,
           bool on_any_branch)
{
  return classifier.Perform(gp_Pnt2d(uv[0], uv[1]), on_any_branch) != TopAbs_OUT;
}

}  // namespace

int OccTrim::fewest_cells(int num_faces)
{
  constexpr double kCellsOfModel = 4e6;
  constexpr double kFewest = 64.0;
  constexpr double kEnough = 256.0;
  return static_cast<int>(std::clamp(std::sqrt(kCellsOfModel / num_faces), kFewest, kEnough));
}

OccTrim::OccTrim(const TopoDS_Face& face, const std::array<double, 2>& periods, int fewest_cells)
    : classifier_(std::make_unique<BRepTopAdaptor_FClass2d>(face, Precision::PConfusion())),
      periods_(periods),
      num_cells_(cells_for(face, fewest_cells)),
      cells_(at(num_cells_ * num_cells_), Cell::unknown)
{
  Uv last{};
  BRepTools::UVBounds(face, first_[0], last[0], first_[1], last[1]);
  for (std::size_t k = 0; k < 2; ++k) {
    cell_size_[k] = (last[k] - first_[k]) / num_cells_;
    num_rounds_[k] = rounds_of(last[k] - first_[k], periods_[k]);
  }
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    double from = 0.0;
    double to = 0.0;
    const auto curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, from, to);
    if (curve.IsNull()) continue;
    const Geom2dAdaptor_Curve along(curve, from, to);
    const double step = (to - from) / kNumFirstSteps;
    CurvePoint before = point_on(along, from);
    for (int i = 1; i <= kNumFirstSteps; ++i) {
      const CurvePoint next = point_on(along, from + i * step);
      mark_boundary(along, before, next, kMaxHalvings);
      before = next;
    }
  }
  // No edge passes between cells that are left, so one answer holds for all that hang together.
  for (int i = 0; i < num_cells_; ++i) {
    for (int j = 0; j < num_cells_; ++j) {
      if (cell({i, j}) != Cell::unknown) continue;
      const bool on_any_branch = num_rounds_[0] == 1 && num_rounds_[1] == 1;
      const bool inside = is_in(*classifier_, centre_of({i, j}), on_any_branch);
      fill_from({i, j}, inside ? Cell::inside : Cell::outside);
    }
  }
}

bool OccTrim::contains(const Uv& uv) const
{
  const Cell state = state_at(uv);
  return state == Cell::boundary ? is_in(*classifier_, uv, true) : state == Cell::inside;
}

// The best answer of all branches: a face that goes round more than once passes the same point of
// its surface on several.
OccTrim::Cell OccTrim::state_at(const Uv& uv) const
{
  Uv first = uv;
  for (std::size_t k = 0; k < 2; ++k) {
    if (periods_[k] <= 0.0) continue;
    first[k] -= periods_[k] * std::floor((uv[k] - first_[k]) / periods_[k]);
  }
  Cell best = state_on_branch(first);
  for (int i = 0; i < num_rounds_[0] && best != Cell::inside; ++i) {
    for (int j = i == 0 ? 1 : 0; j < num_rounds_[1] && best != Cell::inside; ++j) {
      const Cell state = state_on_branch({first[0] + i * periods_[0], first[1] + j * periods_[1]});
      if (state != Cell::outside) best = state;
    }
  }
  return best;
}

// Off the grid there may be an edge as well.
OccTrim::Cell OccTrim::state_on_branch(const Uv& uv) const
{
  const Place place = place_of(uv);
  return is_on_grid(place) ? cells_[index_of(place)] : Cell::boundary;
}

OccTrim::Place OccTrim::place_of(const Uv& uv) const
{
  Place place{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double offset = uv[k] - first_[k];
    place[k] =
        static_cast<int>(std::clamp(std::floor(offset / cell_size_[k]), -2.0, num_cells_ + 1.0));
  }
  return place;
}

OccTrim::Uv OccTrim::centre_of(const Place& place) const
{
  return {first_[0] + (place[0] + 0.5) * cell_size_[0],
          first_[1] + (place[1] + 0.5) * cell_size_[1]};
}

bool OccTrim::is_on_grid(const Place& place) const
{
  return std::all_of(place.begin(), place.end(),
                     [this](int i) { return i >= 0 && i < num_cells_; });
}

OccTrim::Cell& OccTrim::cell(const Place& place) { return cells_[index_of(place)]; }

OccTrim::CurvePoint OccTrim::point_on(const Geom2dAdaptor_Curve& curve, double t)
{
  const gp_Pnt2d point = curve.Value(t);
  return {t, {point.X(), point.Y()}};
}

// Marks the cells round a piece of an edge, in steps no longer than half a cell.
void OccTrim::mark_boundary(const Geom2dAdaptor_Curve& curve, const CurvePoint& first,
                            const CurvePoint& last, int depth)
{
  const bool is_short = std::abs(last.uv[0] - first.uv[0]) <= 0.5 * cell_size_[0]
                        && std::abs(last.uv[1] - first.uv[1]) <= 0.5 * cell_size_[1];
  if (is_short || depth == 0) {
    mark_around(place_of(first.uv));
    mark_around(place_of(last.uv));
    return;
  }
  const CurvePoint middle = point_on(curve, 0.5 * (first.t + last.t));
  mark_boundary(curve, first, middle, depth - 1);
  mark_boundary(curve, middle, last, depth - 1);
}

void OccTrim::mark_around(const Place& place)
{
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const Place near{place[0] + i, place[1] + j};
      if (is_on_grid(near)) cell(near) = Cell::boundary;
    }
  }
}

void OccTrim::fill_from(const Place& start, Cell state)
{
  std::vector<Place> open{start};
  cell(start) = state;
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    for (const Place& next : {Place{i - 1, j}, Place{i + 1, j}, Place{i, j - 1}, Place{i, j + 1}}) {
      if (!is_on_grid(next) || cell(next) != Cell::unknown) continue;
      cell(next) = state;
      open.push_back(next);
    }
  }
}

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#include "cad/heal/gaps.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <gp_Pnt.hxx>

#include "tessera/base/repair.hpp"

#include "cad/heal/common_parts.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

using RowPair = std::array<std::size_t, 2>;

struct Near {
  double width = 0.0;
  gp_Pnt place{};
};
using NearPairs = std::map<RowPair, Near>;

// A face that bounds one solid, with places at which another one may be near.
struct OuterFace {
  TopoDS_Face face{};
  Bnd_Box box{};
  std::vector<gp_Pnt> places{};
};

void add_places_inside(const TopoDS_Face& face, std::vector<gp_Pnt>& places)
{
  constexpr int kSteps = 8;  // In each direction.
  double u0 = 0.0;
  double u1 = 0.0;
  double v0 = 0.0;
  double v1 = 0.0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  const BRepAdaptor_Surface surface(face);
  BRepTopAdaptor_FClass2d inside(face, Precision::PConfusion());
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double u = u0 + (i + 0.5) / kSteps * (u1 - u0);
      const double v = v0 + (j + 0.5) / kSteps * (v1 - v0);
      if (inside.Perform({u, v}) == TopAbs_IN) places.push_back(surface.Value(u, v));
    }
  }
}

void add_places_on_edges(const TopoDS_Face& face, std::vector<gp_Pnt>& places)
{
  constexpr int kSteps = 8;
  for (const TopoDS_Shape& part : parts_of(face, TopAbs_EDGE)) {
    const TopoDS_Edge& edge = TopoDS::Edge(part);
    if (BRep_Tool::Degenerated(edge)) continue;
    const BRepAdaptor_Curve curve(edge);
    const double length = curve.LastParameter() - curve.FirstParameter();
    for (int i = 0; i <= kSteps; ++i) {
      places.push_back(curve.Value(curve.FirstParameter() + i * length / kSteps));
    }
  }
}

class NearSearch {
 public:
  NearSearch(const Shapes& solids, const FusedSolids& fused, double gap) : gap_(gap)
  {
    TopTools_IndexedDataMapOfShapeListOfShape solids_of_face;
    TopExp::MapShapesAndUniqueAncestors(fused.shape, TopAbs_FACE, TopAbs_SOLID, solids_of_face);
    for (const TopoDS_Shape& solid : solids) {
      std::vector<OuterFace>& faces = faces_of_.emplace_back();
      Bnd_Box& box = box_of_.emplace_back();
      for (const TopoDS_Shape& part : fused.solids_of(solid)) {
        for (const TopoDS_Shape& face : parts_of(part, TopAbs_FACE)) {
          if (solids_of_face.FindFromKey(face).Extent() > 1) continue;
          faces.push_back({.face = TopoDS::Face(face)});
          BRepBndLib::Add(face, faces.back().box, Standard_False);
          faces.back().box.Enlarge(gap);
          box.Add(faces.back().box);
        }
      }
    }
  }

  NearPairs run()
  {
    for (std::size_t i = 0; i < faces_of_.size(); ++i) {
      for (std::size_t j = i + 1; j < faces_of_.size(); ++j) {
        if (!box_of_[i].IsOut(box_of_[j])) compare(i, j);
      }
    }
    return std::move(found_);
  }

 private:
  void compare(std::size_t i, std::size_t j)
  {
    for (OuterFace& a : faces_of_[i]) {
      if (a.box.IsOut(box_of_[j])) continue;
      for (OuterFace& b : faces_of_[j]) {
        if (a.box.IsOut(b.box)) continue;
        look_from(a, b, {i, j});
        look_from(b, a, {i, j});
      }
    }
  }

  void look_from(OuterFace& from, const OuterFace& at, const RowPair& rows)
  {
    if (from.places.empty()) {
      add_places_inside(from.face, from.places);
      add_places_on_edges(from.face, from.places);
    }
    for (const gp_Pnt& place : from.places) {
      if (at.box.IsOut(place)) continue;
      BRepExtrema_DistShapeShape distance(BRepBuilderAPI_MakeVertex(place).Vertex(), at.face);
      if (!distance.IsDone() || distance.Value() > gap_) continue;
      if (distance.Value() <= 2.0 * Precision::Confusion()) continue;  // It is at a common edge.
      Near& near = found_[rows];
      if (distance.Value() > near.width) near = {distance.Value(), place};
    }
  }

  double gap_;
  std::vector<std::vector<OuterFace>> faces_of_{};  // By solid.
  std::vector<Bnd_Box> box_of_{};
  NearPairs found_{};
};

// Without strips.
std::map<RowPair, double> common_areas(const Shapes& solids, const FusedSolids& fused, double gap)
{
  PartOwners owners;
  std::map<RowPair, double> areas;
  for (std::size_t row = 0; row < solids.size(); ++row) {
    for (const TopoDS_Shape& part : fused.solids_of(solids[row])) {
      for (const TopoDS_Shape& face : parts_of(part, TopAbs_FACE)) {
        const std::size_t first = owners.first_with(face, row);
        if (first != row && !is_strip(face, gap)) areas[{first, row}] += area_of(face);
      }
    }
  }
  return areas;
}

}  // namespace

std::vector<model::ClosedGap> close_gaps(const Shapes& solids, double gap, const ShapeNames& names,
                                         FusedSolids& fused)
{
  if (is_left_out(Repair::closed_gaps)) return {};
  const NearPairs near = NearSearch(solids, fused, gap).run();
  if (near.empty()) return {};
  auto closed = fuse_at_faces(solids, {.thinnest = gap, .closes_gaps = true});
  if (!closed || count_of(closed->shape, TopAbs_SOLID) != count_of(fused.shape, TopAbs_SOLID)) {
    return {};
  }
  std::map<RowPair, double> before = common_areas(solids, fused, gap);
  std::map<RowPair, double> after = common_areas(solids, *closed, gap);
  std::vector<model::ClosedGap> gaps;
  for (const auto& [rows, found] : near) {
    constexpr double kMore = 1e-6;  // What is less is rounding.
    if (after[rows] <= (1.0 + kMore) * before[rows]) continue;
    gaps.push_back({.solids = pair_of(solids, rows[0], rows[1], names),
                    .width = found.width,
                    .place = {found.place.X(), found.place.Y(), found.place.Z()}});
  }
  if (gaps.empty()) return {};
  note_repair(Repair::closed_gaps, static_cast<GlobalIndex>(gaps.size()));
  fused = std::move(*closed);
  return gaps;
}

}  // namespace tessera::cad

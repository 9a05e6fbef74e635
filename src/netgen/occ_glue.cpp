// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_glue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepBndLib.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <fmt/format.h>

#include "netgen/occ_shape.hpp"

namespace tessera::netgen {
namespace {

// Gaps and overlaps that count as touching, in fractions of the box diagonal: what OpenCASCADE
// takes by itself; wider ones only where solids would be cut into films.
constexpr std::array<double, 4> kGlueGaps{0.0, 1e-7, 1e-6, 1e-5};

Bnd_Box box_of(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  return box;
}

bool any_boxes_touch(const std::vector<TopoDS_Shape>& solids)
{
  std::vector<Bnd_Box> boxes;
  for (const TopoDS_Shape& solid : solids) {
    const Bnd_Box box = box_of(solid);
    for (const Bnd_Box& other : boxes) {
      if (!box.IsOut(other)) return true;
    }
    boxes.push_back(box);
  }
  return false;
}

TopoDS_Compound compound_of(const std::vector<TopoDS_Shape>& solids)
{
  TopoDS_Compound compound;
  BRep_Builder().MakeCompound(compound);
  for (const TopoDS_Shape& solid : solids) BRep_Builder().Add(compound, solid);
  return compound;
}

int count_solids(const TopoDS_Shape& shape)
{
  return static_cast<int>(parts_of(shape, TopAbs_SOLID).size());
}

int count_shared_faces(const TopoDS_Shape& shape)
{
  TopTools_IndexedDataMapOfShapeListOfShape solids_of_face;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_FACE, TopAbs_SOLID, solids_of_face);
  int num_shared = 0;
  for (const TopTools_ListOfShape& solids : solids_of_face) num_shared += solids.Extent() > 1;
  return num_shared;
}

// A solid that is no more than the rounding between two faces that were meant to be one.
bool is_film(const TopoDS_Shape& solid, double diagonal)
{
  constexpr double kThinnest = 1e-6;  // Of the diagonal.
  return 2.0 * std::abs(volume_of(solid)) < kThinnest * diagonal * area_of(solid);
}

// Whether solids were cut where they overlap by next to nothing.
bool left_films(const TopoDS_Shape& fused, int num_given, double diagonal)
{
  const std::vector<TopoDS_Shape> solids = parts_of(fused, TopAbs_SOLID);
  return static_cast<int>(solids.size()) > num_given
         && std::ranges::any_of(
             solids, [&](const TopoDS_Shape& solid) { return is_film(solid, diagonal); });
}

using Fuse = BRepAlgoAPI_BuilderAlgo;

// What lies closer than `gap` counts as touching.
std::unique_ptr<Fuse> fuse_solids(const std::vector<TopoDS_Shape>& solids, double gap)
{
  TopTools_ListOfShape arguments;
  for (const TopoDS_Shape& solid : solids) arguments.Append(solid);
  auto fuse = std::make_unique<Fuse>();
  fuse->SetArguments(arguments);
  fuse->SetNonDestructive(Standard_True);
  fuse->SetRunParallel(Standard_False);
  fuse->SetFuzzyValue(gap);
  fuse->Build();
  return fuse;
}

}  // namespace

void follow_names(const TopoDS_Shape& shape, ShapeNames& names,
                  const std::function<TopTools_ListOfShape(const TopoDS_Shape&)>& images_of)
{
  for (const TopAbs_ShapeEnum kind : {TopAbs_SOLID, TopAbs_FACE, TopAbs_EDGE}) {
    for (const TopoDS_Shape& part : parts_of(shape, kind)) {
      if (!names.IsBound(part)) continue;
      const ShapeLabel label = names.Find(part);
      for (const TopoDS_Shape& image : images_of(part)) {
        if (image.IsNull() || names.IsBound(image)) continue;
        names.Bind(image, label);
      }
    }
  }
}

TopoDS_Shape glued(const std::vector<TopoDS_Shape>& solids, CadFile& cad)
{
  const TopoDS_Compound apart = compound_of(solids);
  if (!any_boxes_touch(solids)) return apart;
  const int num_given = count_solids(apart);
  const double diagonal = box_diagonal_of(apart);
  std::unique_ptr<Fuse> fuse;
  for (const double gap : kGlueGaps) {
    fuse = fuse_solids(solids, gap * diagonal);
    if (fuse->HasErrors() || !left_films(fuse->Shape(), num_given, diagonal)) break;
  }
  if (fuse->HasErrors() || count_solids(fuse->Shape()) < num_given) {
    cad.repairs.emplace_back("solids that may touch could not be glued");
    return apart;
  }
  const int num_solids = count_solids(fuse->Shape());
  const int num_shared = count_shared_faces(fuse->Shape());
  if (num_solids == num_given && num_shared == count_shared_faces(apart)) return apart;
  follow_names(apart, cad.names, [&](const TopoDS_Shape& part) { return fuse->Modified(part); });
  cad.repairs.emplace_back(fmt::format("touching solids were glued: {} shared faces", num_shared));
  if (num_solids != num_given) {
    cad.repairs.emplace_back(
        fmt::format("overlapping solids were cut: {} became {}", num_given, num_solids));
  }
  return fuse->Shape();
}

}  // namespace tessera::netgen

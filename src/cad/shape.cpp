// SPDX-License-Identifier: BSD-3-Clause
#include "cad/shape.hpp"

#include <cmath>

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

namespace tessera::cad {

std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind)
{
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return {map.cbegin(), map.cend()};
}

int count_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind)
{
  return static_cast<int>(parts_of(shape, kind).size());
}

double box_diagonal_of(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  return std::sqrt(box.SquareExtent());
}

double volume_of(const TopoDS_Shape& shape)
{
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

RoughFigures rough_figures_of(const TopoDS_Shape& shape, double diagonal)
{
  constexpr double kDeflection = 0.005;  // Of the diagonal.
  constexpr double kAngle_rad = 0.3;     // Of a cylinder 1.5 % is missing then.
  BRepMesh_IncrementalMesh(shape, kDeflection * diagonal, Standard_False, kAngle_rad);
  GProp_GProps surface;
  GProp_GProps solids;
  BRepGProp::SurfaceProperties(shape, surface, Standard_False, Standard_True);
  BRepGProp::VolumeProperties(shape, solids, Standard_False, Standard_False, Standard_True);
  return {solids.Mass(), surface.Mass(), kDeflection * diagonal};
}

bool have_volume_of(const std::vector<TopoDS_Shape>& pieces, const TopoDS_Shape& solid)
{
  constexpr double kTolerance = 1e-4;
  const auto is_same = [&](const auto& volume) {
    double sum = 0.0;
    for (const TopoDS_Shape& piece : pieces) sum += volume(piece);
    const double whole = volume(solid);
    return std::abs(sum - whole) <= kTolerance * std::abs(whole);
  };
  // Adaptive integrals take long. Others were off by 2e-6 over trimmed faces, and by 8e-3 over
  // small parts of free-form ones.
  return is_same(volume_of) || is_same([](const TopoDS_Shape& shape) {
           GProp_GProps properties;
           BRepGProp::VolumeProperties(shape, properties, 0.1 * kTolerance);
           return properties.Mass();
         });
}

double length_of(const TopoDS_Shape& edge)
{
  GProp_GProps properties;
  BRepGProp::LinearProperties(edge, properties);
  return properties.Mass();
}

double area_of(const TopoDS_Shape& shape)
{
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(shape, properties);
  return properties.Mass();
}

bool is_closed(const TopoDS_Shape& solid)
{
  bool bounds = false;
  for (TopExp_Explorer shells(solid, TopAbs_SHELL); shells.More(); shells.Next()) {
    const TopExp_Explorer faces(shells.Current(), TopAbs_FACE);
    if (faces.More() && faces.Current().Orientation() == TopAbs_INTERNAL) continue;
    if (!BRep_Tool::IsClosed(shells.Current())) return false;
    bounds = true;
  }
  return bounds;
}

}  // namespace tessera::cad

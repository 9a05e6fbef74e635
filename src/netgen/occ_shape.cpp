// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_shape.hpp"

#include <cmath>

#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

namespace tessera::netgen {

std::vector<TopoDS_Shape> parts_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind)
{
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return {map.cbegin(), map.cend()};
}

double box_diagonal_of(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, Standard_False);
  return std::sqrt(box.SquareExtent());
}

}  // namespace tessera::netgen

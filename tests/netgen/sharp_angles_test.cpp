// SPDX-License-Identifier: BSD-3-Clause
#include "sharp_angles.hpp"

#include <array>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <Poly_Array1OfTriangle.hxx>
#include <Poly_Triangulation.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>
#include <gtest/gtest.h>

namespace {

constexpr double kHeight = 1.0;

TopTools_ListOfShape box_and_cylinder(double distance_of_axis)
{
  TopTools_ListOfShape solids;
  solids.Append(BRepPrimAPI_MakeBox(10.0, 10.0, kHeight).Shape());
  const gp_Ax2 axis(gp_Pnt(distance_of_axis, 5.0, kHeight), gp_Dir(0.0, 0.0, 1.0));
  solids.Append(BRepPrimAPI_MakeCylinder(axis, 2.0, 1.0).Shape());
  return solids;
}

// A prism of three corners, the first with the given height over two sides of length 1.
Handle(Poly_Triangulation) prism(double tip)
{
  const std::array<gp_Pnt, 3> base{gp_Pnt(0.0, 0.0, 0.0), gp_Pnt(1.0, 0.0, 0.0),
                                   gp_Pnt(1.0, tip, 0.0)};
  TColgp_Array1OfPnt points(1, 6);
  for (int i = 0; i < 3; ++i) {
    points(i + 1) = base.at(static_cast<std::size_t>(i));
    points(i + 4) = points(i + 1).Translated(gp_Vec(0.0, 0.0, kHeight));
  }
  const std::vector<std::array<int, 3>> corners{{1, 3, 2}, {4, 5, 6}, {1, 2, 5}, {1, 5, 4},
                                                {2, 3, 6}, {2, 6, 5}, {3, 1, 4}, {3, 4, 6}};
  Poly_Array1OfTriangle triangles(1, static_cast<int>(corners.size()));
  for (std::size_t t = 0; t < corners.size(); ++t) {
    triangles(static_cast<int>(t) + 1) = {corners[t][0], corners[t][1], corners[t][2]};
  }
  return new Poly_Triangulation(points, triangles);
}

// The circle has no corner, the box right ones; between them is a cusp of the face that is left.
TEST(SharpAngles, SeeTheCuspWhereACylinderStandsAtTheEdgeOfABox)
{
  const TopTools_ListOfShape touching = box_and_cylinder(2.0);
  for (const TopoDS_Shape& solid : touching) EXPECT_GT(sharp_angles(solid).of_edges, 80.0);
  EXPECT_LT(sharp_angles_of_glued(touching).of_edges, 1.0);
}

TEST(SharpAngles, AreRightWhereACylinderStandsInTheMiddleOfABox)
{
  const SharpAngles angles = sharp_angles_of_glued(box_and_cylinder(5.0));
  EXPECT_GT(angles.of_edges, 80.0);
  EXPECT_GT(angles.of_faces, 80.0);
}

TEST(SharpAngles, SeeCornersOfTriangulatedFaces)
{
  const SharpAngles angles = sharp_angles(*prism(0.05));
  EXPECT_NEAR(angles.of_edges, 2.86, 0.01);
  EXPECT_NEAR(angles.of_faces, 2.86, 0.01);
  EXPECT_NEAR(sharp_angles(*prism(1.0)).of_edges, 45.0, 0.01);
}

}  // namespace

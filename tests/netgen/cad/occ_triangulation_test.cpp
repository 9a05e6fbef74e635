// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Plane.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Lin.hxx>
#include <gp_Pln.hxx>
#include <gp_Trsf.hxx>
#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

#include "cad/shape.hpp"
#include "cad/triangles/triangulation.hpp"
#include "cad/triangles/whole_face.hpp"
#include "geometry/polygon_triangles.hpp"
#include "netgen/cad/occ_fixture.hpp"

namespace tessera::cad {
namespace {

using Point = geometry::PlaneMesh::Point;
using Edge = std::pair<int, int>;

double area_of(const geometry::PlaneMesh& mesh)
{
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point& p = mesh.points[at(a)];
    const Point& q = mesh.points[at(b)];
    const Point& r = mesh.points[at(c)];
    const double twice = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  return area;
}

// The unit square, its corners and middles of sides, with a triangular hole.
const std::vector<Point> kSquareWithHole{{0, 0},     {0.5, 0},   {1, 0},    {1, 0.5},
                                         {1, 1},     {0.5, 1},   {0, 1},    {0, 0.5},
                                         {0.4, 0.4}, {0.4, 0.6}, {0.6, 0.5}};
const std::vector<geometry::PlaneMesh::Loop> kItsLoops{{0, 1, 2, 3, 4, 5, 6, 7}, {8, 9, 10}};

TEST(PolygonTriangles, CoverAPolygonWithAHoleOnce)
{
  const geometry::PlaneMesh mesh = geometry::triangulate_polygon(kSquareWithHole, kItsLoops);
  EXPECT_EQ(mesh.points, kSquareWithHole);
  EXPECT_NEAR(area_of(mesh), 1.0 - 0.02, 1e-12);
}

TEST(PolygonTriangles, RefinementLeavesTheSidesWhole)
{
  geometry::PlaneMesh mesh = geometry::triangulate_polygon(kSquareWithHole, kItsLoops);
  const auto is_long = [](const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]) > 0.2;
  };
  geometry::refine_inside(mesh, is_long, 1000);
  EXPECT_NEAR(area_of(mesh), 0.98, 1e-12);
  EXPECT_GT(mesh.points.size(), kSquareWithHole.size());
  std::map<Edge, int> count;
  for (const auto& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) ++count[std::minmax(t[c], t[(c + 1) % 3])];
  }
  const auto num_sides =
      std::ranges::count_if(count, [](const auto& edge) { return edge.second == 1; });
  EXPECT_EQ(num_sides, 11);
}

TEST(PolygonTriangles, ThereAreNoneOfAPolygonThatCrossesItself)
{
  EXPECT_TRUE(geometry::triangulate_polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {{0, 1, 2, 3}})
                  .triangles.empty());
}

// Edges that triangles have on one side only, modulo two.
std::set<Edge> border_of(const std::vector<geometry::PlaneMesh::Triangle>& triangles)
{
  std::set<Edge> border;
  for (const auto& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Edge edge = std::minmax(t[c], t[(c + 1) % 3]);
      if (!border.insert(edge).second) border.erase(edge);
    }
  }
  return border;
}

std::set<Edge> sides_of(const std::vector<geometry::PlaneMesh::Loop>& loops)
{
  std::set<Edge> sides;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sides.insert(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return sides;
}

// A side ends beyond another one, as where the ends of two curves are off each other.
TEST(PolygonTriangles, FillAPolygonThatCrossesItselfByALittle)
{
  const std::vector<Point> points{{0, 0},   {1, 0},          {1, 0.999}, {0.99, 1.01}, {0.98, 1.0},
                                  {0.5, 1}, {0.9999, 0.995}, {0.4, 0.9}, {0, 1}};
  const std::vector<geometry::PlaneMesh::Loop> loops{{0, 1, 2, 3, 4, 6, 5, 7, 8}};
  const geometry::PlaneMesh mesh = geometry::triangulate_polygon(points, loops);
  EXPECT_EQ(mesh.triangles.size(), points.size() - 2);
  EXPECT_EQ(border_of(mesh.triangles), sides_of(loops));
}

// The hole has a side in common with the square, in two pieces, so that a lens is between them.
TEST(PolygonTriangles, OfLoopsThatTouchLeaveTheHoleFree)
{
  const std::vector<Point> points{{0, 0}, {0.4, 0}, {0.6, 0},     {1, 0},
                                  {1, 1}, {0, 1},   {0.5, 1e-12}, {0.5, 0.5}};
  const std::vector<geometry::PlaneMesh::Loop> loops{{0, 1, 2, 3, 4, 5}, {1, 7, 2, 6}};
  for (const double height : {1e-12, 0.0, -1e-12}) {
    std::vector<Point> moved = points;
    moved[6][1] = height;
    const geometry::PlaneMesh mesh = geometry::triangulate_polygon(moved, loops, 1e-7);
    EXPECT_EQ(border_of(mesh.triangles), sides_of(loops)) << height;
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Point& p = points[at(a)];
      const Point& q = points[at(b)];
      const Point& r = points[at(c)];
      area += 0.5 * std::abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    }
    EXPECT_NEAR(area, 0.95, 1e-9) << height;
  }
}

double area_of(const Poly_Triangulation& mesh)
{
  double area = 0.0;
  for (int t = 1; t <= mesh.NbTriangles(); ++t) {
    int a = 0;
    int b = 0;
    int c = 0;
    mesh.Triangle(t).Get(a, b, c);
    const gp_Vec side(mesh.Node(a), mesh.Node(b));
    area += 0.5 * side.Crossed(gp_Vec(mesh.Node(a), mesh.Node(c))).Magnitude();
  }
  return area;
}

// Edges with one triangle.
std::set<Edge> border_of(const Poly_Triangulation& mesh)
{
  std::map<Edge, int> count;
  for (int t = 1; t <= mesh.NbTriangles(); ++t) {
    std::array<int, 3> n{};
    mesh.Triangle(t).Get(n[0], n[1], n[2]);
    for (std::size_t c = 0; c < 3; ++c) ++count[std::minmax(n[c], n[(c + 1) % 3])];
  }
  std::set<Edge> border;
  for (const auto& [edge, triangles] : count) {
    if (triangles == 1) border.insert(edge);
  }
  return border;
}

std::set<Edge> sides_of(const TopoDS_Face& face, const Handle(Poly_Triangulation) & mesh)
{
  std::set<Edge> sides;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const auto polygon =
        BRep_Tool::PolygonOnTriangulation(TopoDS::Edge(edges.Current()), mesh, face.Location());
    if (polygon.IsNull()) continue;
    for (int i = 1; i < polygon->NbNodes(); ++i) {
      sides.insert(std::minmax(polygon->Node(i), polygon->Node(i + 1)));
    }
  }
  return sides;
}

struct Solid {
  const char* name;
  TopoDS_Shape shape;
};

void PrintTo(const Solid& solid, std::ostream* out) { *out << solid.name; }

class OwnTriangles : public ::testing::TestWithParam<Solid> {};

// Each face in turn is one that OpenCASCADE cannot do. Apexes, poles and seams are among them.
TEST_P(OwnTriangles, OfAFaceCoverItAndShareItsNeighboursPoints)
{
  gp_Trsf away;
  away.SetTranslation(gp_Vec(1.0, 2.0, 3.0));
  const TopoDS_Shape shape = GetParam().shape.Moved(TopLoc_Location(away));
  const std::vector<TopoDS_Shape> faces = parts_of(shape, TopAbs_FACE);
  ASSERT_FALSE(faces.empty());
  for (const TopoDS_Shape& part : faces) {
    BRepTools::Clean(shape);
    BRepMesh_IncrementalMesh(shape, 0.05, Standard_False, 0.25);
    const TopoDS_Shape upright = part.Oriented(TopAbs_FORWARD);
    const TopoDS_Face& face = TopoDS::Face(upright);
    TopLoc_Location place;
    const int sides_before =
        static_cast<int>(sides_of(face, BRep_Tool::Triangulation(face, place)).size());
    BRepTools::Clean(face);
    ASSERT_TRUE(triangulate_from_boundary(face, {0.05, 0.25}));
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    EXPECT_NEAR(area_of(*mesh), properties.Mass(), 0.03 * properties.Mass());
    EXPECT_EQ(border_of(*mesh), sides_of(face, mesh));
    EXPECT_GE(2 * static_cast<int>(border_of(*mesh).size()), sides_before);
    EXPECT_TRUE(mesh->HasUVNodes());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Solids, OwnTriangles,
    ::testing::Values(Solid{"box", BRepPrimAPI_MakeBox(1, 2, 3).Shape()},
                      Solid{"cylinder", BRepPrimAPI_MakeCylinder(5, 20).Shape()},
                      Solid{"cone", BRepPrimAPI_MakeCone(8, 0, 12).Shape()},
                      Solid{"sector", BRepPrimAPI_MakeCone(8, 0, 12, 1.0).Shape()},
                      Solid{"sphere", BRepPrimAPI_MakeSphere(5).Shape()},
                      Solid{"torus", BRepPrimAPI_MakeTorus(10, 3).Shape()}));

// As OpenCASCADE leaves it where the boundary of a face touches itself.
TEST(WholeTriangles, AFaceWithoutOneOfItsTrianglesIsNoticedAndDoneAnew)
{
  const TopoDS_Shape shape = BRepPrimAPI_MakeCylinder(5, 20).Shape();
  BRepMesh_IncrementalMesh(shape, 0.05, Standard_False, 0.25);
  BRep_Builder builder;
  for (const TopoDS_Shape& part : parts_of(shape, TopAbs_FACE)) {
    const TopoDS_Face& face = TopoDS::Face(part);
    EXPECT_TRUE(has_whole_triangles(face));
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    const Handle(Poly_Triangulation) less = mesh->Copy();
    less->ResizeTriangles(mesh->NbTriangles() - 1, Standard_True);
    for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
      const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, mesh, place);
      if (!BRep_Tool::IsClosed(edge, face)) {
        builder.UpdateEdge(edge, polygon, less, place);
      } else if (edge.Orientation() == TopAbs_FORWARD) {
        const TopoDS_Edge other = TopoDS::Edge(edge.Reversed());
        builder.UpdateEdge(edge, polygon, BRep_Tool::PolygonOnTriangulation(other, mesh, place),
                           less, place);
      }
    }
    builder.UpdateFace(face, less);
    EXPECT_FALSE(has_whole_triangles(face));
    EXPECT_TRUE(triangulate_from_boundary(face, {0.05, 0.25}));
    EXPECT_TRUE(has_whole_triangles(face));
  }
}

TEST(WholeTriangles, ThoseOfRoundSolidsFollowTheirSurfacesUpToPolesAndApices)
{
  for (const TopoDS_Shape& shape :
       {BRepPrimAPI_MakeCylinder(5, 20).Shape(), BRepPrimAPI_MakeCone(8, 0, 12).Shape(),
        BRepPrimAPI_MakeSphere(5).Shape(), BRepPrimAPI_MakeTorus(10, 3).Shape()}) {
    BRepMesh_IncrementalMesh(shape, 0.05, Standard_False, 0.25);
    for (const TopoDS_Shape& face : parts_of(shape, TopAbs_FACE)) {
      EXPECT_TRUE(follows_surface(TopoDS::Face(face), 0.05));
    }
  }
}

// As OpenCASCADE joins points of a narrow helical strip.
TEST(WholeTriangles, EdgesThatLeadAcrossABendAreNoticed)
{
  const TopoDS_Shape shape = BRepPrimAPI_MakeCylinder(5, 20).Shape();
  BRepMesh_IncrementalMesh(shape, 3.0, Standard_False, 1.5);
  const std::vector<TopoDS_Shape> faces = parts_of(shape, TopAbs_FACE);
  EXPECT_FALSE(follows_surface(TopoDS::Face(faces[0]), 0.05));  // Its side.
  EXPECT_TRUE(follows_surface(TopoDS::Face(faces[0]), 3.0));
  EXPECT_TRUE(follows_surface(TopoDS::Face(faces[1]), 0.05));
}

// A wire of two lines between the same two points, as CAD programs leave it of a face of no width.
TEST(OccTriangulation, AFaceOfNoWidthHasTriangles)
{
  const gp_Pnt a(0, 0, 0);
  const gp_Pnt b(1, 0, 0);
  BRep_Builder builder;
  TopoDS_Vertex first;
  TopoDS_Vertex last;
  builder.MakeVertex(first, a, 1e-7);
  builder.MakeVertex(last, b, 1e-7);
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (int side = 0; side < 2; ++side) {
    const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(gp_Lin(a, gp_Dir(1, 0, 0)), first, last);
    builder.Add(wire, edge.Oriented(side == 0 ? TopAbs_FORWARD : TopAbs_REVERSED));
  }
  TopoDS_Face face;
  builder.MakeFace(face, new Geom_Plane(gp_Pln(a, gp_Dir(0, 0, 1))), 1e-7);
  builder.Add(face, wire);
  EXPECT_TRUE(triangulate_from_boundary(face, {0.05, 0.25}));
  EXPECT_TRUE(has_whole_triangles(face));
}

TEST(OccTriangulation, OneFaceIsMadeFinerAndItsNeighboursFollowAlongTheirEdges)
{
  const TopoDS_Shape shape = BRepPrimAPI_MakeCylinder(5, 20).Shape();
  const std::vector<TopoDS_Shape> faces = parts_of(shape, TopAbs_FACE);
  const auto numbers_of_triangles = [&] {
    std::vector<int> numbers;
    for (const TopoDS_Shape& face : faces) {
      TopLoc_Location place;
      numbers.push_back(BRep_Tool::Triangulation(TopoDS::Face(face), place)->NbTriangles());
    }
    return numbers;
  };
  IMeshTools_Parameters parameters;
  parameters.Deflection = 0.05;
  parameters.Angle = 0.25;
  EXPECT_TRUE(triangulate_faces(shape, parameters).empty());
  const std::vector<int> all_alike = numbers_of_triangles();
  for (std::size_t finer = 0; finer < faces.size(); ++finer) {
    std::vector<double> face_part(faces.size(), 1.0);
    face_part[finer] = 0.1;
    EXPECT_TRUE(triangulate_faces(shape, parameters, face_part).empty());
    EXPECT_GT(numbers_of_triangles()[finer], 2 * all_alike[finer]);
    for (const TopoDS_Shape& face : faces) {
      EXPECT_TRUE(has_whole_triangles(TopoDS::Face(face)));
    }
  }
}

// The unit cube with an edge inside its top face that sticks out of it by next to nothing.
TopoDS_Shape cube_with_stray_edge()
{
  const TopoDS_Shape cube = BRepPrimAPI_MakeBox(1, 1, 1).Shape();
  BRep_Builder builder;
  for (const TopoDS_Shape& face : parts_of(cube, TopAbs_FACE)) {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    if (properties.CentreOfMass().Z() < 0.9) continue;
    const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(gp_Pnt(0.5, -1e-5, 1), gp_Pnt(0.5, 0.5, 1));
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    builder.Add(wire, edge.Oriented(TopAbs_INTERNAL));
    face.TShape()->Free(Standard_True);
    TopoDS_Shape top = face;
    builder.Add(top, wire);
  }
  return cube;
}

TEST(OccTriangulation, OneFaceThatOpenCascadeCannotDoRefusesNoModel)
{
  const TopoDS_Shape cube = cube_with_stray_edge();
  BRepMesh_IncrementalMesh(cube, 0.01);
  const auto is_bare = [](const TopoDS_Shape& face) {
    TopLoc_Location place;
    return BRep_Tool::Triangulation(TopoDS::Face(face), place).IsNull();
  };
  ASSERT_EQ(std::ranges::count_if(parts_of(cube, TopAbs_FACE), is_bare), 1);

  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "stray_edge.brep";
  BRepTools::Write(cube, file.c_str());
  const auto model = netgen::load_model(netgen::import_model(file, {}));
  EXPECT_EQ(netgen::describe_model(*model).triangle_vertices.size() % 3, 0U);
  const std::set<LocalIndex> drawn = [&] {
    const auto described = netgen::describe_model(*model);
    return std::set<LocalIndex>(described.triangle_face.begin(), described.triangle_face.end());
  }();
  EXPECT_EQ(drawn.size(), 6U);
  const mesh::CoarseMesh mesh =
      testing::coarse_mesh_of(*model, 0.3, surface::SurfaceMesher::remesh);
  double volume = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto v = mesh.tet(t);
    volume += tet_volume(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]),
                         mesh.position(v[3]));
  }
  EXPECT_NEAR(volume, 1.0, 1e-9);
}

// NETGEN reads parameters of triangles for its sizes, unchecked.
TEST(OccTriangulation, SamplesAreOnTheFaceAndHaveParameters)
{
  for (const TopoDS_Shape& face : parts_of(BRepPrimAPI_MakeCone(8, 0, 12).Shape(), TopAbs_FACE)) {
    sample_face(face);
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(TopoDS::Face(face), place);
    ASSERT_FALSE(mesh.IsNull());
    ASSERT_TRUE(mesh->HasUVNodes());
    EXPECT_GT(mesh->NbTriangles(), 0);
    for (int n = 1; n <= mesh->NbNodes(); ++n) {
      const gp_Pnt2d uv = mesh->UVNode(n);
      const auto surface = BRep_Tool::Surface(TopoDS::Face(face));
      EXPECT_LT(surface->Value(uv.X(), uv.Y()).Distance(mesh->Node(n)), 1e-12);
    }
  }
}

}  // namespace
}  // namespace tessera::cad

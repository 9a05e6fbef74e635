// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GCE2d_MakeSegment.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Ax3.hxx>
#include <gtest/gtest.h>

#include "cad/project/curve.hpp"
#include "cad/project/surface.hpp"
#include "cad/project/trim.hpp"
#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

using testing::coarse_mesh_of;
using testing::load_own;

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 1e-12;  // Of the box.

// Distances to our own models by formula.
double off_sphere(const Vec3& p) { return std::abs(norm(p) - 10.0); }
double off_cylinder(const Vec3& p) { return std::abs(std::hypot(p[0], p[1]) - 5.0); }
double off_torus(const Vec3& p)
{
  return std::abs(std::hypot(std::hypot(p[0], p[1]) - 10.0, p[2]) - 3.0);
}

// The number of the surface of the patch of this name.
LocalIndex surface_named(const mesh::CoarseMesh& mesh, const std::string& name)
{
  for (std::size_t p = 0; p < mesh.patch_names.size(); ++p) {
    if (mesh.patch_names[p] == name) return mesh.patch_surface[p];
  }
  ADD_FAILURE() << "no patch " << name;
  return 0;
}

// The same face on another surface that has the same parameters.
TopoDS_Face on_surface(const TopoDS_Face& face, const Handle(Geom_Surface) & surface)
{
  const BRep_Builder builder;
  const TopLoc_Location here;
  TopoDS_Face moved;
  builder.MakeFace(moved, surface, 1e-6);
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    for (TopExp_Explorer edges(wires.Current(), TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(edges.Current().Oriented(TopAbs_FORWARD));
      const TopoDS_Edge back = TopoDS::Edge(edge.Reversed());
      double first = 0.0;
      double last = 0.0;
      const auto curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
      if (BRep_Tool::IsClosed(edge, face)) {
        const auto other = BRep_Tool::CurveOnSurface(back, face, first, last);
        builder.UpdateEdge(edge, curve, other, surface, here, 1e-6);
      } else {
        builder.UpdateEdge(edge, curve, surface, here, 1e-6);
      }
    }
    builder.Add(moved, wires.Current());
  }
  return moved;
}

TEST(OccProjection, PointsOfTheSphereKeepItsFormula)
{
  const auto model = load_own("sphere.step");
  for (double u = 0.1; u < 2.0 * kPi; u += 0.7) {
    for (double v = -1.5; v < 1.5; v += 0.3) {
      const Vec3 direction{std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
      const auto found = model->project_to_surface(0, 8.5 * direction, {u + 0.2, v - 0.1});
      EXPECT_LE(off_sphere(found.xyz), kExact * model->box_diagonal());
      EXPECT_LE(norm(found.xyz - 10.0 * direction), 1e-10 * model->box_diagonal());
    }
  }
}

// There the distance has no slope either. A guess comes to lie there between parameters on the two
// sides of a seam.
TEST(OccProjection, AGuessOnTheFarSideLeadsToTheNearSide)
{
  const auto model = load_own("cylinder.step");
  const auto mesh = coarse_mesh_of(*model, 6.0);
  const LocalIndex side = surface_named(mesh, "side");
  for (const double u : {0.0, 0.3, 2.0, kPi, 5.0}) {
    const Vec3 near{5.0 * std::cos(u), 5.0 * std::sin(u), 8.0};
    const Vec3 point{0.8 * near[0], 0.8 * near[1], 8.0};
    const auto found = model->project_to_surface(side, point, {u + kPi, 8.0});
    EXPECT_LE(norm(found.xyz - near), 1e-9) << u;
  }
  for (std::size_t s = 0; s < mesh.segment_curve.size(); ++s) {
    const Vec3 p = mesh.position(mesh.segment_vertices[2 * s]);
    if (p[2] != mesh.position(mesh.segment_vertices[2 * s + 1])[2]) continue;  // The seam.
    const double t = mesh.segment_t[2 * s];
    const double opposite = t > kPi ? t - kPi : t + kPi;
    const Vec3 point{0.8 * p[0], 0.8 * p[1], p[2]};
    const auto found = model->project_to_curve(mesh.segment_curve[s], point, opposite);
    EXPECT_LE(norm(found.xyz - p), 1e-7) << t;
  }
}

TEST(OccProjection, PolesOfTheSphereAreReachedAndLeft)
{
  const auto model = load_own("sphere.step");
  for (const double sign : {1.0, -1.0}) {
    const Vec3 pole{0.0, 0.0, sign * 10.0};
    for (const double u : {0.0, 1.0, 4.0}) {
      const auto reached = model->project_to_surface(0, pole, {u, sign * 1.2});
      EXPECT_LE(norm(reached.xyz - pole), kExact * model->box_diagonal());
      const Vec3 beside{0.3, -0.4, sign * 9.0};
      const auto left = model->project_to_surface(0, beside, {u, sign * kPi / 2});
      EXPECT_LE(norm(left.xyz - (10.0 / norm(beside)) * beside), 1e-10 * model->box_diagonal());
    }
  }
}

TEST(OccProjection, PointsOfTheTorusKeepItsFormula)
{
  const auto model = load_own("torus.step");
  for (double u = 0.0; u < 2.0 * kPi; u += 0.5) {
    for (double v = 0.0; v < 2.0 * kPi; v += 0.5) {
      const double radius = 10.0 + 2.5 * std::cos(v);
      const Vec3 point{radius * std::cos(u), radius * std::sin(u), 2.5 * std::sin(v)};
      const auto found = model->project_to_surface(0, point, {u + 0.2, v + 0.2});
      EXPECT_LE(off_torus(found.xyz), kExact * model->box_diagonal());
      EXPECT_NEAR(norm(found.xyz - point), 0.5, 1e-9);
      EXPECT_NEAR(found.uv[0], u, 1e-9) << "stays on the branch of the guess";
      EXPECT_NEAR(found.uv[1], v, 1e-9);
    }
  }
}

TEST(OccProjection, GuessesBeyondTheSeamStayOnTheirBranch)
{
  const auto model = load_own("cylinder.step");
  const auto mesh = coarse_mesh_of(*model, 6.0);
  const LocalIndex side = surface_named(mesh, "side");
  for (const double branch : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
    for (const double u : {-0.2, 0.0, 0.2, 2.0 * kPi - 0.2}) {
      const Vec3 point{4.6 * std::cos(u), 4.6 * std::sin(u), 7.0};
      const auto found = model->project_to_surface(side, point, {branch + u + 0.1, 7.5});
      EXPECT_LE(off_cylinder(found.xyz), kExact * model->box_diagonal());
      EXPECT_NEAR(found.uv[0], branch + u, 1e-9);
      EXPECT_NEAR(found.xyz[2], 7.0, 1e-9);
    }
  }
}

// As other CAD systems write it: cut out of a torus, all round, and so neither closed nor periodic
// by OpenCASCADE.
TEST(OccProjection, ATrimmedSurfaceHasTheSeamOfItsFace)
{
  BRepPrimAPI_MakeTorus torus(10.0, 3.0, 1.0);  // Up to an angle of 1.
  const TopoDS_Face face = torus.Face();
  const Handle(Geom_Surface) bend =
      new Geom_RectangularTrimmedSurface(BRep_Tool::Surface(face), 0.0, 1.0, 0.0, 2.0 * kPi);
  ASSERT_FALSE(bend->IsVClosed() || bend->IsVPeriodic());
  const cad::OccSurface surface(on_surface(face, bend), 26.0, 1);
  const auto at = [&](double u, double v) {
    const gp_Pnt p = bend->Value(u, v);
    return Vec3{p.X(), p.Y(), p.Z()};
  };
  const auto uv = surface.triangle_parameters({at(0.5, 0.0), at(0.6, 0.3), at(0.4, 0.0)},
                                              {{{0.5, 2.0 * kPi}, {0.6, 0.3}, {0.4, 0.0}}});
  EXPECT_NEAR(uv[0][1], 0.0, 1e-9);
  EXPECT_NEAR(uv[1][1], 0.3, 1e-9);
  EXPECT_NEAR(uv[2][1], 0.0, 1e-9);
}

TEST(OccProjection, PointsBeyondTheTrimGoToTheNearestPointOfTheFace)
{
  const auto model = load_own("cylinder.step");
  const auto mesh = coarse_mesh_of(*model, 6.0);
  const auto on_side =
      model->project_to_surface(surface_named(mesh, "side"), {6.0, 0.0, 23.0}, {0.1, 19.0});
  EXPECT_LE(norm(on_side.xyz - Vec3{5.0, 0.0, 20.0}), 1e-7);
  const auto on_top =
      model->project_to_surface(surface_named(mesh, "top"), {0.0, 9.0, 20.5}, {0.0, 0.0});
  EXPECT_LE(norm(on_top.xyz - Vec3{0.0, 5.0, 20.0}), 1e-7);
}

TEST(OccProjection, RimOfTheCylinderIsACircleOnBothItsFaces)
{
  const auto model = load_own("cylinder.step");
  const auto mesh = coarse_mesh_of(*model, 6.0);
  int num_on_rim = 0;
  for (std::size_t s = 0; s < mesh.segment_curve.size(); ++s) {
    const Vec3 p = mesh.position(mesh.segment_vertices[2 * s]);
    const Vec3 q = mesh.position(mesh.segment_vertices[2 * s + 1]);
    if (p[2] != q[2]) continue;  // The seam.
    ++num_on_rim;
    const double guess = 0.5 * (mesh.segment_t[2 * s] + mesh.segment_t[2 * s + 1]);
    const auto found = model->project_to_curve(mesh.segment_curve[s], midpoint(p, q), guess);
    EXPECT_LE(off_cylinder(found.xyz), kExact * model->box_diagonal());
    EXPECT_NEAR(found.xyz[2], p[2], kExact * model->box_diagonal());
  }
  EXPECT_GE(num_on_rim, 12);
}

TEST(OccProjection, CurveParameterStaysBetweenItsEnds)
{
  const auto model = load_own("cylinder.step");
  const auto mesh = coarse_mesh_of(*model, 6.0);
  ASSERT_GT(mesh.num_segments(), 0);
  for (std::size_t s = 0; s < mesh.segment_curve.size(); ++s) {
    const Vec3 p = mesh.position(mesh.segment_vertices[2 * s]);
    const LocalIndex curve = mesh.segment_curve[s];
    const auto low = model->project_to_curve(curve, p, -1e6);
    const auto high = model->project_to_curve(curve, p, 1e6);
    EXPECT_LE(low.t, high.t);
    EXPECT_LE(high.t - low.t, 2.0 * kPi + 20.0);
  }
}

TEST(OccProjection, IsAPureFunction)
{
  const auto model = load_own("bracket.step");
  const auto mesh = coarse_mesh_of(*model, 10.0);
  const auto project_all = [&](const model::Model& with, bool backwards) {
    std::vector<Vec3> found(static_cast<std::size_t>(mesh.num_faces()));
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::size_t f = backwards ? found.size() - 1 - i : i;
      Vec3 centre{};
      for (std::size_t c = 0; c < 3; ++c) {
        centre = centre + (1.0 / 3.0) * mesh.position(mesh.face_vertices[3 * f + c]);
      }
      const auto patch = static_cast<std::size_t>(mesh.face_patch[f]);
      found[f] = with.project_to_surface(mesh.patch_surface[patch], centre,
                                         {mesh.face_uv[6 * f], mesh.face_uv[6 * f + 1]})
                     .xyz;
    }
    return found;
  };
  const std::vector<Vec3> first = project_all(*model, false);
  EXPECT_EQ(project_all(*model, true), first);
  EXPECT_EQ(project_all(*load_own("bracket.step"), true), first);
}

// A strip that winds round a cylinder more than once, as the faces of a thread do.
TopoDS_Face thread_of(double radius, double rounds, double pitch, double width)
{
  const Handle(Geom_Surface) surface = new Geom_CylindricalSurface(gp_Ax3(gp::XOY()), radius);
  const double u = 2.0 * kPi * rounds;
  const double rise = rounds * pitch;
  const std::array<gp_Pnt2d, 4> corners{{{0.0, 0.0}, {u, rise}, {u, rise + width}, {0.0, width}}};
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t c = 0; c < 4; ++c) {
    const Handle(Geom2d_TrimmedCurve) side =
        GCE2d_MakeSegment(corners[c], corners[(c + 1) % 4]).Value();
    wire.Add(BRepBuilderAPI_MakeEdge(side, surface).Edge());
  }
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(surface, wire.Wire()).Face();
  BRepLib::BuildCurves3d(face);
  return face;
}

TEST(OccTrim, AFaceGoesRoundMoreThanOnce)
{
  const TopoDS_Face face = thread_of(5.0, 1.9, 2.0, 1.0);
  const cad::OccTrim trim(face, {2.0 * kPi, 0.0}, 64);
  const cad::OccSurface surface(face, 20.0, 1);
  for (double u = 0.2; u < 1.9 * 2.0 * kPi; u += 0.11) {
    const double low = u / kPi;
    for (const double branch : {-2.0 * kPi, 0.0, 2.0 * kPi}) {
      EXPECT_TRUE(trim.contains({u + branch, low + 0.5})) << u;
      EXPECT_FALSE(trim.contains({u + branch, low - 0.5})) << u;
    }
    const Vec3 middle{5.0 * std::cos(u), 5.0 * std::sin(u), low + 0.3};
    const Vec3 inside{0.99 * middle[0], 0.99 * middle[1], middle[2]};
    EXPECT_LE(norm(surface.project(inside, {u, low + 0.3}).xyz - middle), 1e-9) << u;
  }
}

TEST(OccTolerance, OfAnEndIsThatOfTheVertexWhereThePointIs)
{
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0));
  BRep_Builder().UpdateVertex(TopExp::LastVertex(edge), 0.01);
  const auto tolerance_at = [&](double box_diagonal, const Vec3& point) {
    return cad::OccCurve(edge, box_diagonal).end_tolerance(point);
  };
  EXPECT_DOUBLE_EQ(tolerance_at(100.0, {1.0, 0.005, 0.0}), 0.01);
  EXPECT_LT(tolerance_at(100.0, {1.0, 0.05, 0.0}), 1e-5) << "not at the vertex";
  EXPECT_LT(tolerance_at(100.0, {0.0, 0.0, 0.0}), 1e-5) << "the other vertex is exact";
  EXPECT_DOUBLE_EQ(tolerance_at(1.0, {1.0, 0.0, 0.0}), 1e-3) << "no vertex is that loose";
}

}  // namespace
}  // namespace tessera

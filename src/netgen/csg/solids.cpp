// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/csg/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Ax2.hxx>

#include "tessera/base/error.hpp"

#include "netgen/csg/access.hpp"
#include "netgen/csg/tree.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;
using ::netgen::Solid;

gp_Pnt to_occ(const Vec3& p) { return {p[0], p[1], p[2]}; }

// Numbers of a primitive as NETGEN hands them out.
struct Numbers {
  explicit Numbers(const ::netgen::Primitive& primitive)
  {
    const char* name = "";
    NetgenArray<double> values;
    primitive.GetPrimitiveData(name, values);
    kind = name;
    for (const double value : values) all.push_back(value);
  }

  [[nodiscard]] Vec3 point(std::size_t first) const
  {
    return {all.at(first), all.at(first + 1), all.at(first + 2)};
  }

  std::string kind{};
  std::vector<double> all{};
};

struct ConeShape {
  explicit ConeShape(const Numbers& numbers)
  {
    const Vec3 from = numbers.point(0);
    const Vec3 to = numbers.point(3);
    const double r0 = numbers.all.at(6);
    const double r1 = numbers.all.at(7);
    apex = from + (r0 / (r0 - r1)) * (to - from);
    axis = (1.0 / norm(to - from)) * (r0 > r1 ? from - to : to - from);
    slope = std::abs(r1 - r0) / norm(to - from);
  }

  Vec3 apex{};
  Vec3 axis{};         // Of length 1, from the apex into the cone.
  double slope = 0.0;  // Radius over distance from the apex.
};

constexpr const char* kNoCounterpart =
    "has a body that cannot be handed to OpenCASCADE: planes, spheres, cylinders, cones, tori and "
    "bricks can; export the model as STEP";

bool has_counterpart(const Numbers& numbers)
{
  constexpr std::array<std::string_view, 6> kKinds{"plane", "sphere",   "torus",
                                                   "brick", "cylinder", "cone"};
  return std::ranges::find(kKinds, numbers.kind) != kKinds.end();
}

bool is_cone(const Numbers& numbers)
{
  return numbers.kind == "cone" && numbers.all.at(6) != numbers.all.at(7);
}

class Builder {
 public:
  explicit Builder(const ::netgen::Box<3>& box)
      : centre_(from_netgen(box.Center())), reach_(2.0 * box.Diam())
  {
  }

  // A shape, or all that is outside of it: so nothing is infinite but a solid that has no bound.
  struct Part {
    TopoDS_Shape shape{};
    bool is_outside = false;
  };

  [[nodiscard]] Part build(Solid& solid) const
  {
    if (const ::netgen::Primitive* const primitive = solid.GetPrimitive()) {
      return {build(Numbers(*primitive)), false};
    }
    const Part left = build(*solid.S1());
    switch (operation_of(solid)) {
      case Operation::named:
        return left;
      case Operation::complement:
        return {left.shape, !left.is_outside};
      case Operation::both:
        return common(left, build(*solid.S2()));
      default: {  // The complement of what both complements have in common.
        const Part right = build(*solid.S2());
        const Part neither =
            common({left.shape, !left.is_outside}, {right.shape, !right.is_outside});
        return {neither.shape, !neither.is_outside};
      }
    }
  }

 private:
  template <class Algorithm>
  static TopoDS_Shape combined(const TopoDS_Shape& one, const TopoDS_Shape& other)
  {
    Algorithm algorithm(one, other);
    if (!algorithm.IsDone() || algorithm.HasErrors() || algorithm.Shape().IsNull()) {
      throw GeometryError("OpenCASCADE cannot combine two of its solids");
    }
    return algorithm.Shape();
  }

  static Part common(const Part& left, const Part& right)
  {
    if (left.is_outside && right.is_outside) {
      return {combined<BRepAlgoAPI_Fuse>(left.shape, right.shape), true};
    }
    if (right.is_outside) return {combined<BRepAlgoAPI_Cut>(left.shape, right.shape), false};
    if (left.is_outside) return {combined<BRepAlgoAPI_Cut>(right.shape, left.shape), false};
    return {combined<BRepAlgoAPI_Common>(left.shape, right.shape), false};
  }

  // What is infinite ends outside the box.
  [[nodiscard]] TopoDS_Shape build(const Numbers& numbers) const
  {
    if (numbers.kind == "plane") return half_space(numbers.point(0), numbers.point(3));
    if (numbers.kind == "sphere") {
      return BRepPrimAPI_MakeSphere(to_occ(numbers.point(0)), numbers.all.at(3)).Shape();
    }
    if (numbers.kind == "torus") {
      const gp_Ax2 frame = frame_at(numbers.point(0), numbers.point(3));
      return BRepPrimAPI_MakeTorus(frame, numbers.all.at(6), numbers.all.at(7)).Shape();
    }
    if (numbers.kind == "brick") return brick(numbers);
    if (is_cone(numbers)) return cone(ConeShape(numbers));
    if (numbers.kind == "cylinder" || numbers.kind == "cone") return cylinder(numbers);
    throw GeometryError(kNoCounterpart);
  }

  static gp_Ax2 frame_at(const Vec3& origin, const Vec3& axis)
  {
    return {to_occ(origin), gp_Dir(axis[0], axis[1], axis[2])};
  }

  [[nodiscard]] TopoDS_Shape half_space(const Vec3& point, const Vec3& outwards) const
  {
    const Vec3 normal = (1.0 / norm(outwards)) * outwards;
    const Vec3 foot = centre_ - dot(centre_ - point, normal) * normal;
    gp_Ax2 frame = frame_at(foot, -1.0 * normal);
    frame.Translate(-reach_ * (gp_Vec(frame.XDirection()) + gp_Vec(frame.YDirection())));
    const double depth = reach_ + norm(centre_ - foot);
    return BRepPrimAPI_MakeBox(frame, 2.0 * reach_, 2.0 * reach_, depth).Shape();
  }

  [[nodiscard]] TopoDS_Shape brick(const Numbers& numbers) const
  {
    const Vec3 corner = numbers.point(0);
    const std::array<Vec3, 3> edges{numbers.point(3) - corner, numbers.point(6) - corner,
                                    numbers.point(9) - corner};
    TopoDS_Shape inside;
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 normal = cross(edges[(i + 1) % 3], edges[(i + 2) % 3]);
      if (dot(normal, edges[i]) < 0.0) normal = -1.0 * normal;
      for (const TopoDS_Shape& side :
           {half_space(corner, -1.0 * normal), half_space(corner + edges[i], normal)}) {
        inside = inside.IsNull() ? side : combined<BRepAlgoAPI_Common>(inside, side);
      }
    }
    return inside;
  }

  [[nodiscard]] TopoDS_Shape cylinder(const Numbers& numbers) const
  {
    const Vec3 from = numbers.point(0);
    const Vec3 axis = (1.0 / norm(numbers.point(3) - from)) * (numbers.point(3) - from);
    const Vec3 start = from + (dot(centre_ - from, axis) - reach_) * axis;
    return BRepPrimAPI_MakeCylinder(frame_at(start, axis), numbers.all.at(6), 2.0 * reach_).Shape();
  }

  [[nodiscard]] TopoDS_Shape cone(const ConeShape& cone) const
  {
    const double height = reach_ + norm(centre_ - cone.apex);
    return BRepPrimAPI_MakeCone(frame_at(cone.apex, cone.axis), 0.0, cone.slope * height, height)
        .Shape();
  }

  Vec3 centre_;
  double reach_;
};

// A point of a face's surface, in the middle of its parameters.
Vec3 point_of(const TopoDS_Face& face)
{
  double u0 = 0.0;
  double u1 = 0.0;
  double v0 = 0.0;
  double v1 = 0.0;
  BRepTools::UVBounds(face, u0, u1, v0, v1);
  const gp_Pnt point = BRepAdaptor_Surface(face).Value(0.5 * (u0 + u1), 0.5 * (v0 + v1));
  return {point.X(), point.Y(), point.Z()};
}

// A face lies on one of the surfaces, whose name it gets.
std::string name_of_face(const Geometry& geometry, const TopoDS_Face& face)
{
  const ::netgen::Point<3> point = to_netgen(point_of(face));
  double nearest = 0.0;
  std::string name;
  for (int s = 0; s < geometry.GetNSurf(); ++s) {
    const ::netgen::Surface& surface = *geometry.GetSurface(s);
    const double off = distance(surface, point);
    if (s > 0 && !(off < nearest)) continue;
    nearest = off;
    name = name_unless_default(surface.GetBCName());
  }
  return name;
}

// Of all solids that are to be meshed.
template <class Visit>
void for_each_solid(Geometry& geometry, const Visit& visit)
{
  for (int i = 0; i < geometry.GetNTopLevelObjects(); ++i) {
    auto* const object = geometry.GetTopLevelObject(i);
    if (object->GetSurface() == nullptr) visit(i, *object->GetSolid());
  }
}

void describe_by_circles(::netgen::Primitive& body)
{
  const Numbers numbers(body);
  if (!is_cone(numbers)) return;
  const std::array<double, 2> radii{numbers.all.at(6), numbers.all.at(7)};
  if (std::min(radii[0], radii[1]) != 0.0) return;
  const std::size_t apex = radii[0] == 0.0 ? 0 : 1;
  const Vec3 middle = 0.5 * (numbers.point(0) + numbers.point(3));
  std::vector<double> changed = numbers.all;
  std::ranges::copy(middle, changed.begin() + 3 * static_cast<std::ptrdiff_t>(apex));
  changed[6 + apex] = 0.5 * radii[1 - apex];
  NetgenArray<double> values;
  for (const double value : changed) values.Append(value);
  body.SetPrimitiveData(values);
}

}  // namespace

void describe_cones_by_circles(Geometry& geometry)
{
  for_each_solid(geometry, [](int, Solid& solid) { for_each_body(solid, describe_by_circles); });
}

bool has_apex(Geometry& geometry, double tolerance)
{
  bool has = false;
  for_each_solid(geometry, [&](int, Solid& solid) {
    for_each_body(solid, [&](const ::netgen::Primitive& body) {
      const Numbers numbers(body);
      if (!is_cone(numbers)) return;
      const auto apex = to_netgen(ConeShape(numbers).apex);
      has = has || place_of(apex, solid, tolerance) == Place::on;
    });
  });
  return has;
}

std::string why_only_netgen(Geometry& geometry)
{
  if (is_numbered(geometry) || geometry.GetNUserPoints() > 0) {
    return "identifies faces, or has singular faces, edges or points, or points of its own";
  }
  std::string why;
  for (int i = 0; i < geometry.GetNTopLevelObjects(); ++i) {
    if (geometry.GetTopLevelObject(i)->GetSurface() != nullptr) why = "has a surface without solid";
  }
  for_each_solid(geometry, [&](int, Solid& solid) {
    for_each_body(solid, [&](const ::netgen::Primitive& body) {
      if (!has_counterpart(Numbers(body))) why = kNoCounterpart;
    });
  });
  return why;
}

CsgSolids solids_of_csg(Geometry& geometry, const ::netgen::Box<3>& box)
{
  CsgSolids made;
  cad::CadFile& cad = made.cad;
  TopoDS_Compound all;
  BRep_Builder().MakeCompound(all);
  for_each_solid(geometry, [&](int object, Solid& solid) {
    const Builder::Part part = Builder(box).build(solid);
    const std::string name = name_of_solid(geometry, object);
    if (part.is_outside) throw GeometryError(name + ": has no bound");
    TopExp_Explorer solids(part.shape, TopAbs_SOLID);
    if (!solids.More()) made.empty.push_back(object);
    for (; solids.More(); solids.Next()) {
      BRep_Builder().Add(all, solids.Current());
      cad.names.Bind(solids.Current(), {.name = name});
    }
    for (TopExp_Explorer faces(part.shape, TopAbs_FACE); faces.More(); faces.Next()) {
      const std::string face_name = name_of_face(geometry, TopoDS::Face(faces.Current()));
      if (!face_name.empty()) cad.names.Bind(faces.Current(), {.name = face_name});
    }
  });
  cad.shape = all;
  return made;
}

std::vector<int> unseen_solids(Geometry& geometry)
{
  std::vector<int> unseen;
  for_each_solid(geometry, [&](int object, const Solid&) {
    if (geometry.GetTriApprox(object)->GetNP() == 0) unseen.push_back(object);
  });
  return unseen;
}

::netgen::Box<3> box_of_solids(const TopoDS_Shape& shape, const ::netgen::Box<3>& bound)
{
  Bnd_Box found;
  BRepBndLib::Add(shape, found);
  if (TopExp_Explorer(shape, TopAbs_SOLID).More() && !found.IsVoid()) {
    const auto corner = [](const gp_Pnt& p) { return to_netgen({p.X(), p.Y(), p.Z()}); };
    const ::netgen::Box<3> box(corner(found.CornerMin()), corner(found.CornerMax()));
    if (bound.IsIn(box.PMin()) && bound.IsIn(box.PMax())) return box;
  }
  throw GeometryError(
      "its solids are empty, or outside the bounding box; set one with "
      "'boundingbox (x, y, z; x, y, z);'");
}

}  // namespace tessera::netgen

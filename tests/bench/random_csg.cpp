// SPDX-License-Identifier: BSD-3-Clause
#include "random_csg.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <GProp_GProps.hxx>
#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

namespace {

constexpr double grid = 0.25;  // Of round numbers.

double rounded(double x) { return grid * std::round(x / grid); }

gp_Dir random_direction(Dice& dice)
{
  const double z = dice.between(-1.0, 1.0);
  const double angle = dice.between(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

gp_Ax2 random_frame(Dice& dice, bool is_round)
{
  std::array<double, 3> at{};
  for (double& x : at) x = dice.between(-1.0, 1.0);
  if (!is_round) return {gp_Pnt(at[0], at[1], at[2]), random_direction(dice)};
  const std::array<gp_Dir, 3> axes = {gp::DX(), gp::DY(), gp::DZ()};
  return {gp_Pnt(rounded(at[0]), rounded(at[1]), rounded(at[2])),
          axes[static_cast<std::size_t>(dice.below(3))]};
}

double volume_by(const TopoDS_Shape& shape, double tolerance)
{
  GProp_GProps properties;
  if (tolerance > 0.0) {
    BRepGProp::VolumeProperties(shape, properties, tolerance, true);
  } else {
    BRepGProp::VolumeProperties(shape, properties, true);
  }
  return properties.Mass();
}

// 0 where the shapes do not meet.
double common_volume(const TopoDS_Shape& one, const TopoDS_Shape& other)
{
  BRepAlgoAPI_Common common(one, other);
  if (!common.IsDone() || common.HasErrors()) throw Rejected("an intersection fails");
  return volume_by(common.Shape(), 0.0);
}

template <class Algorithm>
TopoDS_Shape combined(const TopoDS_Shape& one, const TopoDS_Shape& other)
{
  Algorithm algorithm(one, other);
  if (!algorithm.IsDone() || algorithm.HasErrors()) throw Rejected("an operation fails");
  if (algorithm.Shape().IsNull()) throw Rejected("an operation leaves nothing");
  return algorithm.Shape();
}

std::pair<TopoDS_Shape, double> operate(CsgTree::Operation operation, const TopoDS_Shape& left,
                                        const TopoDS_Shape& right)
{
  const double both = common_volume(left, right);
  switch (operation) {
    case CsgTree::Operation::unite:
      return {combined<BRepAlgoAPI_Fuse>(left, right),
              volume_by(left, 0.0) + volume_by(right, 0.0) - both};
    case CsgTree::Operation::cut:
      return {combined<BRepAlgoAPI_Cut>(left, right), volume_by(left, 0.0) - both};
    default:
      return {combined<BRepAlgoAPI_Common>(left, right), both};
  }
}

std::string text(const gp_XYZ& at)
{
  std::array<char, 120> line{};
  std::snprintf(line.data(), line.size(), "%.12f, %.12f, %.12f", at.X(), at.Y(), at.Z());
  return line.data();
}

std::string text(double value)
{
  std::array<char, 40> line{};
  std::snprintf(line.data(), line.size(), "%.12f", value);
  return line.data();
}

// The halfspace that ends at `distance` from the centre along the axis.
std::string plane(const gp_XYZ& centre, const gp_Dir& axis, double distance)
{
  const gp_XYZ outwards = axis.XYZ() * (distance < 0.0 ? -1.0 : 1.0);
  return "plane (" + text(centre + axis.XYZ() * distance) + "; " + text(outwards) + ")";
}

std::string slab(const gp_XYZ& centre, const gp_Dir& axis, double half_width)
{
  return plane(centre, axis, -half_width) + " and " + plane(centre, axis, half_width);
}

// What is between the base of a cylinder or cone and its top.
std::string between_base_and_top(const Body& body)
{
  const gp_XYZ middle = body.frame.Location().XYZ() + body.frame.Direction().XYZ() * (body.b / 2.0);
  return slab(middle, body.frame.Direction(), body.b / 2.0);
}

std::string geo_of(const Body& body)
{
  const gp_XYZ at = body.frame.Location().XYZ();
  const gp_Dir& axis = body.frame.Direction();
  const gp_XYZ top = at + axis.XYZ() * body.b;
  switch (body.kind) {
    case Body::Kind::box:
      return slab(at, body.frame.XDirection(), body.a) + " and "
             + slab(at, body.frame.YDirection(), body.b) + " and " + slab(at, axis, body.c);
    case Body::Kind::cylinder:
      return "cylinder (" + text(at) + "; " + text(top) + "; " + text(body.a) + ") and "
             + between_base_and_top(body);
    case Body::Kind::ball:
      return "sphere (" + text(at) + "; " + text(body.a) + ")";
    case Body::Kind::cone:
      return "cone (" + text(at) + "; " + text(body.a) + "; " + text(top) + "; " + text(body.c)
             + ") and " + between_base_and_top(body);
    case Body::Kind::torus:
      return "torus (" + text(at) + "; " + text(axis.XYZ()) + "; " + text(body.a) + "; "
             + text(body.b) + ")";
  }
  throw Rejected("no such body");
}

// Appends the solids of the tree, and returns the name of the last.
std::string append_geo(const CsgTree& tree, std::string& geo, int& num_solids)
{
  std::string definition;
  if (tree.operation == CsgTree::Operation::none) {
    definition = geo_of(tree.body);
  } else {
    const std::string left = append_geo(*tree.left, geo, num_solids);
    const std::string right = append_geo(*tree.right, geo, num_solids);
    const bool unites = tree.operation == CsgTree::Operation::unite;
    const bool cuts = tree.operation == CsgTree::Operation::cut;
    definition = left + (unites ? " or " : cuts ? " and not " : " and ") + right;
  }
  const std::string name = "s" + std::to_string(++num_solids);
  geo += "solid " + name + " = " + definition + ";\n";
  return name;
}

}  // namespace

Body random_body(Dice& dice)
{
  const bool is_round = dice.chance(0.5);
  const auto length = [&](double low, double high) {
    const double x = dice.between(low, high);
    return is_round ? std::max(rounded(x), grid) : x;
  };
  Body body;
  body.kind = static_cast<Body::Kind>(dice.below(5));
  body.frame = random_frame(dice, is_round);
  body.a = length(0.3, 1.2);
  body.b = length(0.3, 1.5);
  body.c = length(0.3, 1.2);
  if (body.kind == Body::Kind::torus) body.b = body.a * dice.between(0.2, 0.7);
  if (body.kind == Body::Kind::cone) {
    body.c = dice.chance(0.4) ? 0.0 : body.a * dice.between(0.2, 0.8);
  }
  return body;
}

std::unique_ptr<CsgTree> random_tree(Dice& dice, int depth)
{
  auto tree = std::make_unique<CsgTree>();
  if (depth == 0 || dice.chance(0.15)) {
    tree->body = random_body(dice);
    return tree;
  }
  const double kind = dice.between(0.0, 1.0);
  tree->operation = kind < 0.45   ? CsgTree::Operation::unite
                    : kind < 0.85 ? CsgTree::Operation::cut
                                  : CsgTree::Operation::intersect;
  tree->left = random_tree(dice, depth - 1);
  tree->right = random_tree(dice, depth - 1);
  return tree;
}

TopoDS_Shape shape_of(const Body& body)
{
  const gp_Ax2& frame = body.frame;
  switch (body.kind) {
    case Body::Kind::box: {
      const gp_XYZ corner = frame.Location().XYZ() - frame.XDirection().XYZ() * body.a
                            - frame.YDirection().XYZ() * body.b - frame.Direction().XYZ() * body.c;
      const gp_Ax2 at_corner(gp_Pnt(corner), frame.Direction(), frame.XDirection());
      return BRepPrimAPI_MakeBox(at_corner, 2.0 * body.a, 2.0 * body.b, 2.0 * body.c).Shape();
    }
    case Body::Kind::cylinder:
      return BRepPrimAPI_MakeCylinder(frame, body.a, body.b).Shape();
    case Body::Kind::ball:
      return BRepPrimAPI_MakeSphere(frame, body.a).Shape();
    case Body::Kind::cone:
      return BRepPrimAPI_MakeCone(frame, body.a, body.c, body.b).Shape();
    case Body::Kind::torus:
      return BRepPrimAPI_MakeTorus(frame, body.a, body.b).Shape();
  }
  throw Rejected("no such body");
}

TopoDS_Shape shape_of(const CsgTree& tree)
{
  if (tree.operation == CsgTree::Operation::none) return shape_of(tree.body);
  const auto [shape, wanted] = operate(tree.operation, shape_of(*tree.left), shape_of(*tree.right));
  if (std::abs(volume_by(shape, 0.0) - wanted) > 1e-5 * wanted) {
    throw Rejected("an operation has the wrong volume");
  }
  return shape;
}

std::string geo_of(const CsgTree& tree)
{
  std::string geo = "algebraic3d\n\n";
  int num_solids = 0;
  const std::string top = append_geo(tree, geo, num_solids);
  return geo + "\ntlo " + top + ";\n";
}

double clean_volume(const TopoDS_Shape& shape)
{
  const double volume = volume_by(shape, 0.0);
  if (!(volume > 0.0)) throw Rejected("no volume");
  if (std::abs(volume_by(shape, 1e-6) - volume) > 1e-4 * volume) {
    throw Rejected("its volume is not certain");
  }
  return volume;
}

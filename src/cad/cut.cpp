// SPDX-License-Identifier: BSD-3-Clause
#include "cad/cut.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS_Compound.hxx>
#include <fmt/format.h>
#include <gp_Pln.hxx>

#include "tessera/base/error.hpp"

#include "cad/error.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

using Shapes = std::vector<TopoDS_Shape>;
using Polygon = std::vector<Vec3>;

struct Mass {
  double volume = 0.0;
  Vec3 centre{};
};

Mass mass_of(const TopoDS_Shape& solid)
{
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties);
  return {properties.Mass(), from_occ(properties.CentreOfMass())};
}

// Any two directions of length 1 across a normal of length 1, and across each other.
std::pair<Vec3, Vec3> directions_across(const Vec3& normal)
{
  const auto smallest = std::ranges::min_element(
      normal, [](double a, double b) { return std::abs(a) < std::abs(b); });
  Vec3 axis{};
  axis[static_cast<std::size_t>(smallest - normal.begin())] = 1.0;
  const Vec3 across = cross(normal, axis);
  const Vec3 first = (1.0 / norm(across)) * across;
  return {first, cross(normal, first)};
}

// The plane where it crosses the box.
Polygon square_on(const cut::Plane& plane, const Bnd_Box& box)
{
  constexpr double kHalfSide = 0.6;  // Of the diagonal; a half of it reaches every corner.
  const Vec3 low = from_occ(box.CornerMin());
  const Vec3 high = from_occ(box.CornerMax());
  const double half = kHalfSide * norm(high - low);
  Vec3 centre = midpoint(low, high);
  centre = centre - (dot(plane.normal, centre) - plane.offset) * plane.normal;
  const auto [u, v] = directions_across(plane.normal);
  return {centre - half * u - half * v, centre + half * u - half * v, centre + half * u + half * v,
          centre - half * u + half * v};
}

// What is left of a polygon on one side: where `sign` times the distance is positive.
Polygon clipped(const Polygon& polygon, const cut::Plane& plane, double sign)
{
  const auto distance = [&](const Vec3& p) { return sign * (dot(plane.normal, p) - plane.offset); };
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    const double from = distance(a);
    const double to = distance(b);
    if (from >= 0.0) result.push_back(a);
    if ((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0)) {
      result.push_back(a + (from / (from - to)) * (b - a));
    }
  }
  return result;
}

TopoDS_Face face_of(const Polygon& polygon, const cut::Plane& plane)
{
  BRepBuilderAPI_MakePolygon wire;
  for (const Vec3& point : polygon) wire.Add(to_occ(point));
  wire.Close();
  const gp_Pln on(to_occ(polygon.front()),
                  gp_Dir(plane.normal[0], plane.normal[1], plane.normal[2]));
  BRepBuilderAPI_MakeFace face(on, wire.Wire());
  if (!face.IsDone()) throw NetgenError("OpenCASCADE cannot make the face of a cut");
  return face.Face();
}

// Faces that cut a solid: each plane ends at the planes above it in the tree.
class CutFaces {
 public:
  CutFaces(const cut::CutTree& tree, const TopoDS_Shape& solid) : tree_(tree)
  {
    BRepBndLib::Add(solid, box_, Standard_False);
  }

  TopTools_ListOfShape run(LocalIndex root)
  {
    add(root);
    return faces_;
  }

 private:
  void add(LocalIndex row)
  {
    const cut::CutNode& node = tree_.nodes.at(at(row));
    if (node.part != kNoIndex) return;
    Polygon polygon = square_on(node.plane, box_);
    for (const auto& [above, sign] : path_) {
      polygon = clipped(polygon, tree_.nodes[at(above)].plane, sign);
    }
    if (polygon.size() > 2) faces_.Append(face_of(polygon, node.plane));
    for (const auto& [child, sign] : {std::pair(node.below, -1.0), std::pair(node.above, 1.0)}) {
      path_.emplace_back(row, sign);
      add(child);
      path_.pop_back();
    }
  }

  const cut::CutTree& tree_;
  Bnd_Box box_{};
  std::vector<std::pair<LocalIndex, double>> path_{};  // Rows, and the side of their planes.
  TopTools_ListOfShape faces_{};
};

// What became of shapes in one operation; nothing of those that are gone.
Shapes images_of(BRepAlgoAPI_BuilderAlgo& operation, const TopoDS_Shape& shape)
{
  const TopTools_ListOfShape& modified = operation.Modified(shape);
  if (!modified.IsEmpty()) return {modified.begin(), modified.end()};
  if (operation.IsDeleted(shape)) return {};
  return {shape};
}

void build(BRepAlgoAPI_BuilderAlgo& operation, const char* what)
{
  operation.SetNonDestructive(Standard_True);
  operation.SetRunParallel(Standard_False);
  operation.Build();
  if (operation.HasErrors()) throw NetgenError(fmt::format("OpenCASCADE cannot {}", what));
}

// The part that a piece of a solid is, by the piece's centre.
using PartOf = std::function<LocalIndex(LocalIndex solid, const Vec3& centre)>;

class Cutter {
 public:
  // @param[in] tools The faces that cut each solid.
  Cutter(const TopoDS_Shape& uncut, std::vector<TopTools_ListOfShape> tools)
      : tools_(std::move(tools))
  {
    for (TopExp_Explorer solids(uncut, TopAbs_SOLID); solids.More(); solids.Next()) {
      solids_.push_back(solids.Current());
      pieces_.push_back({solids.Current()});
    }
    faces_ = parts_of(uncut, TopAbs_FACE);
    edges_ = parts_of(uncut, TopAbs_EDGE);
    for (const TopoDS_Shape& face : faces_) face_images_.push_back({face});
    for (const TopoDS_Shape& edge : edges_) edge_images_.push_back({edge});
  }

  CutShape run(const PartOf& part_of)
  {
    for (std::size_t s = 0; s < solids_.size(); ++s) split(s);
    if (solids_.size() > 1) join();
    require_same_volumes();
    collect(part_of);
    return std::move(cut_);
  }

 private:
  void split(std::size_t s)
  {
    if (tools_.at(s).IsEmpty()) return;
    TopTools_ListOfShape arguments;
    arguments.Append(solids_[s]);
    BRepAlgoAPI_Splitter splitter;
    splitter.SetArguments(arguments);
    splitter.SetTools(tools_[s]);
    build(splitter, "cut the model");
    pieces_[s] = images_of(splitter, solids_[s]);
    follow(splitter, s);
  }

  // The faces between two solids were cut on either side by itself.
  void join()
  {
    TopTools_ListOfShape arguments;
    for (const Shapes& pieces : pieces_) {
      for (const TopoDS_Shape& piece : pieces) arguments.Append(piece);
    }
    BRepAlgoAPI_BuilderAlgo fuse;
    fuse.SetArguments(arguments);
    build(fuse, "join the parts of the model");
    for (Shapes& pieces : pieces_) pieces = all_images(fuse, pieces);
    for (Shapes& images : face_images_) images = all_images(fuse, images);
    for (Shapes& images : edge_images_) images = all_images(fuse, images);
  }

  static Shapes all_images(BRepAlgoAPI_BuilderAlgo& operation, const Shapes& shapes)
  {
    Shapes all;
    for (const TopoDS_Shape& shape : shapes) {
      const Shapes images = images_of(operation, shape);
      all.insert(all.end(), images.begin(), images.end());
    }
    return all;
  }

  // A face or an edge of two solids has images of both. Tools may have edges of the uncut shape.
  void follow(BRepAlgoAPI_BuilderAlgo& operation, std::size_t s)
  {
    const auto add = [&](TopAbs_ShapeEnum kind, const Shapes& uncut, std::vector<Shapes>& images) {
      TopTools_IndexedMapOfShape of_solid;
      TopExp::MapShapes(solids_[s], kind, of_solid);
      for (const TopoDS_Shape& tool : tools_[s]) TopExp::MapShapes(tool, kind, of_solid);
      for (std::size_t i = 0; i < uncut.size(); ++i) {
        if (!of_solid.Contains(uncut[i])) continue;
        for (const TopoDS_Shape& image : images_of(operation, uncut[i])) images[i].push_back(image);
      }
    };
    add(TopAbs_FACE, faces_, face_images_);
    add(TopAbs_EDGE, edges_, edge_images_);
  }

  void require_same_volumes() const
  {
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      if (have_volume_of(pieces_[s], solids_[s])) continue;
      throw NetgenError(fmt::format("OpenCASCADE's parts of solid {} do not have its volume, {:g}",
                                    s + 1, mass_of(solids_[s]).volume));
    }
  }

  void collect(const PartOf& part_of)
  {
    struct Piece {
      LocalIndex part;
      LocalIndex solid;
      TopoDS_Shape shape;
    };
    std::vector<Piece> pieces;
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      const auto solid = static_cast<LocalIndex>(s);
      for (const TopoDS_Shape& piece : pieces_[s]) {
        pieces.push_back({part_of(solid, mass_of(piece).centre), solid, piece});
      }
    }
    std::ranges::stable_sort(pieces, {}, &Piece::part);
    TopoDS_Compound compound;
    BRep_Builder().MakeCompound(compound);
    for (const Piece& piece : pieces) {
      BRep_Builder().Add(compound, piece.shape);
      cut_.solid.push_back(piece.solid);
      cut_.part.push_back(piece.part);
    }
    cut_.shape = compound;
    number(face_images_, cut_.faces);
    number(edge_images_, cut_.edges);
  }

  static void number(const std::vector<Shapes>& images, TopTools_DataMapOfShapeInteger& numbers)
  {
    for (std::size_t i = 0; i < images.size(); ++i) {
      for (const TopoDS_Shape& image : images[i]) numbers.Bind(image, static_cast<int>(i));
    }
  }

  std::vector<TopTools_ListOfShape> tools_;
  Shapes solids_{};
  Shapes faces_{};
  Shapes edges_{};
  std::vector<Shapes> pieces_{};       // By solid.
  std::vector<Shapes> face_images_{};  // By face of the uncut shape.
  std::vector<Shapes> edge_images_{};
  CutShape cut_{};
};

void require_valid(const CutShape& cut, const TopoDS_Shape& uncut)
{
  if (BRepCheck_Analyzer(cut.shape).IsValid()) return;
  if (!BRepCheck_Analyzer(uncut).IsValid()) return;  // It was so before.
  throw NetgenError("OpenCASCADE's parts of the model are not valid");
}

// What it throws is a NetgenError: another try may go without the cut.
template <class Cut>
CutShape cut_by(const Cut& cut)
{
  try {
    return with_occ_errors("cuts", cut);
  } catch (const GeometryError& error) {
    throw NetgenError(error.what());
  }
}

}  // namespace

LocalIndex CutShape::number_in(const TopTools_DataMapOfShapeInteger& map, const TopoDS_Shape& shape)
{
  const int* const number = map.Seek(shape);
  return number == nullptr ? kNoIndex : static_cast<LocalIndex>(*number);
}

CutShape cut_shape(const TopoDS_Shape& uncut, const cut::CutTree& tree)
{
  return cut_by([&] {
    std::vector<TopTools_ListOfShape> tools;
    for (TopExp_Explorer solids(uncut, TopAbs_SOLID); solids.More(); solids.Next()) {
      const LocalIndex root = tree.solid_root.at(tools.size());
      tools.push_back(CutFaces(tree, solids.Current()).run(root));
    }
    const auto part_of = [&](LocalIndex solid, const Vec3& centre) {
      return tree.part_of(solid, centre);
    };
    CutShape cut = Cutter(uncut, std::move(tools)).run(part_of);
    require_valid(cut, uncut);
    return cut;
  });
}

CutShape cut_at_faces(const TopoDS_Shape& uncut, std::vector<TopTools_ListOfShape> tools)
{
  return cut_by([&] {
    CutShape cut = Cutter(uncut, std::move(tools)).run([](LocalIndex, const Vec3&) { return 0; });
    require_valid(cut, uncut);
    return cut;
  });
}

TopoDS_Face plane_face(const Vec3& point, const Vec3& normal, const TopoDS_Shape& through)
{
  Bnd_Box box;
  BRepBndLib::Add(through, box, Standard_False);
  const cut::Plane plane{.normal = normal, .offset = dot(normal, point)};
  return face_of(square_on(plane, box), plane);
}

}  // namespace tessera::cad

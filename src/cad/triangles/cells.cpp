// SPDX-License-Identifier: BSD-3-Clause
#include "cad/triangles/cells.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <BOPAlgo_MakerVolume.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pln.hxx>

#include "cad/shape.hpp"
#include "cad/triangles/triangulation.hpp"

namespace tessera::cad {
namespace {

using Corners = std::array<Vec3, 3>;

// Radians by which triangles of one plane may be turned.
constexpr double kFlat = 1e-4;

// 4,000 faces take OpenCASCADE 2 seconds, 7,000 took 18. Free-form bodies have so many.
constexpr std::size_t kMostFaces = 5000;

// A face for every triangle; they share their edges.
class ShellBuilder {
 public:
  explicit ShellBuilder(const model::TriangleSurface& surface) : surface_(surface)
  {
    builder_.MakeShell(shell_);
    for (LocalIndex v = 0; v < surface.num_vertices(); ++v) {
      TopoDS_Vertex& vertex = vertices_.emplace_back();
      builder_.MakeVertex(vertex, to_occ(surface.position(v)), Precision::Confusion());
    }
    for (LocalIndex t = 0; t < surface.num_triangles(); ++t) add_face(t);
    shell_.Closed(true);
  }

  [[nodiscard]] const TopoDS_Shell& shell() const { return shell_; }

 private:
  void add_face(LocalIndex t)
  {
    const LocalIndex* v = &surface_.triangle_vertices[3 * at(t)];
    TopoDS_Wire wire;
    builder_.MakeWire(wire);
    for (std::size_t c = 0; c < 3; ++c) builder_.Add(wire, edge(v[c], v[(c + 1) % 3]));
    wire.Closed(true);
    const auto [p, q, r] = surface_.corners(t);
    const Vec3 normal = cross(q - p, r - p);
    if (norm(normal) == 0.0) return;  // Its neighbours are as near to each other as to it.
    const gp_Pln plane(to_occ(p), gp_Dir(normal[0], normal[1], normal[2]));
    builder_.Add(shell_, BRepBuilderAPI_MakeFace(plane, wire, true).Face());
  }

  TopoDS_Shape edge(LocalIndex a, LocalIndex b)
  {
    const auto [low, high] = std::minmax(a, b);
    TopoDS_Edge& edge = edges_[{low, high}];
    if (edge.IsNull()) edge = BRepBuilderAPI_MakeEdge(vertices_[at(low)], vertices_[at(high)]);
    return a < b ? edge : edge.Reversed();
  }

  const model::TriangleSurface& surface_;
  BRep_Builder builder_{};
  TopoDS_Shell shell_{};
  std::vector<TopoDS_Vertex> vertices_{};
  std::map<std::pair<LocalIndex, LocalIndex>, TopoDS_Edge> edges_{};
};

TopoDS_Shape with_plane_faces(const TopoDS_Shape& shape, double tolerance)
{
  ShapeUpgrade_UnifySameDomain unify(shape, true, true, false);
  unify.SetLinearTolerance(tolerance);
  unify.SetAngularTolerance(kFlat);
  unify.Build();
  return unify.Shape();
}

// Its solids are the cells; null if it fails.
TopoDS_Shape parted_space(const std::vector<TopoDS_Shape>& faces, double tolerance)
{
  TopTools_ListOfShape arguments;
  for (const TopoDS_Shape& face : faces) arguments.Append(face);
  BOPAlgo_MakerVolume maker;
  maker.SetArguments(arguments);
  maker.SetIntersect(true);
  maker.SetRunParallel(false);
  maker.SetFuzzyValue(tolerance);
  maker.Perform();
  return maker.HasErrors() ? TopoDS_Shape() : maker.Shape();
}

// As the face looks without the orientation that a cell gives it.
std::vector<Corners> triangles_on(const TopoDS_Shape& face)
{
  TopLoc_Location place;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(TopoDS::Face(face), place);
  std::vector<Corners> triangles;
  for (int t = 1; t <= mesh->NbTriangles(); ++t) {
    std::array<int, 3> nodes{};
    mesh->Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
    Corners corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      const gp_Pnt p = mesh->Node(nodes[c]).Transformed(place);
      corners[c] = {p.X(), p.Y(), p.Z()};
    }
    triangles.push_back(corners);
  }
  return triangles;
}

}  // namespace

std::vector<Corners> triangles_of(const Cells& cells, const CellSide& side)
{
  std::vector<Corners> triangles = cells.face_triangles[side.face];
  if (side.is_turned) {
    for (Corners& corners : triangles) std::swap(corners[1], corners[2]);
  }
  return triangles;
}

std::vector<Corners> skin_of(const Cells& cells, std::size_t cell)
{
  std::vector<Corners> skin;
  for (const CellSide& side : cells.sides[cell]) {
    const std::vector<Corners> triangles = triangles_of(cells, side);
    skin.insert(skin.end(), triangles.begin(), triangles.end());
  }
  return skin;
}

Cells cells_of(const model::TriangleSurface& surface, double tolerance)
{
  const TopoDS_Shape given = with_plane_faces(ShellBuilder(surface).shell(), tolerance);
  const std::vector<TopoDS_Shape> given_faces = parts_of(given, TopAbs_FACE);
  if (given_faces.size() > kMostFaces) return {};
  const TopoDS_Shape parted = parted_space(given_faces, tolerance);
  if (parted.IsNull()) return {};
  IMeshTools_Parameters parameters;  // Faces and edges are straight, whatever these are.
  parameters.Deflection = box_diagonal_of(parted);
  parameters.Angle = 1.0;
  if (!triangulate_faces(parted, parameters).empty()) return {};
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(parted, TopAbs_FACE, faces);
  Cells cells;
  for (int f = 1; f <= faces.Extent(); ++f) cells.face_triangles.push_back(triangles_on(faces(f)));
  for (const TopoDS_Shape& solid : parts_of(parted, TopAbs_SOLID)) {
    std::vector<CellSide>& sides = cells.sides.emplace_back();
    for (TopExp_Explorer side(solid, TopAbs_FACE); side.More(); side.Next()) {
      const TopAbs_Orientation turn = side.Current().Orientation();
      if (turn != TopAbs_FORWARD && turn != TopAbs_REVERSED) continue;  // A sheet inside of it.
      sides.push_back(
          {static_cast<std::size_t>(faces.FindIndex(side.Current())) - 1, turn == TopAbs_REVERSED});
    }
  }
  return cells;
}

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#include "cad/triangles/tessellation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <BRep_Tool.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/union_find.hpp"
#include "tessera/surface/overlap.hpp"

#include "cad/shape.hpp"
#include "cad/triangles/triangulation.hpp"

namespace tessera::cad {
namespace {

using surface::PatchSurface;

// How far triangles may be off the surface, in parts of the wanted size, and how much neighbours
// may turn, radians. With these the remeshed surface follows something better than its own edges
// can be.
constexpr double kDeflection = 0.02;
constexpr double kAngle = 0.25;

// Triangles of two sheets cut each other if they are farther off than the sheets are apart. Then
// those of both faces are made finer by this factor, as long as that helps.
constexpr double kFiner = 0.25;
constexpr int kMostFiner = 2;

void triangulate(const TopoDS_Shape& shape, double size, const std::vector<double>& face_part)
{
  IMeshTools_Parameters parameters;
  parameters.Deflection = kDeflection * size;
  parameters.Angle = kAngle;
  const std::vector<int> bare = triangulate_faces(shape, parameters, face_part);
  if (bare.empty()) return;
  throw NetgenError(fmt::format(
      "face {} can be triangulated neither by OpenCASCADE nor from its boundary; repair it in the "
      "CAD program",
      bare.front() + 1));
}

class Tessellation {
 public:
  explicit Tessellation(const TopoDS_Shape& shape)
  {
    TopExp::MapShapes(shape, TopAbs_FACE, faces_);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges_);
    TopExp::MapShapes(shape, TopAbs_VERTEX, vertices_);
    for (int v = 1; v <= vertices_.Extent(); ++v) {
      add_vertex(BRep_Tool::Pnt(TopoDS::Vertex(vertices_(v))));
    }
    surface_.vertex_is_fixed.assign(surface_.vertex_xyz.size(), 1);
    set_materials(shape);
  }

  PatchSurface run()
  {
    for (int f = 1; f <= faces_.Extent(); ++f) {
      if (surface_.patch_materials[static_cast<std::size_t>(f) - 1] == kNoMaterials) continue;
      add_face(f);
    }
    if (has_same_ && !is_left_out(Repair::merged_points)) merge_same();
    for (const auto& [edge, record] : curves_) {
      surface_.edges.push_back(edge);
      surface_.edge_curve.push_back(record.curve);
      surface_.edge_t.push_back(record.t);
    }
    return std::move(surface_);
  }

 private:
  static constexpr std::array<LocalIndex, 2> kNoMaterials{0, 0};

  struct CurveEdge {
    LocalIndex curve = kNoIndex;
    std::array<double, 2> t{};
  };

  LocalIndex add_vertex(const gp_Pnt& point)
  {
    surface_.vertex_xyz.push_back({point.X(), point.Y(), point.Z()});
    surface_.vertex_is_fixed.push_back(0);
    return same_.add();
  }

  // A face as it is, without the orientation that some solid gives it, is seen from above.
  void set_materials(const TopoDS_Shape& shape)
  {
    surface_.patch_materials.assign(static_cast<std::size_t>(faces_.Extent()), kNoMaterials);
    LocalIndex material = 0;
    for (TopExp_Explorer solids(shape, TopAbs_SOLID); solids.More(); solids.Next()) {
      ++material;
      for (TopExp_Explorer faces(solids.Current(), TopAbs_FACE); faces.More(); faces.Next()) {
        const TopoDS_Shape& face = faces.Current();
        auto& sides =
            surface_.patch_materials[static_cast<std::size_t>(faces_.FindIndex(face)) - 1];
        if (face.Orientation() == TopAbs_FORWARD) sides[0] = material;
        if (face.Orientation() == TopAbs_REVERSED) sides[1] = material;
      }
    }
  }

  void add_face(int f)
  {
    const TopoDS_Shape upright = faces_(f).Oriented(TopAbs_FORWARD);
    const TopoDS_Face& face = TopoDS::Face(upright);
    TopLoc_Location place;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, place);
    std::vector<LocalIndex> numbers(static_cast<std::size_t>(mesh->NbNodes()) + 1, kNoIndex);
    for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
      number_edge(TopoDS::Edge(edges.Current()), mesh, place, numbers);
    }
    for (int n = 1; n <= mesh->NbNodes(); ++n) {
      LocalIndex& number = numbers[static_cast<std::size_t>(n)];
      if (number == kNoIndex) number = add_vertex(mesh->Node(n).Transformed(place));
    }
    add_triangles(*mesh, f - 1, numbers);
  }

  // Nodes on an edge are those of every face around it; at a pole all are the shape's vertex.
  void number_edge(const TopoDS_Edge& edge, const Handle(Poly_Triangulation) & mesh,
                   const TopLoc_Location& place, std::vector<LocalIndex>& numbers)
  {
    const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, mesh, place);
    if (polygon.IsNull()) return;
    const LocalIndex first = vertices_.FindIndex(TopExp::FirstVertex(edge)) - 1;
    const LocalIndex last = vertices_.FindIndex(TopExp::LastVertex(edge)) - 1;
    const int number_of_edge = edges_.FindIndex(edge);
    LocalIndex before = kNoIndex;
    for (int i = 1; i <= polygon->NbNodes(); ++i) {
      const int node = polygon->Node(i);
      LocalIndex number = i == 1 ? first : last;
      const bool is_inside = i > 1 && i < polygon->NbNodes();
      if (is_inside && !BRep_Tool::Degenerated(edge)) {
        const auto [found, is_new] = edge_vertices_.try_emplace({number_of_edge, i}, kNoIndex);
        if (is_new) found->second = add_vertex(mesh->Node(node).Transformed(place));
        number = found->second;
      }
      LocalIndex& known = numbers[static_cast<std::size_t>(node)];
      if (known != kNoIndex && same_.join(known, number)) has_same_ = true;
      known = number;
      if (before != kNoIndex && before != number && polygon->HasParameters()) {
        add_curve_edge(number_of_edge - 1, {before, number},
                       {polygon->Parameter(i - 1), polygon->Parameter(i)});
      }
      before = number;
    }
  }

  void add_curve_edge(LocalIndex curve, PatchSurface::Edge ends, std::array<double, 2> t)
  {
    if (ends[0] > ends[1]) {
      std::swap(ends[0], ends[1]);
      std::swap(t[0], t[1]);
    }
    curves_[ends] = {curve, t};
  }

  void add_triangles(const Poly_Triangulation& mesh, LocalIndex patch,
                     const std::vector<LocalIndex>& numbers)
  {
    for (int t = 1; t <= mesh.NbTriangles(); ++t) {
      std::array<int, 3> nodes{};
      mesh.Triangle(t).Get(nodes[0], nodes[1], nodes[2]);
      PatchSurface::Triangle v{};
      std::array<std::array<double, 2>, 3> uv{};
      for (std::size_t c = 0; c < 3; ++c) {
        v[c] = numbers[static_cast<std::size_t>(nodes[c])];
        if (mesh.HasUVNodes()) uv[c] = {mesh.UVNode(nodes[c]).X(), mesh.UVNode(nodes[c]).Y()};
      }
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;  // At a pole.
      surface_.triangles.push_back(v);
      surface_.triangle_patch.push_back(patch);
      surface_.triangle_uv.push_back(uv);
    }
  }

  // Both ends of an edge that is shorter than OpenCASCADE's precision, or than what our own
  // triangles tell apart, are one point in some faces. Then they are in all.
  void merge_same()
  {
    note_repair(Repair::merged_points);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      PatchSurface::Triangle v = surface_.triangles[t];
      for (LocalIndex& corner : v) corner = same_.find(corner);
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      surface_.triangles[kept] = v;
      surface_.triangle_patch[kept] = surface_.triangle_patch[t];
      surface_.triangle_uv[kept++] = surface_.triangle_uv[t];
    }
    surface_.triangles.resize(kept);
    surface_.triangle_patch.resize(kept);
    surface_.triangle_uv.resize(kept);
    for (const auto& [edge, record] : std::exchange(curves_, {})) {
      const PatchSurface::Edge ends{same_.find(edge[0]), same_.find(edge[1])};
      if (ends[0] != ends[1]) add_curve_edge(record.curve, ends, record.t);
    }
  }

  TopTools_IndexedMapOfShape faces_{};
  TopTools_IndexedMapOfShape edges_{};
  TopTools_IndexedMapOfShape vertices_{};
  std::map<std::pair<int, int>, LocalIndex> edge_vertices_{};  // Edge, place along it.
  std::map<PatchSurface::Edge, CurveEdge> curves_{};
  UnionFind same_{};
  bool has_same_ = false;
  PatchSurface surface_{};
};

// With triangles that are off each face by its part of what they usually are.
PatchSurface triangles_of(const TopoDS_Shape& shape, double size,
                          const std::vector<double>& face_part)
{
  triangulate(shape, size, face_part);
  PatchSurface surface = Tessellation(shape).run();
  surface::separate_patches(surface);
  try {
    surface::validate(surface);
  } catch (const MeshError& error) {
    throw NetgenError(std::string("OpenCASCADE's triangles: ") + error.what());
  }
  return surface;
}

std::set<LocalIndex> patches_of(const std::vector<surface::Overlap>& cuts,
                                const PatchSurface& surface)
{
  std::set<LocalIndex> patches;
  for (const surface::Overlap& cut : cuts) {
    patches.insert(surface.triangle_patch[cut.first]);
    patches.insert(surface.triangle_patch[cut.second]);
  }
  return patches;
}

}  // namespace

PatchSurface tessellation_of(const TopoDS_Shape& shape, double size)
{
  std::vector<double> face_part(parts_of(shape, TopAbs_FACE).size(), 1.0);
  PatchSurface best = triangles_of(shape, size, face_part);
  if (is_left_out(Repair::finer_tessellation)) return best;
  std::vector<surface::Overlap> cuts = surface::find_overlaps(best);
  for (int round = 0; round < kMostFiner && !cuts.empty(); ++round) {
    for (const LocalIndex patch : patches_of(cuts, best)) face_part[at(patch)] *= kFiner;
    PatchSurface finer = triangles_of(shape, size, face_part);
    std::vector<surface::Overlap> left = surface::find_overlaps(finer);
    if (left.size() >= cuts.size()) break;
    cuts = std::move(left);
    best = std::move(finer);
    note_repair(Repair::finer_tessellation);
  }
  return best;
}

}  // namespace tessera::cad

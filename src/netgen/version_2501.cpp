// SPDX-License-Identifier: BSD-3-Clause
// What NETGEN 6.2.2501 does worse than 6.2.1905, done as there.
#include <array>

#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

// Corners of a face at which a whole side of its parameters is one point.
std::vector<::netgen::Point<3>> apices_of(const TopoDS_Shape& face)
{
  std::vector<::netgen::Point<3>> apices;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    if (!BRep_Tool::Degenerated(edge)) continue;
    const gp_Pnt point = BRep_Tool::Pnt(TopExp::FirstVertex(edge));
    apices.emplace_back(point.X(), point.Y(), point.Z());
  }
  return apices;
}

// NETGEN's two ways to spread a face out, and its names for them.
enum class Spread : int { by_parameters = -1, onto_planes = 1 };

bool is_meshed(const OccGeometry& geometry, Spread spread, ::netgen::Mesh& mesh,
               const ::netgen::MeshingParameters& parameters, int face,
               ngcore::FlatArray<int, ::netgen::PointIndex> local)
{
  constexpr bool kRemoveWhatFailed = true;
  return !::netgen::OCCMeshFace(geometry, mesh, local, parameters, face, static_cast<int>(spread),
                                kRemoveWhatFailed);
}

void remove_triangles_from(int first, ::netgen::Mesh& mesh)
{
  const auto end = static_cast<int>(mesh.GetNSE());
  for (int t = first; t < end; ++t) mesh.Delete(::netgen::SurfaceElementIndex(t));
  mesh.Compress();
}

}  // namespace

bool StlGeometry::ProjectPointGI(int /*face*/, ::netgen::Point<3>& point,
                                 ::netgen::PointGeomInfo& info) const
{
  SelectChartOfTriangle(info.trignum);
  ::netgen::Point<3> moved = point;
  const int triangle = Project(moved);
  if (triangle == 0) return false;
  point = moved;
  info.trignum = triangle;
  return true;
}

// A middle that is on neither chart stays on the chord.
void StlGeometry::PointBetween(const ::netgen::Point<3>& first, const ::netgen::Point<3>& second,
                               double part, int face, const ::netgen::PointGeomInfo& first_info,
                               const ::netgen::PointGeomInfo& second_info,
                               ::netgen::Point<3>& between, ::netgen::PointGeomInfo& info) const
{
  between = first + part * (second - first);
  for (const auto& end : {first_info, second_info}) {
    info = end;
    if (ProjectPointGI(face, between, info)) return;
  }
  info = first_info;
}

bool OccGeometry::MeshFace(::netgen::Mesh& mesh, const ::netgen::MeshingParameters& parameters,
                           int face, ngcore::FlatArray<int, ::netgen::PointIndex> local) const
{
  apices_ = apices_of(fmap(face + 1));
  if (apices_.empty()) return OCCGeometry::MeshFace(mesh, parameters, face, local);
  bool is_done = is_meshed(*this, Spread::by_parameters, mesh, parameters, face, local)
                 || is_meshed(*this, Spread::onto_planes, mesh, parameters, face, local);
  if (!is_done) {
    // The third way asks this class for normals. Triangles of a seam's two sides overlap in it.
    ::netgen::MeshingParameters without_overlaps = parameters;
    without_overlaps.checkoverlap = 0;
    const auto num_before = static_cast<int>(mesh.GetNSE());
    is_done = !::netgen::NetgenGeometry::MeshFace(mesh, without_overlaps, face, local);
    if (!is_done) remove_triangles_from(num_before, mesh);
  }
  apices_.clear();
  if (!is_done) return OCCGeometry::MeshFace(mesh, parameters, face, local);  // Says so.
  facemeshstatus[face] = 1;
  return false;
}

::netgen::Vec<3> OccGeometry::GetNormal(int surface, const ::netgen::Point<3>& point,
                                        const ::netgen::PointGeomInfo* info) const
{
  constexpr double kAtApex = 1e-8;  // Of the model's diagonal.
  for (const ::netgen::Point<3>& apex : apices_) {
    if (::netgen::Dist(point, apex) < kAtApex * boundingbox.Diam()) return {0.0, 0.0, 0.0};
  }
  return OCCGeometry::GetNormal(surface, point, info);
}

// MeshVolume() looks whether the surface is closed after it has filled it, and an open one kills
// the process. Why it fails, it says on standard error alone.
void mesh_volume(const ::netgen::MeshingParameters& parameters, ::netgen::Mesh& mesh)
{
  if (parameters.checkoverlappingboundary != 0 && mesh.CheckOverlappingBoundary()) {
    throw ::netgen::NgException("Stop meshing since boundary mesh is overlapping");
  }
  for (int domain = 1; domain <= mesh.GetNDomains(); ++domain) {
    mesh.FindOpenElements(domain);
    if (mesh.CheckConsistentBoundary() != 0) {
      throw ::netgen::NgException("Stop meshing since surface mesh not consistent");
    }
  }
  ::netgen::MeshingParameters checked = parameters;
  checked.checkoverlappingboundary = 0;
  if (::netgen::MeshVolume(checked, mesh) == ::netgen::MESHING3_OK) return;
  throw ::netgen::NgException("Stop meshing since too many attempts");
}

}  // namespace tessera::netgen

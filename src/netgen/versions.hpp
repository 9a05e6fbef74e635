// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <istream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include <BRep_Tool.hxx>
#include <TopoDS.hxx>
#include <csg.hpp>
#include <meshing.hpp>
#include <occgeom.hpp>
#include <stlgeom.hpp>

/// What differs between NETGEN 6.2.1905 (Debian 12) and 6.2.2501 (Debian 13), and nothing else.
///
/// The library of 6.2.2501 hides its classes of surfaces and solids of CSG, and many functions.
/// What it does not hide is called in their place, also virtual functions.
#if __has_include(<netgen_version.hpp>)  // Not in 6.2.1905.

namespace netgen {
// In libnglib.so and in no header.
extern DLL_HEADER STLParameters stlparam;
}  // namespace netgen

namespace tessera::netgen {

template <class T>
using NetgenArray = ::netgen::NgArray<T>;

/// @brief Keeps NETGEN's optimiser from starting threads: its job process has one.
inline void use_one_thread(::netgen::MeshingParameters& parameters)
{
  parameters.parallel_meshing = false;
}

/// @brief What NETGEN is to make a mesh of a geometry in: it looks for the geometry there. The
/// geometry must outlive its mesh.
[[nodiscard]] inline std::shared_ptr<::netgen::Mesh> empty_mesh(::netgen::NetgenGeometry& geometry)
{
  auto mesh = std::make_shared<::netgen::Mesh>();
  mesh->SetGeometry({std::shared_ptr<void>(), &geometry});
  return mesh;
}

/// @brief The surface as a plane; null if it is none. Its class is known by name only.
[[nodiscard]] inline const ::netgen::Plane* as_plane(const ::netgen::Surface* surface)
{
  constexpr std::string_view kPlane = "N6netgen5PlaneE";
  return typeid(*surface).name() == kPlane ? static_cast<const ::netgen::Plane*>(surface) : nullptr;
}

/// @brief Moves a point to where two surfaces meet.
inline void project_to_edge(const ::netgen::CSGeometry& geometry, int first, int second,
                            ::netgen::Point<3>& point)
{
  geometry.ProjectPointEdge(first, second, point);
}

/// @brief Reads a CSG file; null if it is none. Only readers of files are not hidden, so the text
/// is in a file meanwhile.
/// @throws OutputError if there is no place for it.
[[nodiscard]] std::unique_ptr<::netgen::CSGeometry> read_csg(const std::string& text);

[[nodiscard]] inline ::netgen::STLReadTriangle stl_triangle(const ::netgen::Point<3>* corners,
                                                            const ::netgen::Vec<3>& normal)
{
  ::netgen::STLReadTriangle triangle;
  for (int c = 0; c < 3; ++c) const_cast<::netgen::Point<3>&>(triangle[c]) = corners[c];
  const_cast<::netgen::Vec<3>&>(triangle.Normal()) = normal;
  return triangle;
}

inline void mesh_stl(::netgen::STLGeometry& geometry, std::shared_ptr<::netgen::Mesh>& mesh,
                     ::netgen::MeshingParameters& parameters)
{
  geometry.GenerateMesh(mesh, parameters);
}

/// @brief An STL surface whose points stay where they are being optimised.
///
/// NETGEN's own takes any triangle of the surface for a point that has left its chart, as one of
/// the other side of a wall, and tells no one which.
class StlGeometry final : public ::netgen::STLGeometry {
 public:
  // NOLINTBEGIN(readability-identifier-naming): NETGEN's
  /// @return Whether the point is on the chart of its triangle still; if not, nothing is changed.
  bool ProjectPointGI(int face, ::netgen::Point<3>& point,
                      ::netgen::PointGeomInfo& info) const override;
  void PointBetween(const ::netgen::Point<3>& first, const ::netgen::Point<3>& second, double part,
                    int face, const ::netgen::PointGeomInfo& first_info,
                    const ::netgen::PointGeomInfo& second_info, ::netgen::Point<3>& between,
                    ::netgen::PointGeomInfo& info) const override;
  /// NETGEN's own calls what its library hides. Nothing here is archived.
  void DoArchive(ngcore::Archive& /*archive*/) override {}
  // NOLINTEND(readability-identifier-naming)
};

/// @brief A shape whose faces may have an apex, as cones do.
///
/// There NETGEN's own takes the normal of the one side where a seam ends, so that its front cannot
/// reach the apex from the other sides.
class OccGeometry final : public ::netgen::OCCGeometry {
 public:
  // NOLINTBEGIN(readability-identifier-naming): NETGEN's
  /// @return Whether the face could not be meshed.
  bool MeshFace(::netgen::Mesh& mesh, const ::netgen::MeshingParameters& parameters, int face,
                ngcore::FlatArray<int, ::netgen::PointIndex> local) const override;
  /// @return Nothing at an apex of the face that is being meshed.
  ::netgen::Vec<3> GetNormal(int surface, const ::netgen::Point<3>& point,
                             const ::netgen::PointGeomInfo* info) const override;
  /// A file of a mesh has no geometry: NETGEN would not know this class.
  void SaveToMeshFile(std::ostream& /*file*/) const override {}
  // NOLINTEND(readability-identifier-naming)

 private:
  mutable std::vector<::netgen::Point<3>> apices_{};  // Of the face that is being meshed.
};

/// @brief Keeps NETGEN's optimiser from beginning at a tet, counted from 0.
inline void fix_tet(::netgen::Mesh& mesh, int tet)
{
  mesh[::netgen::ElementIndex(tet)].Flags().fixed = true;
}

/// @brief Fills a surface with tets.
/// @throws ::netgen::NgException if the surface is open, cuts itself, or cannot be filled.
void mesh_volume(const ::netgen::MeshingParameters& parameters, ::netgen::Mesh& mesh);

/// @brief Edges that run beside each other 1 / factor of their length apart get finer.
inline void set_close_edges(::netgen::MeshingParameters& parameters, double factor)
{
  parameters.closeedgefac = factor;
}

/// @brief Of the edge that a segment is on, in the geometry's `emap`.
[[nodiscard]] inline int edge_number(const ::netgen::Segment& segment)
{
  return segment.epgeominfo[0].edgenr + 1;
}

/// @brief Parameter of the edge's curve at an end; NETGEN has it from 0 to 1.
[[nodiscard]] inline double edge_parameter(const ::netgen::OCCGeometry& geometry,
                                           const ::netgen::Segment& segment, int end)
{
  double first = 0.0;
  double last = 0.0;
  BRep_Tool::Range(TopoDS::Edge(geometry.emap(edge_number(segment))), first, last);
  return first + segment.epgeominfo[end].dist * (last - first);
}

}  // namespace tessera::netgen

#else

namespace netgen {
// In libcsg.so and in no header.
// NOLINTNEXTLINE(readability-identifier-naming): NETGEN's
CSGeometry* ParseCSG(std::istream& text, CSGeometry* instance);
}  // namespace netgen

namespace tessera::netgen {

template <class T>
using NetgenArray = ::netgen::Array<T>;

inline void use_one_thread(::netgen::MeshingParameters& /*parameters*/) {}

inline void fix_tet(::netgen::Mesh& mesh, int tet)
{
  mesh[::netgen::ElementIndex(tet)].flags.fixed = true;
}

[[nodiscard]] inline std::shared_ptr<::netgen::Mesh> empty_mesh(
    ::netgen::NetgenGeometry& /*geometry*/)
{
  return nullptr;  // NETGEN makes one.
}

[[nodiscard]] inline const ::netgen::Plane* as_plane(const ::netgen::Surface* surface)
{
  return dynamic_cast<const ::netgen::Plane*>(surface);
}

inline void project_to_edge(const ::netgen::CSGeometry& geometry, int first, int second,
                            ::netgen::Point<3>& point)
{
  ::netgen::ProjectToEdge(geometry.GetSurface(first), geometry.GetSurface(second), point);
}

[[nodiscard]] inline std::unique_ptr<::netgen::CSGeometry> read_csg(const std::string& text)
{
  std::istringstream in(text);
  return std::unique_ptr<::netgen::CSGeometry>(::netgen::ParseCSG(in, nullptr));
}

[[nodiscard]] inline ::netgen::STLReadTriangle stl_triangle(const ::netgen::Point<3>* corners,
                                                            const ::netgen::Vec<3>& normal)
{
  return ::netgen::STLReadTriangle(corners, normal);
}

inline void mesh_stl(::netgen::STLGeometry& geometry, std::shared_ptr<::netgen::Mesh>& mesh,
                     ::netgen::MeshingParameters& parameters)
{
  ::netgen::STLMeshingDummy(&geometry, mesh, parameters);
}

using StlGeometry = ::netgen::STLGeometry;
using OccGeometry = ::netgen::OCCGeometry;

inline void mesh_volume(::netgen::MeshingParameters& parameters, ::netgen::Mesh& mesh)
{
  if (::netgen::MeshVolume(parameters, mesh) == ::netgen::MESHING3_OK) return;
  throw ::netgen::NgException("NETGEN gave up");
}

inline void set_close_edges(::netgen::MeshingParameters& /*parameters*/, double factor)
{
  ::netgen::occparam.resthcloseedgefac = factor;
}

[[nodiscard]] inline int edge_number(const ::netgen::Segment& segment)
{
  return segment.epgeominfo[0].edgenr;
}

[[nodiscard]] inline double edge_parameter(const ::netgen::OCCGeometry& /*geometry*/,
                                           const ::netgen::Segment& segment, int end)
{
  return segment.epgeominfo[end].dist;
}

}  // namespace tessera::netgen

#endif

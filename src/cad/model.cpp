// SPDX-License-Identifier: BSD-3-Clause
#include "cad/model.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <BRepAdaptor_Curve.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/surface/on_geometry.hpp"

#include "cad/cell_numbers.hpp"
#include "cad/description.hpp"
#include "cad/error.hpp"
#include "cad/inner_faces.hpp"
#include "cad/inner_lines.hpp"
#include "cad/shape.hpp"
#include "cad/triangles/tessellation.hpp"
#include "geometry/named_surface.hpp"

namespace tessera::cad {

CadModel::CadModel(OccContent content, std::string file_name)
    : content_(std::move(content)),
      file_name_(std::move(file_name)),
      box_diagonal_(box_diagonal_of(content_.shape))
{
  TopExp::MapShapes(content_.shape, TopAbs_FACE, faces_);
  TopExp::MapShapes(content_.shape, TopAbs_EDGE, edges_);
  num_edges_of_faces_ =
      edges_.Extent() - static_cast<LocalIndex>(inner_lines_of(content_.shape).size());
  for (const TopoDS_Shape& face : parts_of(content_.shape, TopAbs_FACE)) {
    surfaces_.emplace_back(TopoDS::Face(face), box_diagonal_, faces_.Extent());
  }
  for (const TopoDS_Shape& shape : parts_of(content_.shape, TopAbs_EDGE)) {
    const TopoDS_Edge& edge = TopoDS::Edge(shape);
    curves_.push_back(
        BRep_Tool::Degenerated(edge) ? nullptr : std::make_unique<OccCurve>(edge, box_diagonal_));
  }
}

const OccSurface& CadModel::surface_at(LocalIndex surface) const
{
  return surfaces_.at(static_cast<std::size_t>(surface));
}

const OccCurve& CadModel::curve_at(LocalIndex curve) const
{
  const auto& found = curves_.at(static_cast<std::size_t>(curve));
  if (found == nullptr) throw GeometryError(fmt::format("edge {} is a point", curve));
  return *found;
}

model::ModelDescription CadModel::describe(surface::SurfaceMesher /*mesher*/) const
{
  return with_occ_errors(file_name_, [&] { return describe_shape(content_); });
}

void CadModel::locate_parameters(mesh::CoarseMesh& mesh) const
{
  with_occ_errors(file_name_, [&] {
    locate_face_corners(mesh);
    locate_segment_ends(mesh);
  });
}

model::SurfacePoint CadModel::project_to_surface(LocalIndex surface, const Vec3& point,
                                                 const model::SurfaceParameters& guess) const
{
  return with_occ_errors(fmt::format("projection onto face {}", surface),
                         [&] { return surface_at(surface).project(point, guess); });
}

model::CurvePoint CadModel::project_to_curve(LocalIndex curve, const Vec3& point,
                                             double guess) const
{
  return with_occ_errors(fmt::format("projection onto edge {}", curve),
                         [&] { return curve_at(curve).project(point, guess); });
}

std::string CadModel::solid_name(LocalIndex material) const
{
  const std::string& name = content_.solid_names.at(at(material - 1));
  return name.empty() ? mesh::default_material_name(content_.solid_body.at(at(material - 1)))
                      : name;
}

surface::CoarseSurface CadModel::mesh_whole(const surface::CoarseOptions& options) const
{
  return with_occ_errors(file_name_, [&] {
    return has_inner_parts(content_.shape) ? mesh_cells(options) : mesh_solids(options);
  });
}

// What lies inside of a solid is on the sides of cells, of which the mesh knows no more.
surface::CoarseSurface CadModel::mesh_cells(const surface::CoarseOptions& options) const
{
  const CellNumbers numbers(cells_of(content_.shape));
  surface::CoarseOptions kept = options;
  for (LocalIndex curve = 0; curve < edges_.Extent(); ++curve) {
    if (is_line(curve)) kept.kept.curves.push_back(curve);
  }
  const surface::CoarseOptions of_cells = numbers.options_from(std::move(kept));
  numbers.require_images(of_cells);
  const CadModel cells(numbers.content_from(content_), file_name_);
  surface::CoarseSurface surface = cells.mesh_solids(of_cells);
  numbers.number_as_model(content_.face_names, surface);
  require_whole_lines(surface.mesh);
  return surface;
}

// That segments lead along each line, from one end to the other.
void CadModel::require_whole_lines(const mesh::CoarseMesh& mesh) const
{
  std::map<LocalIndex, std::set<std::array<LocalIndex, 2>>> segments;
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const LocalIndex a = mesh.segment_vertices[2 * at(s)];
    const LocalIndex b = mesh.segment_vertices[2 * at(s) + 1];
    segments[mesh.segment_curve[at(s)]].insert({std::min(a, b), std::max(a, b)});
  }
  for (LocalIndex curve = num_edges_of_faces_; curve < edges_.Extent(); ++curve) {
    std::map<LocalIndex, int> num_at;
    for (const auto& ends : segments[curve]) {
      for (const LocalIndex v : ends) ++num_at[v];
    }
    const auto num_ends = std::ranges::count(num_at, 1, [](const auto& one) { return one.second; });
    const BRepAdaptor_Curve line(TopoDS::Edge(edges_(curve + 1)));
    const gp_Pnt first = line.Value(line.FirstParameter());
    const auto has_end = [&](const gp_Pnt& end) {
      return std::ranges::any_of(num_at, [&](const auto& one) {
        const Vec3 p = mesh.position(one.first);
        return end.Distance({p[0], p[1], p[2]}) <= curve_at(curve).end_tolerance(p);
      });
    };
    const bool is_closed = BRep_Tool::IsClosed(edges_(curve + 1));
    if (num_ends == (is_closed ? 0 : 2) && has_end(first)
        && has_end(line.Value(line.LastParameter())))
      continue;
    throw NetgenError(
        fmt::format("{}: the coarse mesh has not all of the line that begins at ({:g}, {:g}, {:g})",
                    file_name_, first.X(), first.Y(), first.Z()));
  }
}

// OpenCASCADE's triangles, made well-shaped and put on the faces.
surface::CoarseSurface CadModel::mesh_solids(const surface::CoarseOptions& options) const
{
  const surface::SurfaceReference reference(tessellation_of(content_.shape, options.max_size));
  // Solids that overlap were cut, if they could be. So where two cut each other now, they touch
  // or nearly do, as a ball and its race, and chords of one lie in the other.
  const auto forbidden =
      content_.may_overlap ? surface::Forbidden::all_cuts : surface::Forbidden::cuts_within_bodies;
  surface::RemeshedSurface remeshed =
      surface::remesh_on_geometry(reference, *this, options, forbidden);
  const surface::PatchSurface& surface = remeshed.surface;
  const geometry::SurfaceNames names{
      [this](LocalIndex patch) { return content_.face_names.at(static_cast<std::size_t>(patch)); },
      [this](LocalIndex material) { return solid_name(material); }};
  geometry::require_no_overlaps(surface::forbidden_overlaps(surface, forbidden), surface, names,
                                file_name_);
  surface::CoarseSurface coarse = geometry::to_coarse_surface(surface, options.max_size, names);
  coarse.defeatured = std::move(remeshed.defeatured);
  add_parameters(reference, coarse.mesh);
  coarse.mesh.material_row = material_rows();
  return coarse;
}

// Empty if each solid is a body.
FlatArray<LocalIndex> CadModel::material_rows() const
{
  FlatArray<LocalIndex> rows;
  bool are_several = false;
  for (std::size_t s = 0; s < content_.solid_body.size(); ++s) {
    rows.push_back(content_.solid_body[s] - 1);
    are_several = are_several || at(rows.back()) != s;
  }
  return are_several ? rows : FlatArray<LocalIndex>{};
}

// Of triangles, for they are estimates. OpenCASCADE's integrals over the surfaces took a sixth of a
// run of 300,000 tets (linkrods).
coarse::ModelFigures CadModel::figures() const
{
  return with_occ_errors(file_name_, [&] {
    const RoughFigures rough =
        content_.figures ? *content_.figures : rough_figures_of(content_.shape, box_diagonal_);
    return coarse::ModelFigures{
        .num_faces = faces_.Extent(), .area = rough.area, .volume = rough.volume};
  });
}

coarse::CadSurface CadModel::triangles_for_fit(double size) const
{
  return with_occ_errors(file_name_, [&] {
    coarse::CadSurface cad{.triangles = tessellation_of(content_.shape, size),
                           .size = size,
                           .patch_names = content_.face_names,
                           .solid_names = content_.solid_names};
    for (LocalIndex p = 0; p < faces_.Extent(); ++p) cad.patch_surface.push_back(p);
    for (LocalIndex c = 0; c < edges_.Extent(); ++c) cad.curve_number.push_back(c);
    return cad;
  });
}

// In the oldest version of the format, which every program reads.
void CadModel::write_brep(const std::filesystem::path& file) const
{
  const bool is_written = BRepTools::Write(content_.shape, file.c_str(), Standard_False,
                                           Standard_False, TopTools_FormatVersion_VERSION_1);
  if (!is_written) throw OutputError(file.string() + ": cannot be written");
}

void CadModel::add_parameters(const surface::SurfaceReference& reference,
                              mesh::CoarseMesh& mesh) const
{
  guess_parameters(reference, mesh);
  locate_face_corners(mesh);
  locate_segment_ends(mesh);
}

// Those of the tessellation, a little inside each face and segment: at a seam that is their side.
void CadModel::guess_parameters(const surface::SurfaceReference& reference, mesh::CoarseMesh& mesh)
{
  constexpr double kInside = 0.1;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const auto corners = corners_at<3>(mesh.vertex_xyz, mesh.face_vertices, f);
    const Vec3 middle = middle_of(corners);
    const LocalIndex surface = mesh.patch_surface[at(mesh.face_patch[at(f)])];
    for (const Vec3& corner : corners) {
      const auto uv = reference.parameters(surface, corner + kInside * (middle - corner));
      mesh.face_uv.insert(mesh.face_uv.end(), uv.begin(), uv.end());
    }
  }
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const Vec3 a = mesh.position(mesh.segment_vertices[2 * at(s)]);
    const Vec3 b = mesh.position(mesh.segment_vertices[2 * at(s) + 1]);
    const LocalIndex curve = mesh.segment_curve[at(s)];
    mesh.segment_t.push_back(reference.curve_parameter(curve, a + kInside * (b - a)));
    mesh.segment_t.push_back(reference.curve_parameter(curve, b + kInside * (a - b)));
  }
}

// What NETGEN has at a corner is only a guess: its optimiser moves points and forgets parameters.
void CadModel::locate_face_corners(mesh::CoarseMesh& mesh) const
{
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    const LocalIndex patch = mesh.face_patch[at];
    if (patch == kNoIndex) continue;  // Of a cut.
    const auto corners = corners_at<3>(mesh.vertex_xyz, mesh.face_vertices, f);
    std::array<model::SurfaceParameters, 3> guesses{};
    for (std::size_t c = 0; c < 3; ++c) {
      guesses[c] = {mesh.face_uv[2 * (3 * at + c)], mesh.face_uv[2 * (3 * at + c) + 1]};
    }
    const LocalIndex surface = mesh.patch_surface[static_cast<std::size_t>(patch)];
    const auto uv = surface_at(surface).triangle_parameters(corners, guesses);
    for (std::size_t c = 0; c < 3; ++c) {
      mesh.face_uv[2 * (3 * at + c)] = uv[c][0];
      mesh.face_uv[2 * (3 * at + c) + 1] = uv[c][1];
    }
  }
}

// The guess at an end of a closed curve says which of its two parameters is meant.
void CadModel::locate_segment_ends(mesh::CoarseMesh& mesh) const
{
  for (std::size_t end = 0; end < mesh.segment_t.size(); ++end) {
    if (mesh.segment_curve[end / 2] == kNoIndex) continue;  // Bounds a cut.
    const OccCurve& curve = curve_at(mesh.segment_curve[end / 2]);
    const Vec3 point = mesh.position(mesh.segment_vertices[end]);
    mesh.segment_t[end] = curve.locate(point, mesh.segment_t[end]).t;
  }
}

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <vector>

#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <fmt/format.h>
#include <mystdlib.h>
#include <occgeom.hpp>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/surface/on_geometry.hpp"

#include "netgen/loaded_model.hpp"
#include "netgen/mesh_conversion.hpp"
#include "netgen/netgen_session.hpp"
#include "netgen/netgen_versions.hpp"
#include "netgen/occ_cad_file.hpp"
#include "netgen/occ_content.hpp"
#include "netgen/occ_curve.hpp"
#include "netgen/occ_cut.hpp"
#include "netgen/occ_description.hpp"
#include "netgen/occ_error.hpp"
#include "netgen/occ_shape.hpp"
#include "netgen/occ_steps.hpp"
#include "netgen/occ_surface.hpp"
#include "netgen/occ_tessellation.hpp"
#include "netgen/occ_triangulation.hpp"
#include "netgen/volume_mesher.hpp"

namespace tessera::netgen {
namespace {

// Degenerate edges have no curve; their places stay empty so that numbers are those of the map.
using OptionalCurve = std::unique_ptr<OccCurve>;

class OccModel final : public LoadedModel {
 public:
  OccModel(OccContent content, std::string file_name);

  [[nodiscard]] bool has_parameters() const override { return true; }
  [[nodiscard]] double surface_tolerance(LocalIndex surface) const override
  {
    return surface_at(surface).tolerance();
  }
  [[nodiscard]] double curve_tolerance(LocalIndex curve) const override
  {
    return curve_at(curve).tolerance();
  }
  [[nodiscard]] double end_tolerance(LocalIndex curve, const Vec3& point) const override
  {
    return curve_at(curve).end_tolerance(point);
  }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override;
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override;
  [[nodiscard]] double box_diagonal() const override { return box_diagonal_; }
  [[nodiscard]] model::ModelDescription describe(surface::SurfaceMesher /*mesher*/) const override
  {
    return with_occ_errors(file_name_, [&] { return describe_shape(content_); });
  }
  [[nodiscard]] mesh::NamedCurve named_curve(LocalIndex curve) const override
  {
    return {curve, std::to_string(curve + 1), content_.edge_names.at(at(curve))};
  }
  [[nodiscard]] coarse::ModelFigures figures() const override;
  [[nodiscard]] coarse::CadSurface triangles_for_fit(double size) const override;
  void write_brep(const std::filesystem::path& file) const override;
  void add_parameters(const surface::SurfaceReference& reference,
                      mesh::CoarseMesh& mesh) const override;
  void locate_parameters(mesh::CoarseMesh& mesh) const override
  {
    with_occ_errors(file_name_, [&] {
      locate_face_corners(mesh);
      locate_segment_ends(mesh);
    });
  }
  using LoadedModel::mesh_surface;
  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const NetgenSurfaceUser& use) const override;
  [[nodiscard]] surface::CoarseSurface mesh_parts(const surface::CoarseOptions& options,
                                                  const cut::CutTree& tree) const override;

 private:
  [[nodiscard]] const OccSurface& surface_at(LocalIndex surface) const;
  [[nodiscard]] const OccCurve& curve_at(LocalIndex curve) const;
  [[nodiscard]] GeometryNumbers numbers_for(const ::netgen::OCCGeometry& geometry) const;
  [[nodiscard]] GeometryNumbers numbers_of_parts(const ::netgen::OCCGeometry& geometry,
                                                 const CutShape& cut) const;
  [[nodiscard]] std::string solid_name(LocalIndex material) const;
  [[nodiscard]] surface::CoarseSurface remesh(const surface::SurfaceReference& reference,
                                              const surface::CoarseOptions& options) const;
  static void guess_parameters(const surface::SurfaceReference& reference, mesh::CoarseMesh& mesh);
  static void triangulate_for_sizes(const TopoDS_Shape& shape);
  static std::shared_ptr<::netgen::Mesh> mesh_geometry(::netgen::OCCGeometry& geometry,
                                                       NetgenSession& session);
  void locate_face_corners(mesh::CoarseMesh& mesh) const;
  void locate_segment_ends(mesh::CoarseMesh& mesh) const;

  OccContent content_;
  std::string file_name_;
  double box_diagonal_ = 0.0;
  TopTools_IndexedMapOfShape faces_{};
  TopTools_IndexedMapOfShape edges_{};
  std::vector<OccSurface> surfaces_{};
  std::vector<OptionalCurve> curves_{};
};

OccModel::OccModel(OccContent content, std::string file_name)
    : content_(std::move(content)),
      file_name_(std::move(file_name)),
      box_diagonal_(box_diagonal_of(content_.shape))
{
  TopExp::MapShapes(content_.shape, TopAbs_FACE, faces_);
  TopExp::MapShapes(content_.shape, TopAbs_EDGE, edges_);
  for (const TopoDS_Shape& face : parts_of(content_.shape, TopAbs_FACE)) {
    surfaces_.emplace_back(TopoDS::Face(face), box_diagonal_, faces_.Extent());
  }
  for (const TopoDS_Shape& shape : parts_of(content_.shape, TopAbs_EDGE)) {
    const TopoDS_Edge& edge = TopoDS::Edge(shape);
    curves_.push_back(
        BRep_Tool::Degenerated(edge) ? nullptr : std::make_unique<OccCurve>(edge, box_diagonal_));
  }
}

const OccSurface& OccModel::surface_at(LocalIndex surface) const
{
  return surfaces_.at(static_cast<std::size_t>(surface));
}

const OccCurve& OccModel::curve_at(LocalIndex curve) const
{
  const OptionalCurve& found = curves_.at(static_cast<std::size_t>(curve));
  if (found == nullptr) throw GeometryError(fmt::format("edge {} is a point", curve));
  return *found;
}

model::SurfacePoint OccModel::project_to_surface(LocalIndex surface, const Vec3& point,
                                                 const model::SurfaceParameters& guess) const
{
  return with_occ_errors(fmt::format("projection onto face {}", surface),
                         [&] { return surface_at(surface).project(point, guess); });
}

model::CurvePoint OccModel::project_to_curve(LocalIndex curve, const Vec3& point,
                                             double guess) const
{
  return with_occ_errors(fmt::format("projection onto edge {}", curve),
                         [&] { return curve_at(curve).project(point, guess); });
}

// NETGEN makes a triangulation where there is none, and then reads it unchecked. So it is made
// here, anew for each call, so that every call starts from the same state. NETGEN takes sizes from
// the curvature at its triangles, and does not mind if they leave something out.
void OccModel::triangulate_for_sizes(const TopoDS_Shape& shape)
{
  IMeshTools_Parameters parameters;
  parameters.Deflection = 0.01;  // Of an edge's length; what NETGEN takes.
  parameters.Relative = Standard_True;
  const std::vector<TopoDS_Shape> faces = parts_of(shape, TopAbs_FACE);
  for (const int face : triangulate_faces(shape, parameters)) {
    if (is_left_out(Repair::sampled_face)) continue;
    sample_face(faces[at(face)]);
    note_repair(Repair::sampled_face);
  }
}

std::string OccModel::solid_name(LocalIndex material) const
{
  const auto at = static_cast<std::size_t>(material - 1);
  return at < content_.solid_names.size() ? content_.solid_names[at] : std::string();
}

GeometryNumbers OccModel::numbers_for(const ::netgen::OCCGeometry& geometry) const
{
  GeometryNumbers numbers;
  numbers.surface = [&](const ::netgen::FaceDescriptor& face) {
    return faces_.FindIndex(geometry.fmap(face.SurfNr())) - 1;
  };
  numbers.patch_name = [this, surface = numbers.surface](const ::netgen::FaceDescriptor& face) {
    return content_.face_names.at(static_cast<std::size_t>(surface(face)));
  };
  numbers.curve = [&](const ::netgen::Segment& segment) {
    return edges_.FindIndex(geometry.emap(edge_number(segment))) - 1;
  };
  numbers.material_name = [this](int domain) { return solid_name(domain); };
  numbers.uv = [](const ::netgen::Element2d& element, int corner) {
    const ::netgen::PointGeomInfo& info = element.GeomInfoPi(corner + 1);
    return model::SurfaceParameters{info.u, info.v};
  };
  numbers.t = [&](const ::netgen::Segment& segment, int end) {
    return edge_parameter(geometry, segment, end);
  };
  return numbers;
}

// Of a mesh of the parts, in the numbers of the uncut model.
GeometryNumbers OccModel::numbers_of_parts(const ::netgen::OCCGeometry& geometry,
                                           const CutShape& cut) const
{
  GeometryNumbers numbers = numbers_for(geometry);
  numbers.material = [&](int domain) { return cut.solid.at(at(domain - 1)) + 1; };
  numbers.part = [&](int domain) { return cut.part.at(at(domain - 1)); };
  numbers.surface = [&](const ::netgen::FaceDescriptor& face) {
    const LocalIndex number = CutShape::number_in(cut.faces, geometry.fmap(face.SurfNr()));
    if (number == kNoIndex) throw NetgenError("a cut lies on the surface");
    return number;
  };
  numbers.patch = [surface = numbers.surface](const ::netgen::FaceDescriptor& face) {
    return PatchKey{surface(face)};
  };
  numbers.patch_name = [this, surface = numbers.surface](const ::netgen::FaceDescriptor& face) {
    return content_.face_names.at(static_cast<std::size_t>(surface(face)));
  };
  numbers.curve = [&](const ::netgen::Segment& segment) {
    return CutShape::number_in(cut.edges, geometry.emap(edge_number(segment)));
  };
  return numbers;
}

// OpenCASCADE's triangles, made well-shaped and put on the faces.
surface::CoarseSurface OccModel::remesh(const surface::SurfaceReference& reference,
                                        const surface::CoarseOptions& options) const
{
  // Solids that overlap were cut, if they could be. So where two cut each other now, they touch or
  // nearly do, as a ball and its race, and chords of one lie in the other.
  const auto forbidden =
      content_.may_overlap ? surface::Forbidden::all_cuts : surface::Forbidden::cuts_within_bodies;
  surface::RemeshedSurface remeshed =
      surface::remesh_on_geometry(reference, *this, options, forbidden);
  const surface::PatchSurface& surface = remeshed.surface;
  const SurfaceNames names{
      [this](LocalIndex patch) { return content_.face_names.at(static_cast<std::size_t>(patch)); },
      [this](LocalIndex material) { return solid_name(material); }};
  require_no_overlaps(surface::forbidden_overlaps(surface, forbidden), surface, names, file_name_);
  surface::CoarseSurface coarse = to_coarse_surface(surface, options.max_size, names);
  coarse.defeatured = std::move(remeshed.defeatured);
  add_parameters(reference, coarse.mesh);
  return coarse;
}

coarse::ModelFigures OccModel::figures() const
{
  return with_occ_errors(file_name_, [&] {
    GProp_GProps surface;
    GProp_GProps solids;
    BRepGProp::SurfaceProperties(content_.shape, surface);
    BRepGProp::VolumeProperties(content_.shape, solids);
    return coarse::ModelFigures{
        .num_faces = faces_.Extent(), .area = surface.Mass(), .volume = solids.Mass()};
  });
}

coarse::CadSurface OccModel::triangles_for_fit(double size) const
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
void OccModel::write_brep(const std::filesystem::path& file) const
{
  const bool is_written = BRepTools::Write(content_.shape, file.c_str(), Standard_False,
                                           Standard_False, TopTools_FormatVersion_VERSION_1);
  if (!is_written) throw OutputError(file.string() + ": cannot be written");
}

void OccModel::add_parameters(const surface::SurfaceReference& reference,
                              mesh::CoarseMesh& mesh) const
{
  guess_parameters(reference, mesh);
  locate_face_corners(mesh);
  locate_segment_ends(mesh);
}

// Those of the tessellation, a little inside each face and segment: at a seam that is their side.
void OccModel::guess_parameters(const surface::SurfaceReference& reference, mesh::CoarseMesh& mesh)
{
  constexpr double kInside = 0.1;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    const Vec3 middle =
        (1.0 / 3.0) * (mesh.position(v[0]) + mesh.position(v[1]) + mesh.position(v[2]));
    const LocalIndex surface = mesh.patch_surface[at(mesh.face_patch[at(f)])];
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 corner = mesh.position(v[c]);
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

surface::CoarseSurface OccModel::mesh_surface(const surface::CoarseOptions& options,
                                              const NetgenSurfaceUser& use) const
{
  if (options.surface_mesher == surface::SurfaceMesher::remesh) {
    return with_occ_errors(file_name_, [&] {
      const surface::SurfaceReference reference(tessellation_of(content_.shape, options.max_size));
      return remesh(reference, options);
    });
  }
  NetgenSession session(coarse_parameters(options));
  return session.run("coarse mesh of " + file_name_, [&] {
    OccGeometry geometry;
    geometry.shape = content_.shape;
    triangulate_for_sizes(geometry.shape);
    const auto mesh = mesh_geometry(geometry, session);
    surface::CoarseSurface coarse =
        to_coarse_surface(*mesh, numbers_for(geometry), options.max_size, file_name_);
    locate_face_corners(coarse.mesh);
    locate_segment_ends(coarse.mesh);
    use(geometry, *mesh, 1.0, coarse);
    return coarse;
  });
}

// Its shape is triangulated.
std::shared_ptr<::netgen::Mesh> OccModel::mesh_geometry(::netgen::OCCGeometry& geometry,
                                                        NetgenSession& session)
{
  geometry.changed = 1;
  geometry.BuildFMap();
  geometry.CalcBoundingBox();
  std::shared_ptr<::netgen::Mesh> mesh;
  session.run_surface([&] { mesh = mesh_occ_surface(geometry, session.parameters()); });
  if (mesh == nullptr) throw NetgenError("NETGEN gave up: " + session.words());
  return mesh;
}

surface::CoarseSurface OccModel::mesh_parts(const surface::CoarseOptions& options,
                                            const cut::CutTree& tree) const
{
  NetgenSession session(coarse_parameters(options));
  return session.run("coarse mesh of the parts of " + file_name_, [&] {
    const CutShape cut = cut_shape(content_.shape, tree);
    OccGeometry geometry;
    geometry.shape = cut.shape;
    triangulate_for_sizes(geometry.shape);
    const auto mesh = mesh_geometry(geometry, session);
    surface::CoarseSurface coarse =
        to_coarse_surface(*mesh, numbers_of_parts(geometry, cut), options.max_size, file_name_);
    locate_face_corners(coarse.mesh);
    locate_segment_ends(coarse.mesh);
    return coarse;
  });
}

// What NETGEN has at a corner is only a guess: its optimiser moves points and forgets parameters.
void OccModel::locate_face_corners(mesh::CoarseMesh& mesh) const
{
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const auto at = static_cast<std::size_t>(f);
    const LocalIndex patch = mesh.face_patch[at];
    if (patch == kNoIndex) continue;  // Of a cut.
    std::array<Vec3, 3> corners{};
    std::array<model::SurfaceParameters, 3> guesses{};
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = mesh.position(mesh.face_vertices[3 * at + c]);
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
void OccModel::locate_segment_ends(mesh::CoarseMesh& mesh) const
{
  for (std::size_t end = 0; end < mesh.segment_t.size(); ++end) {
    if (mesh.segment_curve[end / 2] == kNoIndex) continue;  // Bounds a cut.
    const OccCurve& curve = curve_at(mesh.segment_curve[end / 2]);
    const Vec3 point = mesh.position(mesh.segment_vertices[end]);
    mesh.segment_t[end] = curve.locate(point, mesh.segment_t[end]).t;
  }
}

}  // namespace

model::ModelSource import_occ(const std::filesystem::path& file,
                              const model::ImportOptions& options, StepReader reader)
{
  return closed_source(read_cad_file(file, reader), file.string(), options.assembly);
}

std::unique_ptr<LoadedModel> load_occ(const model::ModelSource& source)
{
  return with_occ_errors(source.file_name, [&]() -> std::unique_ptr<LoadedModel> {
    return std::make_unique<OccModel>(read_occ_content(source.content), source.file_name);
  });
}

}  // namespace tessera::netgen

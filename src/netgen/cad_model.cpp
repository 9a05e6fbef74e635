// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <TopoDS.hxx>
#include <mystdlib.h>
#include <occgeom.hpp>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"

#include "cad/cad_file.hpp"
#include "cad/content.hpp"
#include "cad/cut.hpp"
#include "cad/error.hpp"
#include "cad/model.hpp"
#include "cad/shape.hpp"
#include "cad/triangles/triangulation.hpp"
#include "netgen/loaders.hpp"
#include "netgen/mesh_conversion.hpp"
#include "netgen/model_mesher.hpp"
#include "netgen/session.hpp"
#include "netgen/surface/cad_steps.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

// A CAD model that NETGEN can mesh as well, and cut by planes.
class NetgenCadModel final : public NetgenModel<cad::CadModel> {
 public:
  using NetgenModel::NetgenModel;

  using NetgenModel::mesh_whole;
  [[nodiscard]] surface::CoarseSurface mesh_whole(const surface::CoarseOptions& options,
                                                  const NetgenSurfaceUser& use) const override;
  [[nodiscard]] surface::CoarseSurface mesh_parts(const surface::CoarseOptions& options,
                                                  const cut::CutTree& tree) const override;

 private:
  [[nodiscard]] GeometryNumbers numbers_for(const ::netgen::OCCGeometry& geometry) const;
  [[nodiscard]] GeometryNumbers numbers_of_parts(const ::netgen::OCCGeometry& geometry,
                                                 const cad::CutShape& cut) const;
  static void triangulate_for_sizes(const TopoDS_Shape& shape);
  static std::shared_ptr<::netgen::Mesh> mesh_geometry(::netgen::OCCGeometry& geometry,
                                                       NetgenSession& session);
};

// NETGEN makes a triangulation where there is none, and then reads it unchecked. So it is made
// here, anew for each call, so that every call starts from the same state. NETGEN takes sizes from
// the curvature at its triangles, and does not mind if they leave something out.
void NetgenCadModel::triangulate_for_sizes(const TopoDS_Shape& shape)
{
  IMeshTools_Parameters parameters;
  parameters.Deflection = 0.01;  // Of an edge's length; what NETGEN takes.
  parameters.Relative = Standard_True;
  const std::vector<TopoDS_Shape> faces = cad::parts_of(shape, TopAbs_FACE);
  for (const int face : cad::triangulate_faces(shape, parameters)) {
    if (is_left_out(Repair::sampled_face)) continue;
    cad::sample_face(faces[at(face)]);
    note_repair(Repair::sampled_face);
  }
}

GeometryNumbers NetgenCadModel::numbers_for(const ::netgen::OCCGeometry& geometry) const
{
  GeometryNumbers numbers;
  numbers.surface = [&](const ::netgen::FaceDescriptor& face) {
    return faces().FindIndex(geometry.fmap(face.SurfNr())) - 1;
  };
  numbers.patch_name = [this, surface = numbers.surface](const ::netgen::FaceDescriptor& face) {
    return content().face_names.at(static_cast<std::size_t>(surface(face)));
  };
  numbers.curve = [&](const ::netgen::Segment& segment) {
    return edges().FindIndex(geometry.emap(edge_number(segment))) - 1;
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
GeometryNumbers NetgenCadModel::numbers_of_parts(const ::netgen::OCCGeometry& geometry,
                                                 const cad::CutShape& cut) const
{
  GeometryNumbers numbers = numbers_for(geometry);
  numbers.material = [&](int domain) { return cut.solid.at(at(domain - 1)) + 1; };
  numbers.part = [&](int domain) { return cut.part.at(at(domain - 1)); };
  numbers.surface = [&](const ::netgen::FaceDescriptor& face) {
    const LocalIndex number = cad::CutShape::number_in(cut.faces, geometry.fmap(face.SurfNr()));
    if (number == kNoIndex) throw NetgenError("a cut lies on the surface");
    return number;
  };
  numbers.patch = [surface = numbers.surface](const ::netgen::FaceDescriptor& face) {
    return PatchKey{surface(face)};
  };
  numbers.patch_name = [this, surface = numbers.surface](const ::netgen::FaceDescriptor& face) {
    return content().face_names.at(static_cast<std::size_t>(surface(face)));
  };
  numbers.curve = [&](const ::netgen::Segment& segment) {
    return cad::CutShape::number_in(cut.edges, geometry.emap(edge_number(segment)));
  };
  return numbers;
}

surface::CoarseSurface NetgenCadModel::mesh_whole(const surface::CoarseOptions& options,
                                                  const NetgenSurfaceUser& use) const
{
  if (options.surface_mesher == surface::SurfaceMesher::remesh)
    return CadModel::mesh_whole(options);
  NetgenSession session(coarse_parameters(options));
  return session.run("coarse mesh of " + file_name(), [&] {
    OccGeometry geometry;
    geometry.shape = content().shape;
    triangulate_for_sizes(geometry.shape);
    const auto mesh = mesh_geometry(geometry, session);
    surface::CoarseSurface coarse =
        to_coarse_surface(*mesh, numbers_for(geometry), options.max_size, file_name());
    locate_face_corners(coarse.mesh);
    locate_segment_ends(coarse.mesh);
    use(geometry, *mesh, 1.0, coarse);
    return coarse;
  });
}

// Its shape is triangulated.
std::shared_ptr<::netgen::Mesh> NetgenCadModel::mesh_geometry(::netgen::OCCGeometry& geometry,
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

surface::CoarseSurface NetgenCadModel::mesh_parts(const surface::CoarseOptions& options,
                                                  const cut::CutTree& tree) const
{
  NetgenSession session(coarse_parameters(options));
  return session.run("coarse mesh of the parts of " + file_name(), [&] {
    const cad::CutShape cut = cad::cut_shape(content().shape, tree);
    OccGeometry geometry;
    geometry.shape = cut.shape;
    triangulate_for_sizes(geometry.shape);
    const auto mesh = mesh_geometry(geometry, session);
    surface::CoarseSurface coarse =
        to_coarse_surface(*mesh, numbers_of_parts(geometry, cut), options.max_size, file_name());
    locate_face_corners(coarse.mesh);
    locate_segment_ends(coarse.mesh);
    return coarse;
  });
}

}  // namespace

model::ModelSource import_cad(const std::filesystem::path& file,
                              const model::ImportOptions& options, model::StepReader reader)
{
  return cad::closed_source(cad::read_cad_file(file, reader), file.string(), options.assembly);
}

std::unique_ptr<geometry::LoadedModel> load_cad(const model::ModelSource& source)
{
  return cad::with_occ_errors(source.file_name, [&]() -> std::unique_ptr<geometry::LoadedModel> {
    return std::make_unique<NetgenCadModel>(cad::read_occ_content(source.content),
                                            source.file_name);
  });
}

}  // namespace tessera::netgen

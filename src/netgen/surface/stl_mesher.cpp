// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/surface/stl_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <mystdlib.h>
#include <stlgeom.hpp>

#include "tessera/base/error.hpp"

#include "netgen/mesh_conversion.hpp"
#include "netgen/session.hpp"
#include "netgen/surface/size_file.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

// Sets NETGEN's global STL parameters, and puts the old ones back at its end.
//
// Unlike with NETGEN's defaults the size follows the curvature, with 2 elements a radius. On four
// parts midpoints of edges are then off the surface by at most 0.06-0.10 of the edge instead of
// 0.11-0.20, so refined skins fold less. Minimum dihedral angles rise on free-form parts (10.2 to
// 12.7, 13.4 to 14.8, 2.4 to 5.7 degrees) and fall on a machined one (23.0 to 17.3). Other
// restrictions of the size and more optimisation steps gave no clear gain.
class StlParameters {
 public:
  explicit StlParameters(const surface::CoarseOptions& options)
  {
    ::netgen::stldoctor.geom_tol_fact = kPointTolerance;
    ::netgen::stlparam.resthsurfcurvenable = 1;
    ::netgen::stlparam.resthsurfcurvfac = options.curvature;
  }
  ~StlParameters()
  {
    ::netgen::stlparam = saved_parameters_;
    ::netgen::stldoctor = saved_doctor_;
  }
  StlParameters(const StlParameters&) = delete;
  StlParameters& operator=(const StlParameters&) = delete;

 private:
  // Of the box: our vertices are welded already, and NETGEN must not join any more of them.
  static constexpr double kPointTolerance = 1e-14;

  ::netgen::STLParameters saved_parameters_ = ::netgen::stlparam;
  ::netgen::STLDoctorParams saved_doctor_ = ::netgen::stldoctor;
};

class StlMeshing {
 public:
  StlMeshing(const model::TriangleSurface& surface, const model::SurfaceFeatures& features,
             const surface::CoarseOptions& options, const std::string& name)
      : surface_(surface),
        features_(features),
        name_(name),
        max_size_(options.max_size),
        scale_(scale_for_netgen(model::box_diagonal(surface))),
        stl_parameters_(options),
        size_file_(options.points.scaled(scale_)),
        session_(parameters(options))
  {
  }

  surface::CoarseSurface run(const NetgenSurfaceUser& use)
  {
    session_.run(name_ + ": loading into NETGEN", [&] { give_triangles(); });
    give_feature_edges();
    session_.run(name_ + ": coarse mesh", [&] {
      mesh_up_to(::netgen::MESHCONST_ANALYSE, ::netgen::MESHCONST_MESHEDGES);
      give_domains();
      mesh_up_to(::netgen::MESHCONST_MESHSURFACE, ::netgen::MESHCONST_OPTSURFACE);
    });
    if (geometry_.surfacemeshed == 0) {
      throw NetgenError(fmt::format("{}: NETGEN gave up on the coarse surface mesh{}", name_,
                                    session_.words().empty() ? "" : ": " + session_.words()));
    }
    take_own_numbers();
    surface::CoarseSurface surface = to_coarse_surface(*mesh_, numbers(), max_size_, name_);
    for (double& x : surface.mesh.vertex_xyz) x /= scale_;
    session_.run(name_, [&] { use(geometry_, *mesh_, scale_, surface); });
    return surface;
  }

 private:
  [[nodiscard]] ::netgen::MeshingParameters parameters(surface::CoarseOptions options) const
  {
    options.max_size *= scale_;
    options.points = {};
    ::netgen::MeshingParameters result = coarse_parameters(options);
    result.meshsizefilename = size_file_.path();
    return result;
  }

  void give_triangles()
  {
    const std::vector<Vec3> normals = model::triangle_normals(surface_);
    NetgenArray<::netgen::STLReadTriangle> triangles;
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      ::netgen::Point<3> corners[3];
      for (int c = 0; c < 3; ++c) {
        const Vec3 p = scale_ * surface_.corners(t)[static_cast<std::size_t>(c)];
        corners[c] = ::netgen::Point<3>(p[0], p[1], p[2]);
      }
      const Vec3& n = normals[at(t)];
      triangles.Append(stl_triangle(corners, ::netgen::Vec<3>(n[0], n[1], n[2])));
    }
    geometry_.InitSTLGeometry(triangles);
    if (geometry_.GetNT() != surface_.num_triangles()
        || geometry_.GetNP() != surface_.num_vertices()) {
      throw NetgenError(name_ + ": NETGEN refuses some triangles");
    }
    if (!geometry_.Topology_Ok() || !geometry_.Orientation_Ok()) {
      throw NetgenError(name_ + ": NETGEN sees no closed surface");
    }
  }

  // A confirmed or excluded edge keeps its status whatever its angle.
  void give_feature_edges()
  {
    std::vector<LocalIndex> our_vertex(at(surface_.num_vertices()) + 1);
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      for (int c = 0; c < 3; ++c) {
        our_vertex[at(geometry_.GetTriangle(t + 1)[c])] =
            surface_.triangle_vertices[3 * at(t) + static_cast<std::size_t>(c)];
      }
    }
    for (int e = 1; e <= geometry_.GetNTE(); ++e) {
      ::netgen::STLTopEdge& edge = geometry_.GetTopEdge(e);
      const LocalIndex curve =
          features_.curve_of_edge(our_vertex[at(edge[0])], our_vertex[at(edge[1])]);
      edge.SetStatus(curve == kNoIndex ? ::netgen::ED_EXCLUDED : ::netgen::ED_CONFIRMED);
    }
    our_vertex_ = std::move(our_vertex);
  }

  void mesh_up_to(int first_step, int last_step)
  {
    auto& parameters = session_.parameters();
    parameters.perfstepsstart = first_step;
    parameters.perfstepsend = last_step;
    session_.run_surface([&] { mesh_stl(geometry_, mesh_, parameters); });
  }

  // NETGEN has one descriptor a face, all of domain 1.
  void give_domains()
  {
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      const int face = geometry_.GetTriangle(t + 1).GetFaceNum();
      mesh_->GetFaceDescriptor(face).SetDomainIn(surface_.triangle_material[at(t)]);
    }
  }

  // A face of NETGEN's is all of a patch or a part of it: it keeps to our feature edges.
  void take_own_numbers()
  {
    std::vector<LocalIndex> patch_of_face(at(geometry_.GetNOFaces()) + 1);
    std::vector<LocalIndex> material_of_patch(at(features_.num_patches()));
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      const LocalIndex patch = features_.triangle_patch[at(t)];
      patch_of_face[at(geometry_.GetTriangle(t + 1).GetFaceNum())] = patch;
      material_of_patch[at(patch)] = surface_.triangle_material[at(t)];
    }
    for (auto& element : mesh_->SurfaceElements()) {
      element.SetIndex(patch_of_face[at(element.GetIndex())] + 1);
    }
    mesh_->ClearFaceDescriptors();
    for (LocalIndex p = 0; p < features_.num_patches(); ++p) {
      mesh_->AddFaceDescriptor(::netgen::FaceDescriptor(p + 1, material_of_patch[at(p)], 0, 0));
    }
  }

  GeometryNumbers numbers()
  {
    const auto patch = [](const ::netgen::FaceDescriptor& face) { return face.SurfNr() - 1; };
    GeometryNumbers numbers;
    numbers.surface = patch;
    numbers.patch_name = [this, patch](const ::netgen::FaceDescriptor& face) {
      return features_.patch_names[at(patch(face))];
    };
    numbers.material_name = [this](int domain) { return surface_.material_names[at(domain - 1)]; };
    numbers.curve = [this](const ::netgen::Segment& segment) { return curve_of(segment); };
    return numbers;
  }

  // A line of NETGEN's runs along one curve, since NETGEN ends lines wherever curves end. Or it is
  // inside a patch, and its first edge is none of ours.
  LocalIndex curve_of(const ::netgen::Segment& segment)
  {
    const ::netgen::STLLine& line = *geometry_.GetLine(segment.edgenr);
    return features_.curve_of_edge(our_vertex_[at(line.PNum(1))], our_vertex_[at(line.PNum(2))]);
  }

  const model::TriangleSurface& surface_;
  const model::SurfaceFeatures& features_;
  const std::string& name_;
  double max_size_;
  double scale_;
  StlParameters stl_parameters_;
  SizeFile size_file_;
  NetgenSession session_;
  StlGeometry geometry_{};
  std::shared_ptr<::netgen::Mesh> mesh_ = empty_mesh(geometry_);
  std::vector<LocalIndex> our_vertex_{};  // of NETGEN's vertices, which count from 1
};

}  // namespace

surface::CoarseSurface mesh_stl_surface(const model::TriangleSurface& surface,
                                        const model::SurfaceFeatures& features,
                                        const surface::CoarseOptions& options,
                                        const std::string& name, const NetgenSurfaceUser& use)
{
  return StlMeshing(surface, features, options, name).run(use);
}

}  // namespace tessera::netgen

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <csg.hpp>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"

#include "cad/content.hpp"
#include "cad/error.hpp"
#include "netgen/csg/access.hpp"
#include "netgen/csg/crossings.hpp"
#include "netgen/csg/cut.hpp"
#include "netgen/csg/description.hpp"
#include "netgen/csg/parse.hpp"
#include "netgen/csg/patches.hpp"
#include "netgen/csg/remesh.hpp"
#include "netgen/csg/solids.hpp"
#include "netgen/loaders.hpp"
#include "netgen/mesh_conversion.hpp"
#include "netgen/model_mesher.hpp"
#include "netgen/session.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

using Geometry = ::netgen::CSGeometry;
using Point = ::netgen::Point<3>;

// A point counts as on an entity within this part of the box diagonal.
constexpr double kTolerance = 1e-8;

// Steps are repeated until one is shorter than this part of the box diagonal. NETGEN takes ten.
constexpr double kConverged = 1e-14;
constexpr int kMostSteps = 30;

// Empty if NETGEN finds no solid. The bounding box that CSGeometry has is a bound for NETGEN's
// searches, by default 2000 wide.
::netgen::Box<3> extent(Geometry& geometry)
{
  // Detail and facets a radius: the box comes out within 2 % in some milliseconds.
  geometry.CalcTriangleApproximation(0.1, 20);
  ::netgen::Box<3> box(::netgen::Box<3>::EMPTY_BOX);
  for (int i = 0; i < geometry.GetNTopLevelObjects(); ++i) {
    const auto* triangles = geometry.GetTriApprox(i);
    for (int p = 0; p < triangles->GetNP(); ++p) box.Add(triangles->GetPoint(p));
  }
  return box;
}

// `step` is one of NETGEN's projections.
template <class Step>
Point iterate(Point point, double converged, const Step& step)
{
  for (int i = 0; i < kMostSteps; ++i) {
    const Point before = point;
    step(point);
    if (::netgen::Dist(before, point) <= converged) break;
  }
  return point;
}

class CsgModel final : public NetgenModel<geometry::LoadedModel> {
 public:
  explicit CsgModel(const model::ModelSource& source);

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex) const override { return tolerance_; }
  [[nodiscard]] double curve_tolerance(LocalIndex) const override { return tolerance_; }
  [[nodiscard]] double box_diagonal() const override { return box_diagonal_; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override;
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override;
  // A curve is where two surfaces meet, and these are the faces.
  [[nodiscard]] mesh::NamedCurve named_curve(LocalIndex curve) const override
  {
    const auto num_surfaces = static_cast<LocalIndex>(geometry_->GetNSurf());
    return {.curve = curve,
            .number = fmt::format("{}-{}", curve / num_surfaces + 1, curve % num_surfaces + 1)};
  }
  [[nodiscard]] model::ModelDescription describe(surface::SurfaceMesher mesher) const override;
  [[nodiscard]] coarse::ModelFigures figures() const override;
  [[nodiscard]] coarse::CadSurface triangles_for_fit(double size) const override;
  [[nodiscard]] bool has_apex() const { return netgen::has_apex(*geometry_, tolerance_); }
  // NETGEN's search may miss solids that are much smaller than their bodies.
  [[nodiscard]] const std::vector<int>& unseen() const { return unseen_; }
  [[nodiscard]] bool sees_any() const { return sees_any_; }
  [[nodiscard]] std::string names_of(const std::vector<int>& solids) const;
  [[nodiscard]] CsgSolids solids() const;
  using NetgenModel::mesh_whole;
  [[nodiscard]] surface::CoarseSurface mesh_whole(const surface::CoarseOptions& options,
                                                  const NetgenSurfaceUser& use) const override;
  [[nodiscard]] surface::CoarseSurface mesh_parts(const surface::CoarseOptions& options,
                                                  const cut::CutTree& tree) const override;

 private:
  [[nodiscard]] const ::netgen::Surface& surface(LocalIndex number) const;
  [[nodiscard]] surface::CoarseSurface remesh_solids(const surface::CoarseOptions& options) const;
  void require_on(const ::netgen::Surface& surface, const Point& point, const Vec3& from) const;

  std::string file_name_;
  std::string text_;
  std::unique_ptr<Geometry> geometry_;
  ::netgen::Box<3> box_{};
  double box_diagonal_ = 0.0;
  double tolerance_ = 0.0;
  bool sees_any_ = false;
  std::vector<int> unseen_{};
};

CsgModel::CsgModel(const model::ModelSource& source)
    : file_name_(source.file_name),
      text_(reinterpret_cast<const char*>(source.content.data()), source.content.size()),
      geometry_(parse_csg(text_, file_name_))
{
  require_solid(*geometry_, file_name_);
  NetgenSession session;
  box_ = session.run(file_name_, [&] { return extent(*geometry_); });
  sees_any_ = box_.PMin()(0) <= box_.PMax()(0);
  if (!sees_any_) box_ = geometry_->BoundingBox();
  box_diagonal_ = box_.Diam();
  tolerance_ = kTolerance * box_diagonal_;
  unseen_ = unseen_solids(*geometry_);
}

std::string CsgModel::names_of(const std::vector<int>& solids) const
{
  std::vector<std::string> names;
  for (const int solid : solids) names.push_back(name_of_solid(*geometry_, solid));
  return fmt::format("{}", fmt::join(names, ", "));
}

CsgSolids CsgModel::solids() const
{
  if (unseen_.empty()) return solids_of_csg(*geometry_, box_);
  const ::netgen::Box<3>& bound = geometry_->BoundingBox();
  const CsgSolids first = solids_of_csg(*geometry_, bound);
  // Once more: bodies that end far away have parameters that are as inexact as their lengths.
  return solids_of_csg(*geometry_, box_of_solids(first.cad.shape, bound));
}

const ::netgen::Surface& CsgModel::surface(LocalIndex number) const
{
  if (number < 0 || number >= geometry_->GetNSurf()) {
    throw GeometryError(fmt::format("{}: has no surface {}", file_name_, number));
  }
  return *geometry_->GetSurface(number);
}

void CsgModel::require_on(const ::netgen::Surface& surface, const Point& point,
                          const Vec3& from) const
{
  if (distance(surface, point) <= tolerance_) return;
  throw GeometryError(fmt::format("{}: NETGEN finds no point of a surface near ({:g})", file_name_,
                                  fmt::join(from, ", ")));
}

model::SurfacePoint CsgModel::project_to_surface(LocalIndex number, const Vec3& point,
                                                 const model::SurfaceParameters&) const
{
  const ::netgen::Surface& on = surface(number);
  const Point found =
      iterate(to_netgen(point), kConverged * box_diagonal_, [&](Point& p) { on.Project(p); });
  require_on(on, found, point);
  return {from_netgen(found), {}};
}

model::CurvePoint CsgModel::project_to_curve(LocalIndex curve, const Vec3& point, double) const
{
  const int one = curve / geometry_->GetNSurf();
  const int other = curve % geometry_->GetNSurf();
  const ::netgen::Surface& first = surface(one);
  const ::netgen::Surface& second = surface(other);
  const Point found = iterate(to_netgen(point), kConverged * box_diagonal_,
                              [&](Point& p) { project_to_edge(*geometry_, one, other, p); });
  require_on(first, found, point);
  require_on(second, found, point);
  return {from_netgen(found), 0.0};
}

LocalIndex curve_of(const ::netgen::Segment& segment, int num_surfaces)
{
  const auto [low, high] = std::minmax(segment.surfnr1, segment.surfnr2);
  return low < 0 || high >= num_surfaces ? kNoIndex : low * num_surfaces + high;
}

GeometryNumbers numbers_of(const Geometry& geometry)
{
  GeometryNumbers numbers;
  numbers.surface = [](const ::netgen::FaceDescriptor& face) { return face.SurfNr(); };
  numbers.patch_name = [](const ::netgen::FaceDescriptor& face) {
    return name_unless_default(face.GetBCName());
  };
  numbers.patch = [](const ::netgen::FaceDescriptor& face) {
    return key_of_patch(face.SurfNr(), face.DomainIn(), face.DomainOut());
  };
  numbers.curve = [n = geometry.GetNSurf()](const ::netgen::Segment& segment) {
    return curve_of(segment, n);
  };
  numbers.material_name = [&geometry](LocalIndex m) { return name_of_solid(geometry, m - 1); };
  numbers.max_size = [&geometry](int domain) { return max_size_of_solid(geometry, domain - 1); };
  return numbers;
}

// Of a mesh of the parts, in the numbers of the uncut geometry.
GeometryNumbers numbers_of_parts(const Geometry& uncut, const CutObjects& objects)
{
  GeometryNumbers numbers = numbers_of(uncut);
  const auto solid_of = [&objects](int domain) {
    return domain <= 0 ? 0 : objects.solid.at(at(domain - 1)) + 1;
  };
  numbers.material = solid_of;
  numbers.part = [&](int domain) { return objects.part.at(at(domain - 1)); };
  numbers.max_size = [solid_of, of_solid = numbers.max_size](int domain) {
    return of_solid(solid_of(domain));
  };
  numbers.patch = [&objects, solid_of](const ::netgen::FaceDescriptor& face) {
    if (face.SurfNr() >= objects.num_surfaces) throw NetgenError("a cut lies on the surface");
    return key_of_patch(face.SurfNr(), solid_of(face.DomainIn()), solid_of(face.DomainOut()));
  };
  return numbers;
}

// Within run() of the session.
std::shared_ptr<::netgen::Mesh> netgen_surface(Geometry& geometry, NetgenSession& session)
{
  auto mesh = empty_mesh(geometry);
  int failed = 0;
  session.run_surface([&] { failed = geometry.GenerateMesh(mesh, session.parameters()); });
  if (failed != 0) throw NetgenError("NETGEN gave up; " + session.words());
  return mesh;
}

surface::CoarseSurface CsgModel::mesh_whole(const surface::CoarseOptions& options,
                                            const NetgenSurfaceUser& use) const
{
  if (options.surface_mesher == surface::SurfaceMesher::remesh) {
    return remesh_solids(options);
  }
  // NETGEN changes the geometry that it meshes. With a fresh one each try depends on options alone.
  const std::unique_ptr<Geometry> geometry = parse_csg(text_, file_name_);
  const std::string what = file_name_ + ": coarse mesh";
  NetgenSession session(surface_parameters(options));
  const auto mesh = session.run(what, [&] { return netgen_surface(*geometry, session); });
  surface::CoarseSurface surface =
      to_coarse_surface(*mesh, numbers_of(*geometry), options.max_size, what);
  separate_patches(surface.mesh);
  session.run(file_name_, [&] { use(*geometry, *mesh, 1.0, surface); });
  return surface;
}

// OpenCASCADE makes the solids, and their triangles are remeshed. The model stays NETGEN's.
surface::CoarseSurface CsgModel::remesh_solids(const surface::CoarseOptions& options) const
{
  if (const std::string why = why_only_netgen(*geometry_); !why.empty()) {
    throw NetgenError(fmt::format("{}: {}", file_name_, why));
  }
  try {
    cad::CadFile made = cad::with_occ_errors(file_name_, [&] { return solids().cad; });
    return remesh_csg(*this, *geometry_, std::move(made), box_, options, file_name_);
  } catch (const GeometryError& error) {  // The model itself may be sound, other tries go on.
    throw NetgenError(fmt::format("solids of OpenCASCADE: {}", error.what()));
  }
}

surface::CoarseSurface CsgModel::mesh_parts(const surface::CoarseOptions& options,
                                            const cut::CutTree& tree) const
{
  const std::string what = file_name_ + ": coarse mesh of the parts";
  const CutGeometry cut = cut_geometry(*geometry_, text_, file_name_, tree);
  NetgenSession session(surface_parameters(options));
  return session.run(what, [&] {
    add_crossings(*cut.geometry, cut.objects, box_);
    const auto mesh = netgen_surface(*cut.geometry, session);
    surface::CoarseSurface surface =
        to_coarse_surface(*mesh, numbers_of_parts(*geometry_, cut.objects), options.max_size, what);
    separate_patches(surface.mesh);
    return surface;
  });
}

// By NETGEN's triangles for pictures, which the box came from.
coarse::ModelFigures CsgModel::figures() const
{
  coarse::ModelFigures figures{.num_faces = geometry_->GetNSurf()};
  for (int i = 0; i < geometry_->GetNTopLevelObjects(); ++i) {
    const auto* triangles = geometry_->GetTriApprox(i);
    for (int t = 0; t < triangles->GetNT(); ++t) {
      const auto corner = [&](int c) {
        return from_netgen(triangles->GetPoint(triangles->GetTriangle(t)[c]));
      };
      const Vec3 a = corner(0);
      figures.area += 0.5 * norm(cross(corner(1) - a, corner(2) - a));
    }
  }
  return figures;
}

// The triangles that NETGEN has for pictures leave out parts of cylinders and cones, so the surface
// is meshed.
coarse::CadSurface CsgModel::triangles_for_fit(double size) const
{
  const std::unique_ptr<Geometry> geometry = parse_csg(text_, file_name_);
  surface::CoarseOptions options;
  options.max_size = size;
  NetgenSession session(surface_parameters(options));
  const auto mesh =
      session.run(file_name_ + ": surface", [&] { return netgen_surface(*geometry, session); });
  coarse::CadSurface cad = surface_of_mesh(*mesh, numbers_of(*geometry));
  cad.size = size;
  for (int solid = 0; solid < geometry->GetNTopLevelObjects(); ++solid) {
    cad.solid_names.push_back(name_of_solid(*geometry, solid));
  }
  return cad;
}

model::ModelDescription CsgModel::describe(surface::SurfaceMesher mesher) const
{
  constexpr double kSize = 0.1;       // In parts of the box diagonal.
  constexpr double kCurvature = 3.0;  // So volumes are good to some percent.
  surface::CoarseOptions options;
  options.max_size = kSize * box_diagonal_;
  options.curvature = kCurvature;
  options.surface_mesher = mesher;
  const surface::CoarseSurface surface = mesh_whole(options);
  return describe_csg(*geometry_, surface,
                      [this](LocalIndex curve) { return named_curve(curve).number; });
}

CsgSolids made_solids(const CsgModel& model, const std::string& file, const std::string& why)
{
  return cad::with_occ_errors(file, [&] {
    try {
      return model.solids();
    } catch (const GeometryError& error) {
      throw GeometryError(fmt::format("{}: {}; {}", file, why, error.what()));
    }
  });
}

// What NETGEN's CSG cannot mesh is OpenCASCADE's model from here on.
model::ModelSource of_open_cascade(cad::CadFile cad, const model::ModelSource& source,
                                   const std::string& why,
                                   std::vector<model::EmbeddedShape> embedded = {})
{
  note_repair(Repair::csg_by_occ);
  cad.repairs = source.repairs;
  cad.repairs.push_back(
      fmt::format("{}: OpenCASCADE made the solids once more; sizes that the file gives to solids "
                  "are lost",
                  why));
  return cad::closed_source(std::move(cad), source.file_name,
                            {.overlap = model::Overlap::cut, .embedded = std::move(embedded)});
}

// OpenCASCADE tells whether what NETGEN does not see is there. Nothing: it is not, and `source`
// says so.
std::optional<model::ModelSource> with_specks(const CsgModel& model, model::ModelSource& source)
{
  if (model.unseen().empty()) return std::nullopt;
  const std::string why = "NETGEN's CSG finds nothing of solid " + model.names_of(model.unseen());
  CsgSolids made;
  try {
    made = made_solids(model, source.file_name, why);
  } catch (const GeometryError& error) {
    if (!model.sees_any()) throw;
    source.repairs.push_back(
        fmt::format("{}: left out, and whether it holds something is not known", error.what()));
    return std::nullopt;
  }
  std::vector<int> empty;
  std::ranges::set_intersection(made.empty, model.unseen(), std::back_inserter(empty));
  if (!empty.empty()) {
    source.repairs.push_back(
        fmt::format("solid {} holds nothing: left out", model.names_of(empty)));
  }
  if (empty == model.unseen()) return std::nullopt;
  return of_open_cascade(std::move(made.cad), source, why);
}

}  // namespace

model::ModelSource import_csg(const std::filesystem::path& file,
                              const model::AssemblyOptions& options)
{
  model::ModelSource source{.format = model::Format::csg, .file_name = file.string()};
  const std::string text = text_of_file(file);
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  source.content.assign(first, first + text.size());
  const SkippedStatements skipped;
  const CsgModel model(source);
  source.repairs = skipped.lines();
  if (!options.embedded.empty()) {
    const std::string why = "NETGEN's CSG has no faces that end inside of a solid";
    return of_open_cascade(made_solids(model, source.file_name, why).cad, source, why,
                           options.embedded);
  }
  if (is_left_out(Repair::csg_by_occ)) return source;
  if (auto specks = with_specks(model, source)) return std::move(*specks);
  if (model.has_apex()) {
    const std::string why = "NETGEN's CSG cannot mesh the apex of a cone";
    return of_open_cascade(made_solids(model, source.file_name, why).cad, source, why);
  }
  return source;
}

std::unique_ptr<geometry::LoadedModel> load_csg(const model::ModelSource& source)
{
  return std::make_unique<CsgModel>(source);
}

}  // namespace tessera::netgen

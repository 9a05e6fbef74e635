// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <TopTools_IndexedMapOfShape.hxx>

#include "cad/content.hpp"
#include "cad/project/curve.hpp"
#include "cad/project/surface.hpp"
#include "geometry/loaded_model.hpp"

namespace tessera::cad {

/// @brief The closed solids of a STEP, IGES or BREP file.
class CadModel : public geometry::LoadedModel {
 public:
  CadModel(OccContent content, std::string file_name);

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
  [[nodiscard]] model::ModelDescription describe(surface::SurfaceMesher mesher) const override;
  [[nodiscard]] mesh::NamedCurve named_curve(LocalIndex curve) const override
  {
    return {curve, std::to_string(curve + 1), content_.edge_names.at(at(curve)), is_line(curve)};
  }
  [[nodiscard]] coarse::ModelFigures figures() const override;
  [[nodiscard]] coarse::CadSurface triangles_for_fit(double size) const override;
  void write_brep(const std::filesystem::path& file) const override;
  void add_parameters(const surface::SurfaceReference& reference,
                      mesh::CoarseMesh& mesh) const override;
  void locate_parameters(mesh::CoarseMesh& mesh) const override;
  /// @brief OpenCASCADE's triangles, made well-shaped, whatever the surface mesher.
  [[nodiscard]] surface::CoarseSurface mesh_whole(
      const surface::CoarseOptions& options) const override;

 protected:
  [[nodiscard]] const OccContent& content() const { return content_; }
  [[nodiscard]] const std::string& file_name() const { return file_name_; }
  [[nodiscard]] const TopTools_IndexedMapOfShape& faces() const { return faces_; }
  [[nodiscard]] const TopTools_IndexedMapOfShape& edges() const { return edges_; }
  // Of a solid, from 1: the name of its body.
  [[nodiscard]] std::string solid_name(LocalIndex material) const;

  // What a mesher has at a corner is only a guess.
  void locate_face_corners(mesh::CoarseMesh& mesh) const;
  void locate_segment_ends(mesh::CoarseMesh& mesh) const;

 private:
  [[nodiscard]] const OccSurface& surface_at(LocalIndex surface) const;
  [[nodiscard]] const OccCurve& curve_at(LocalIndex curve) const;
  [[nodiscard]] surface::CoarseSurface mesh_solids(const surface::CoarseOptions& options) const;
  [[nodiscard]] surface::CoarseSurface mesh_cells(const surface::CoarseOptions& options) const;
  // Lines inside of solids are the last edges.
  [[nodiscard]] bool is_line(LocalIndex curve) const { return curve >= num_edges_of_faces_; }
  void require_whole_lines(const mesh::CoarseMesh& mesh) const;
  [[nodiscard]] FlatArray<LocalIndex> material_rows() const;
  static void guess_parameters(const surface::SurfaceReference& reference, mesh::CoarseMesh& mesh);

  OccContent content_;
  std::string file_name_;
  double box_diagonal_ = 0.0;
  TopTools_IndexedMapOfShape faces_{};
  TopTools_IndexedMapOfShape edges_{};
  LocalIndex num_edges_of_faces_ = 0;
  std::vector<OccSurface> surfaces_{};
  std::vector<std::unique_ptr<OccCurve>> curves_{};  // Nothing for a degenerate edge: numbers are
                                                     // those of the map.
};

}  // namespace tessera::cad

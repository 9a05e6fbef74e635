// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tessera/model/model.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/model/options.hpp"
#include "tessera/model/surface_features.hpp"
#include "tessera/model/triangle_surface.hpp"

#include "geometry/loaded_model.hpp"
#include "geometry/stl_wrap.hpp"

namespace tessera::geometry {

struct StlContent;

/// @brief The triangles of an STL file. Projection is our own: NETGEN's depends on the order of its
/// arguments and needs charts that exist only after meshing.
class StlModel : public LoadedModel {
 public:
  /// @param[in] source Of import_stl(). @throws InputError if its bytes are damaged.
  explicit StlModel(const model::ModelSource& source);

  [[nodiscard]] bool has_parameters() const override { return false; }
  [[nodiscard]] double surface_tolerance(LocalIndex surface) const override;
  [[nodiscard]] double curve_tolerance(LocalIndex curve) const override;
  [[nodiscard]] double box_diagonal() const override { return box_diagonal_; }
  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override;
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override;

  [[nodiscard]] model::ModelDescription describe(surface::SurfaceMesher mesher) const override;
  [[nodiscard]] coarse::ModelFigures figures() const override;
  [[nodiscard]] coarse::CadSurface triangles_for_fit(double size) const override;

  /// @brief The triangles of the file, made well-shaped, whatever the surface mesher.
  [[nodiscard]] surface::CoarseSurface mesh_whole(
      const surface::CoarseOptions& options) const override;

 protected:
  [[nodiscard]] const model::TriangleSurface& surface() const { return surface_; }
  [[nodiscard]] const model::SurfaceFeatures& features() const { return features_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  StlModel(const StlContent& content, std::string name);
  void add_faces_of_edges(model::ModelDescription& to) const;
  [[nodiscard]] Vec3 found(const model::NearestPoint& nearest) const;

  model::TriangleSurface surface_;
  model::SurfaceFeatures features_;
  std::vector<model::TriangleSearch> patch_search_;
  std::vector<model::SegmentSearch> curve_search_;
  double box_diagonal_;
  std::string name_;
};

/// @brief Reads and checks an STL file.
/// @param[in] unite What makes one body of shells that lie flat on each other; empty: they stay.
/// @note Local. @throws InputError, GeometryError as checked_or_wrapped().
[[nodiscard]] model::ModelSource import_stl(const std::filesystem::path& file,
                                            const model::ImportOptions& options,
                                            const ShellUniter& unite);

}  // namespace tessera::geometry

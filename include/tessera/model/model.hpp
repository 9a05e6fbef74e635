// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/assembly.hpp"

namespace tessera::model {

/// @brief What import needs to know beside the file.
struct ImportOptions {
  /// STL, mesh files: dihedral angle, degrees in (0, 180), from which an edge separates two
  /// patches.
  double feature_angle_deg = 30.0;
  std::filesystem::path cad{};  ///< Of a mesh file: the CAD model it is of; empty: none.
  bool smooth = false;          ///< Of a mesh file without CAD model: its surface is made smooth.
  AssemblyOptions assembly{};   ///< STEP, IGES, BREP, also of `cad`; lengths of the file.
  StlOptions stl{};             ///< STL; lengths of the file.

  static auto fields(auto& self)
  {
    return std::tie(self.feature_angle_deg, self.cad, self.smooth, self.assembly, self.stl);
  }
};

/// @brief What a model was read from.
enum class Format : int {
  csg,
  stl,
  occ,  ///< STEP, IGES and BREP, kept as one BREP.
  own,  ///< A tet mesh that is the coarse mesh itself.
};
[[nodiscard]] constexpr Format last_value(Format /*type*/) { return Format::own; }

/// @brief What every rank loads the model from: the bytes that rank 0 read (and healed), so that no
/// rank can see another file than the others.
struct ModelSource {
  Format format = Format::csg;
  std::string file_name{};    ///< For messages only.
  std::string length_unit{};  ///< "mm", "m", …; empty if the file does not say.
  Bytes content{};  ///< .geo text; checked STL triangles; BREP and names; checked mesh and CAD.
  std::vector<std::string> repairs{};  ///< What import changed, one line each; for the report.
  Assembly assembly{};                 ///< Of STEP, IGES, BREP: what was found where solids meet.
  Wrap wrap{};                         ///< Of STL, if it was wrapped.

  static auto fields(auto& self)
  {
    return std::tie(self.format, self.file_name, self.length_unit, self.content, self.repairs,
                    self.assembly, self.wrap);
  }
};

using SurfaceParameters = std::array<double, 2>;

/// @brief A point on a surface and its parameters there.
struct SurfacePoint {
  Vec3 xyz{};
  SurfaceParameters uv{};
};

/// @brief A point on a curve and its parameter there.
struct CurvePoint {
  Vec3 xyz{};
  double t = 0.0;
};

/// @brief A CAD model as refinement sees it: surfaces and curves, and projection onto one of them.
///
/// Both projections are pure functions: the same arguments give the same bits, whatever was asked
/// before. Surface and curve numbers are those of the coarse mesh made from this model
/// (CoarseMesh::patch_surface, CoarseMesh::segment_curve). Not thread-safe.
class Model {
 public:
  virtual ~Model() = default;

  /// @brief Whether surfaces and curves have parameters (OpenCASCADE: yes; CSG, STL: no). If not,
  /// the guesses below are ignored and the returned parameters are 0.
  [[nodiscard]] virtual bool has_parameters() const = 0;

  /// @brief A point counts as on this surface if it is off by no more than this: the CAD entity's
  /// own tolerance, at least 1e-8 of the box diagonal.
  [[nodiscard]] virtual double surface_tolerance(LocalIndex surface) const = 0;
  [[nodiscard]] virtual double curve_tolerance(LocalIndex curve) const = 0;

  /// @brief The same for a point at an end of the curve, where the CAD system lets curves meet
  /// less exactly than it makes them: the tolerance of the CAD vertex that `point` lies in; else
  /// that of the curve.
  [[nodiscard]] virtual double end_tolerance(LocalIndex curve, const Vec3& /*point*/) const
  {
    return curve_tolerance(curve);
  }

  /// @brief The point of `surface` nearest to `point`, searched near `guess`.
  /// @throws GeometryError if no point is found.
  [[nodiscard]] virtual SurfacePoint project_to_surface(LocalIndex surface, const Vec3& point,
                                                        const SurfaceParameters& guess) const = 0;

  /// @brief The point of `curve` nearest to `point`, searched near `guess`.
  /// @throws GeometryError if no point is found.
  [[nodiscard]] virtual CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                    double guess) const = 0;

  /// @brief Diagonal of the model's bounding box, file length unit.
  [[nodiscard]] virtual double box_diagonal() const = 0;
};

}  // namespace tessera::model

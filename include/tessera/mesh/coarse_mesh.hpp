// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/periodic_pairs.hpp"
#include "tessera/mesh/side_images.hpp"
#include "tessera/mesh/wall_layers.hpp"

namespace tessera::mesh {

/// @brief The name of a patch that the model has none for. `patch`: from 0. Local.
[[nodiscard]] std::string default_patch_name(LocalIndex patch);

/// @brief The name of a material that the model has none for. `material`: from 1. Local.
[[nodiscard]] std::string default_material_name(LocalIndex material);

/// @brief What users call a curve of the model.
struct NamedCurve {
  LocalIndex curve = kNoIndex;  ///< The Model's curve number.
  std::string number{};         ///< As `tessera info` lists it: "7"; of CSG "3-7", its two faces.
  std::string name{};           ///< The file's, or that of an [[embed]]; empty: none.
  bool is_line = false;         ///< Inside of solids, on no face.

  static auto fields(auto& self)
  {
    return std::tie(self.curve, self.number, self.name, self.is_line);
  }
};

/// @brief The small sequential mesh that everything else is derived from; the same on every rank.
///
/// A *face* is a triangle on the geometry, also one between two materials; it stands once. Several
/// materials may be one *body*: then what parts them is only partly faces, so that a face that ends
/// inside of a body has a material on either side. Files have bodies. A
/// *segment* is a piece of a geometric curve (feature edge); it may stand more than once, with the
/// parameters of either side. `surface` and `curve` numbers are the Model's; a *patch* is what
/// users see: one geometric face with its name. Several patches may lie on one surface.
struct CoarseMesh {
  FlatArray<double> vertex_xyz{};        ///< Shape (num_vertices, 3), output length unit.
  FlatArray<LocalIndex> tet_vertices{};  ///< Shape (num_tets, 4); positive volume, VTK's order.
  FlatArray<LocalIndex> tet_material{};  ///< Shape (num_tets); from 1.

  FlatArray<LocalIndex> face_vertices{};  ///< Shape (num_faces, 3); orientation is arbitrary.
  FlatArray<LocalIndex> face_patch{};     ///< Shape (num_faces); row of patch_names.
  FlatArray<double> face_uv{};  ///< Shape (num_faces, 3, 2), corner parameters on the patch's
                                ///< surface; empty if the model has none.

  FlatArray<LocalIndex> segment_vertices{};  ///< Shape (num_segments, 2).
  FlatArray<LocalIndex> segment_curve{};     ///< Shape (num_segments); the Model's curve number.
  FlatArray<double> segment_t{};  ///< Shape (num_segments, 2), end parameters; empty if none.

  std::vector<NamedCurve> curves{};  ///< Those that segments lie on, ascending; empty: not known.

  std::vector<std::string> patch_names{};  ///< Shape (num_patches).
  FlatArray<LocalIndex> patch_surface{};   ///< Shape (num_patches); the Model's surface number, or
                                           ///< kNoIndex: is_wake().
  FlatArray<LocalIndex> patch_row{};  ///< Shape (num_patches); row of the patch in files, dense
                                      ///< from 0. Patches of one row have one name, that of its
                                      ///< first patch. Empty: each patch is its own row.
  FlatArray<char> patch_is_inside{};  ///< Shape (num_patches): whether one body is on both sides;
                                      ///< empty: of none.
  std::vector<std::string> material_names{};  ///< Entry m-1 names material m.
  FlatArray<LocalIndex> material_row{};  ///< Shape (num_materials); row of the body in files, dense
                                         ///< from 0, ascending. Materials of one row have one name.
                                         ///< Empty: each material is its own row.

  SideImages images{};  ///< Periodic sides, and minus sides of splits and joints.
  WallLayers layers{};  ///< Between the tets and the geometry.

  static auto fields(auto& self)
  {
    return std::tie(self.vertex_xyz, self.tet_vertices, self.tet_material, self.face_vertices,
                    self.face_patch, self.face_uv, self.segment_vertices, self.segment_curve,
                    self.segment_t, self.curves, self.patch_names, self.patch_surface,
                    self.patch_row, self.patch_is_inside, self.material_names, self.material_row,
                    self.images, self.layers);
  }

  [[nodiscard]] LocalIndex num_vertices() const { return count(vertex_xyz.size(), 3); }
  [[nodiscard]] LocalIndex num_tets() const { return count(tet_vertices.size(), 4); }
  [[nodiscard]] LocalIndex num_faces() const { return count(face_vertices.size(), 3); }
  [[nodiscard]] LocalIndex num_segments() const { return count(segment_vertices.size(), 2); }
  [[nodiscard]] LocalIndex num_patches() const { return count(patch_names.size(), 1); }
  [[nodiscard]] LocalIndex num_materials() const { return count(material_names.size(), 1); }

  /// @brief Number of the body that material `m` is of, from 1.
  [[nodiscard]] LocalIndex body(LocalIndex m) const
  {
    return material_row.empty() ? m : material_row[at(m - 1)] + 1;
  }

  /// @brief Whether a patch is a side of a *wake*: triangles inside of a material that go on from a
  /// sharp edge of walls. The mesh is open there as at a joint, so layers go on along both sides. A
  /// wake has the name and the row of a wall, lies on no geometry, and is in no file.
  [[nodiscard]] bool is_wake(LocalIndex patch) const
  {
    return patch != kNoIndex && patch_surface[at(patch)] == kNoIndex;
  }

  /// @brief Vertices of tet `t`.
  [[nodiscard]] std::span<const LocalIndex, 4> tet(LocalIndex t) const
  {
    return std::span<const LocalIndex, 4>(tet_vertices.data() + 4 * static_cast<std::size_t>(t), 4);
  }

  /// @brief Position of vertex `v`.
  [[nodiscard]] Vec3 position(LocalIndex v) const { return point_at(std::span(vertex_xyz), v); }

 private:
  static LocalIndex count(std::size_t size, std::size_t width)
  {
    return static_cast<LocalIndex>(size / width);
  }
};

/// @brief Names of the two sides of each split, plus and minus. Local.
[[nodiscard]] std::vector<std::array<std::string, 2>> split_patch_names(const CoarseMesh& mesh);

/// @brief The names that patches have in the end: those of the sides of a split get `_plus` and
/// `_minus`. Shape (num_patches). Local. @pre The sides still have the name of the whole patch.
[[nodiscard]] std::vector<std::string> final_patch_names(const CoarseMesh& mesh);

/// @brief Names of the patches inside of bodies, each once. Local.
[[nodiscard]] std::vector<std::string> inside_patch_names(const CoarseMesh& mesh);

/// @brief Names of the lines inside of solids, each once. A line without a name has one of its
/// curve. Local.
[[nodiscard]] std::vector<std::string> line_names(const CoarseMesh& mesh);

/// @brief By curve on a line inside of solids: the line, a row of line_names(). Local.
[[nodiscard]] std::map<LocalIndex, LocalIndex> lines_by_curve(const CoarseMesh& mesh);

/// @brief One name a body. Local.
[[nodiscard]] std::vector<std::string> body_names(const CoarseMesh& mesh);

/// @brief Its periodic sides, in the order of their transforms. Local.
[[nodiscard]] std::vector<PeriodicPair> periodic_pairs(const CoarseMesh& mesh);

/// @brief Throws MeshError unless the mesh keeps what CoarseMesh promises. Local.
///
/// - Indices are in range and sizes of arrays are consistent.
/// - Every tet is positive.
/// - Every face is a face of one tet, or of two if their materials differ.
/// - Every triangle of a tet that is outside or between two bodies is a face.
/// - Every face of a patch that is an image is the image of a face.
void validate(const CoarseMesh& mesh);

}  // namespace tessera::mesh

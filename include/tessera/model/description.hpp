// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::model {

/// @brief One face of a model. A surface of CSG may be several: one each between two solids, or
/// outside of one.
struct FaceDescription {
  LocalIndex number = 0;           ///< The model's surface number plus 1.
  LocalIndex patch = kNoIndex;     ///< Row in the mesh, if that is not the surface number.
  LocalIndex piece_of = kNoIndex;  ///< Number before `[[embed]]` of the face that it is a piece
                                   ///< of; 0: it was put in. kNoIndex: nothing was.
  std::string name{};              ///< Empty: the file has none.
  std::string colour{};            ///< "#RRGGBB"; empty: the file has none.
  double area = 0.0;               ///< File length unit squared.
  std::vector<LocalIndex>
      solids{};            ///< It bounds, ascending, from 1; also one that it is inside of.
  bool is_inside = false;  ///< One solid is on both sides.

  /// @brief The number that users know it by: before `[[embed]]`; 0: it was put in.
  [[nodiscard]] LocalIndex given_number() const { return piece_of == kNoIndex ? number : piece_of; }

  /// @brief What the mesh calls it unless the case gives a name.
  [[nodiscard]] std::string patch_name() const;

  static auto fields(auto& self)
  {
    return std::tie(self.number, self.patch, self.piece_of, self.name, self.colour, self.area,
                    self.solids, self.is_inside);
  }
};

/// @brief One curve of a model, where faces meet.
struct EdgeDescription {
  std::string number{};  ///< As of mesh::NamedCurve.
  std::string name{};    ///< Empty: the file has none.
  double length = 0.0;   ///< File length unit.
  Vec3 low{};            ///< Corners of its box, file length unit.
  Vec3 high{};
  std::vector<LocalIndex> faces{};  ///< Rows of the faces that it bounds, ascending.
  std::vector<double> line_xyz{};   ///< Shape (num_lines, 2, 3): straight lines to draw it with.

  /// @brief Makes it longer by the straight line between two points.
  void add_line(const Vec3& a, const Vec3& b);

  /// @brief Adds a straight line to what it is drawn with, and to nothing else.
  void draw_line(const Vec3& a, const Vec3& b);

  static auto fields(auto& self)
  {
    return std::tie(self.number, self.name, self.length, self.low, self.high, self.faces,
                    self.line_xyz);
  }
};

/// @brief One solid of a model: a material of the mesh.
struct SolidDescription {
  std::string name{};   ///< Empty: the file has none.
  double volume = 0.0;  ///< File length unit cubed.

  static auto fields(auto& self) { return std::tie(self.name, self.volume); }
};

/// @brief What people want to know of a model before they mesh it, with triangles to draw it.
struct ModelDescription {
  std::vector<SolidDescription> solids{};
  std::vector<FaceDescription> faces{};  ///< By number, each solid's part of it by itself.
  std::vector<EdgeDescription> edges{};  ///< By number.
  std::vector<double> vertex_xyz{};      ///< Shape (num_vertices, 3), file length unit.
  /// Shape (num_triangles, 3). Normals point out of the solid; of two, out of the lower one.
  std::vector<LocalIndex> triangle_vertices{};
  std::vector<LocalIndex> triangle_face{};  ///< Shape (num_triangles); row of faces.

  static auto fields(auto& self)
  {
    return std::tie(self.solids, self.faces, self.edges, self.vertex_xyz, self.triangle_vertices,
                    self.triangle_face);
  }

  /// @throws InputError if the sizes do not match, an index is out of range or a value is no
  /// number.
  void require_sound() const;
};

}  // namespace tessera::model

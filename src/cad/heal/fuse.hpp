// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <BRepAlgoAPI_BuilderAlgo.hxx>
#include <NCollection_DataMap.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>

namespace tessera::cad {

using Shapes = std::vector<TopoDS_Shape>;

/// @brief Solids that share what they have in common, and what became of them.
struct FusedSolids {
  std::vector<std::unique_ptr<BRepAlgoAPI_BuilderAlgo>> fuses{};
  TopoDS_Shape shape{};               ///< All solids, in the order of those given.
  std::size_t num_bare_contacts = 0;  ///< Pairs that touch, but not along faces: apart there.

  /// @brief What became of a part of a given solid; nothing if that is as it was.
  [[nodiscard]] TopTools_ListOfShape images_of(const TopoDS_Shape& part) const;

  /// @brief The same of a whole solid: itself if it is as it was.
  [[nodiscard]] Shapes solids_of(const TopoDS_Shape& given) const;

  /// @brief Pairs of faces that OpenCASCADE could not intersect.
  [[nodiscard]] int num_failed_pairs() const;
};

/// @brief What became of a part of what was fused: itself if it is as it was. Local.
[[nodiscard]] Shapes images_of(const TopoDS_Shape& part, BRepAlgoAPI_BuilderAlgo& fuse);

/// @brief Which solid was the first to come with a part.
class PartOwners {
 public:
  /// @brief That solid: the given one if the part is new.
  std::size_t first_with(const TopoDS_Shape& part, std::size_t solid);

 private:
  NCollection_DataMap<TopoDS_Shape, std::size_t, TopTools_ShapeMapHasher> owner_{};
};

/// @brief How near is no gap and no overlap, but rounding. File length unit.
struct Nearness {
  double thinnest = 0.0;     ///< What is thinner is none.
  bool closes_gaps = false;  ///< Whether gaps of that width are closed even where the solids
                             ///< would be sound with them.
};

/// @brief Fuses solids where they have faces in common. Solids that overlap are cut into parts.
/// Those that touch along curves or in points only keep their faces whole.
/// @return Nothing if OpenCASCADE fails.
[[nodiscard]] std::optional<FusedSolids> fuse_at_faces(const Shapes& solids,
                                                       const Nearness& nearness);

[[nodiscard]] TopoDS_Compound compound_of(const Shapes& solids);

/// @brief Whether a solid is no more than an overlap by rounding.
[[nodiscard]] bool is_film(const TopoDS_Shape& solid, double thinnest);

/// @brief The same of a face.
[[nodiscard]] bool is_strip(const TopoDS_Shape& face, double thinnest);

}  // namespace tessera::cad

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <tuple>
#include <vector>

#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/number/surface_simplices.hpp"
#include "tessera/refine/lattice_refiner.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_summary.hpp"

/// From coarse to fine: pieces that were filled on few levels are split further, in closed form.
namespace tessera::subdomain {

/// @brief What a piece knows of the others when it is split.
struct PieceSurroundings {
  number::SurfaceList surface{};   ///< surface_of() it.
  number::SharedSurface shared{};  ///< What its neighbours have of that.
  number::SurfacePlaces places{};  ///< Who numbers it.
  number::SurfacePlaces ends{};    ///< The same of ends_across_joints(), if there are any.
  std::vector<mesh::Piece>
      halos{};              ///< halo_beside() it of all neighbours of its material; ascending.
  bool is_smoothed = true;  ///< Else new vertices off the geometry are midpoints. The same
                            ///< for all pieces of a material, whatever made them.

  static auto fields(auto& self)
  {
    return std::tie(self.surface, self.shared, self.places, self.ends, self.halos,
                    self.is_smoothed);
  }
};

/// @brief How pieces are split.
struct PieceSplit {
  int levels = 0;          ///< Of every edge.
  bool is_curved = false;  ///< Tets stay whole, and the points of one level become their nodes of
                           ///< second order.

  static auto fields(auto& self) { return std::tie(self.levels, self.is_curved); }
};

/// @brief A piece that was split, or why it could not be.
struct RefinedPiece {
  FilledPiece filled{};
  /// New points on the geometry that must be held back, since tets beside them are folded, or not
  /// certainly positive everywhere if they are curved. Empty
  /// unless the piece is folded.
  std::vector<mesh::PointLimit> folds{};
};

/// @brief Splits the tets of pieces by some levels.
///
/// A tet is split as a coarse tet is. Points on the geometry are those of the skeleton's lattice,
/// all others midpoints. Then vertices are smoothed: those on seams first, all at once, by what
/// both sides know; then those inside, one after the other. So pieces conform without a message,
/// and the mesh gets better than the one it was made from.
///
/// With PieceSplit::is_curved tets get nodes instead, and nothing is smoothed.
class PieceRefiner {
 public:
  /// @param[in] cut Borrowed; with the levels that the pieces were filled on.
  PieceRefiner(const PartitionedMesh& cut, const PieceSplit& split);
  PieceRefiner(PieceRefiner&&) noexcept;
  ~PieceRefiner();

  /// @param[in] refine Made from the arrays of the same mesh. Its levels do not count.
  /// @param[in] before What is known of the piece.
  /// @param[in] layers With the split, of a mesh with layers; null without.
  /// @throws MeshError if the result breaks a promise of fill::check_fill(). GeometryError if a
  /// projection fails.
  /// @note Local; a pure function of its arguments.
  [[nodiscard]] RefinedPiece refine(const mesh::Piece& piece, const PieceSurroundings& around,
                                    const refine::RefineContext& refine, const PieceSummary& before,
                                    const LayerTables* layers = nullptr) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tessera::subdomain

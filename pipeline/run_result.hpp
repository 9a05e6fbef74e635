// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/coarse/sharp_tets.hpp"
#include "tessera/config/case.hpp"
#include "tessera/cut/choose_planes.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/formats/piece.hpp"
#include "tessera/layers/grow_layers.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/model/model.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/drawing/mesh_scene.hpp"
#include "pipeline/stages/coarse/coarse_stage.hpp"
#include "pipeline/stages/output/hand_over_stage.hpp"
#include "pipeline/store/filled_pieces.hpp"
#include "pipeline/store/run_state.hpp"
#include "pipeline/viewer/surface.hpp"

namespace tessera::pipeline {

/// @brief What a run is told besides its case.
struct RunOptions {
  const RunState* state = nullptr;            ///< Of the output folder; nullptr: keep nothing.
  std::vector<LocalIndex> only_subdomains{};  ///< Ascending; empty: all.
  PieceSink on_piece{};                       ///< If set, gets the pieces: no files are written.
};

/// @brief What the report shows of a mesh.
struct Drawings {
  std::vector<MeshPicture> pictures{};
  Surface surface{};  ///< To turn.
};

/// @brief What a run has made; the same on every rank unless it says otherwise. The mesh itself is
/// in the output folder.
struct RunResult {
  config::Case resolved{};  ///< With size and levels as chosen.
  model::ModelSource model{};
  std::optional<coarse::ModelFigures> figures{};  ///< Of the model; none if they cannot be had.
  RepairCounts import_repairs{};                  ///< Of the model; on rank 0.
  Hash128 field_content{};                        ///< Of size.field; zero without one.
  cut::CutChoice planes{};  ///< Without nodes unless the model is cut before it is meshed.
  CoarseResult coarse{};
  layers::LayerCover cover{};  ///< Of the walls by layers; without patches if there are none.
  coarse::SharpTets sharp{};   ///< Of the coarse mesh; on rank 0.
  mesh::EdgeLevels levels{};   ///< Of the coarse edges, in all.
  int splits = 0;              ///< How many of them follow after the fills.
  decompose::DecomposeResult decomposition{};
  std::vector<fill::KernelKind> kernels{};  ///< By subdomain, as the case wants them.
  mesh::ProjectionLimiter limiter{};
  std::size_t num_straightened = 0;  ///< Of its points: nodes of second order.
  FilledPieces filled{};
  std::vector<LocalIndex> only_subdomains{};  ///< As asked for; empty: all.
  GlobalIndex num_vertices = 0;               ///< Of the whole mesh, made or not.
  GlobalIndex num_tets = 0;
  std::vector<formats::PieceCounts> files{};  ///< Of run_export_stage(); may be empty.
  Drawings drawings{};                        ///< On rank 0, if the case wants a report for people.
};

}  // namespace tessera::pipeline

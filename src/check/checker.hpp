// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tessera/check/check_mesh.hpp"

#include "check/check_limits.hpp"
#include "check/components.hpp"
#include "check/findings.hpp"
#include "check/match/edges.hpp"
#include "check/match/id_runs.hpp"
#include "check/match/periodic.hpp"
#include "check/match/records.hpp"
#include "check/match/triangles.hpp"
#include "check/match/vertices.hpp"
#include "check/piece/figures.hpp"
#include "check/piece/mesh.hpp"
#include "check/piece/quality.hpp"
#include "check/piece/surface.hpp"
#include "check/piece/surface_edges.hpp"

namespace tessera::check {

/// @brief How a run matches points, whether the mesh may lack pieces, and what fits into memory.
struct CheckerOptions {
  VertexIdentity identity = VertexIdentity::ids;
  bool is_partial = false;
  CheckLimits limits{};
};

/// @brief One run of the checks, with points matched in one way. Every public function but
/// findings() is collective; call them in the order of their declaration.
class Checker {
 public:
  Checker(const PieceSource& tets, const PieceSource* boundary, const comm::Communicator& comm,
          CheckerOptions options);

  /// @brief Reads every piece once, batch by batch, and matches what they share.
  /// @return Whether the rest makes sense: false as soon as only a part of the pieces has point
  /// ids, so that none can be matched by them.
  /// @throws InputError on all ranks if a piece cannot be read.
  [[nodiscard]] bool match();

  /// @brief Whether the point ids turned out to be no names of points.
  [[nodiscard]] bool has_unusable_ids() const { return has_unusable_ids_; }

  /// @brief Reads pieces again for the shapes of their seam tets, now that the seams are known.
  /// @throws InputError on all ranks if a piece cannot be read, or is not what it was.
  void measure_seams();

  /// @param[in] id_findings What a run that matched by ids found out about the ids, or nullptr.
  [[nodiscard]] CheckReport report(const Findings* id_findings);

  /// @brief What this rank found.
  [[nodiscard]] const Findings& findings() const { return findings_; }

 private:
  // Sums over pieces, then over ranks.
  struct Counts {
    GlobalIndex num_pieces_with_point_ids = 0;  // Of both files.
    GlobalIndex num_tet_pieces_with_point_ids = 0;
    GlobalIndex num_pieces_with_cell_ids = 0;
    GlobalIndex num_pieces_with_subdomains = 0;
    GlobalIndex num_pieces_of_second_order = 0;
    GlobalIndex num_other_cells = 0;
    GlobalIndex num_boundary_pieces_without_tet = 0;
    GlobalIndex num_boundary_pieces_without_patch = 0;
    GlobalIndex num_vertices = 0;
    GlobalIndex num_edges = 0;
    GlobalIndex num_edge_halves = 0;
    GlobalIndex num_triangles = 0;
    GlobalIndex num_outside = 0;
    GlobalIndex num_seam = 0;
    GlobalIndex num_interface = 0;
    GlobalIndex num_unlisted = 0;
    GlobalIndex num_nonmanifold_edges = 0;
  };

  // Pieces of a file, from begin to end - 1.
  struct Range {
    LocalIndex begin = 0;
    LocalIndex end = 0;
  };

  // Rounds for which the boundary file is read at once, of num_rounds.
  struct TriangleRounds {
    std::uint64_t first = 0;
    std::uint64_t count = 1;
    std::uint64_t num_rounds = 1;
  };
  // A triangle of a surface of this rank.
  struct SurfaceRow {
    LocalIndex surface = 0;
    LocalIndex triangle = 0;
  };

  template <class Visit>
  void for_each_own_piece(Range range, bool is_boundary, const Visit& visit) const;
  template <class Visit>
  void for_each_own_listed(Range range, const Visit& visit) const;
  [[nodiscard]] Range batch_of(LocalIndex num_pieces, LocalIndex batch) const;
  [[nodiscard]] LocalIndex num_batches() const;
  [[nodiscard]] PieceMesh load(PieceName name, Findings& findings) const;
  void read_tets(PieceName name);
  void read_boundary(PieceName name, std::vector<VertexRecord>& vertices);
  void take_ids(const PieceMesh& mesh, const PieceSurface& surface);
  [[nodiscard]] bool settle_identity(GlobalIndex num_read);
  [[nodiscard]] bool read_batch(LocalIndex batch);
  [[nodiscard]] bool read_listed_vertices();
  [[nodiscard]] std::span<PieceSurface> surfaces_of(Range pieces);
  [[nodiscard]] std::vector<TriangleKey> read_listed_keys(Range pieces) const;
  [[nodiscard]] std::vector<TriangleSide> new_sides(Range pieces);
  [[nodiscard]] std::vector<VertexRecord> new_vertices(Range pieces);
  void match_batch(LocalIndex batch);
  [[nodiscard]] std::size_t num_open_triangles() const;
  void match_last_triangles();
  [[nodiscard]] std::vector<std::vector<TriangleRecord>> read_listed_triangles(
      TriangleRounds rounds) const;
  [[nodiscard]] std::vector<std::vector<SurfaceRow>> open_triangles(TriangleRounds rounds) const;
  void decide(TriangleRound round, std::vector<SurfaceRow> open,
              std::vector<TriangleRecord> records);
  void apply_all(std::span<const TriangleVerdict> verdicts);
  [[nodiscard]] PieceSurface& surface_of(LocalIndex piece);
  [[nodiscard]] std::vector<VertexFlags> flags_of(std::span<const PieceSurface> surfaces) const;
  void take_triangles();
  void match_last_edges();
  void match_last_edges(std::span<PieceSurface> surfaces, EdgeMatch& own);
  void match_last_vertices();
  void match_ids(std::vector<PointId> shared);
  void sum_over_ranks(Counts& counts) const;
  [[nodiscard]] GlobalIndex num_pieces() const;
  [[nodiscard]] std::vector<std::string> notes() const;
  [[nodiscard]] bool looks_partial(const Findings& findings) const;
  void set_counts(CheckReport& report) const;
  void set_sums(CheckReport& report);

  const PieceSource& tets_;
  const PieceSource* boundary_;
  const comm::Communicator& comm_;
  VertexIdentity identity_;
  bool is_partial_;
  CheckLimits limits_;

  Findings findings_{};
  Counts counts_{};
  bool has_splits_ = false;  // Points of a piece of this rank may be double on purpose.
  GlobalIndex num_components_ = 0;
  GlobalIndex num_boundary_components_ = 0;
  bool has_unusable_ids_ = false;

  TriangleMatcher triangles_;
  VertexMatcher vertices_;
  PeriodicMatcher periodic_{};
  SurfaceEdges edges_{};
  std::vector<TriangleRecord> inner_{};           // On two tets of a piece of the batch at hand.
  std::vector<VertexKey> seam_keys_{};            // Vertices that were found on a seam, to be told.
  std::vector<PieceSurface> surfaces_{};          // Of this rank's pieces of tets.
  std::vector<PieceRecords> records_{};           // Parallel to surfaces_.
  std::optional<mesh::MeshArrays> only_piece_{};  // If this rank has one piece of tets.
  std::vector<IdRun> point_ids_{};
  std::vector<IdRun> cell_ids_{};
  EdgeLengths edge_lengths_{};
  MeanRatioCounts mean_ratios_{};
  MeanRatioCounts seam_mean_ratios_{};
};

}  // namespace tessera::check

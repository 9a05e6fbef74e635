// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/base/shared_bytes.hpp"
#include "tessera/coarse/snap_vertices.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/fill/fill_try.hpp"
#include "tessera/improve/options.hpp"
#include "tessera/improve/region_mesh.hpp"
#include "tessera/io/options.hpp"
#include "tessera/jobs/job_runner.hpp"
#include "tessera/layers/grow_layers.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/model.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/piece_summary.hpp"
#include "tessera/subdomain/refine_piece.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"
#include "tessera/topology/split_patches.hpp"

/// Everything that runs in job processes because it calls NETGEN or OpenCASCADE, and the messages
/// that start it. A job's result is the bytes that the stage reads back.
namespace tessera::pipeline {

/// @brief Makes the worker of the program's job processes.
[[nodiscard]] std::unique_ptr<jobs::Worker> make_mesh_worker();

/// @brief load: the model. `scale`: output length units per file length unit.
[[nodiscard]] Bytes load_model_message(const model::ModelSource& source, double scale);

/// @brief load: coarse mesh, subdomains and their tables, and the output folder: the message of
/// share_mesh(), from memory that this rank shares.
[[nodiscard]] Bytes load_segment_message(const SegmentName& segment);

/// @brief load: the finished plan.
[[nodiscard]] Bytes load_limiter_message(const mesh::ProjectionLimiter& limiter);

/// @brief load: what piece files need besides the pieces. Given if that is known before any piece
/// is filled; then fill jobs write the files themselves. `counts` of all subdomains. Needs the
/// mesh.
[[nodiscard]] Bytes load_numbers_message(const std::vector<number::PieceCounts>& counts,
                                         const std::string& length_unit,
                                         const io::OutputOptions& options);

/// @brief load: that seams are to be improved, and how. Needs the mesh.
[[nodiscard]] Bytes load_improvement_message(const improve::ImproveOptions& options,
                                             std::optional<bool> split_corners,
                                             const std::vector<fill::KernelKind>& kernels);

/// @brief run: reads a CAD file; result: bytes of a ModelSource. Needs no load.
[[nodiscard]] Bytes import_request(const std::filesystem::path& file,
                                   const model::ImportOptions& options,
                                   model::StepReader reader = model::StepReader::with_names);

/// @brief run: where the triangles of an STL file bound no body; result: bytes of a
/// surface::SurfacePlaces. Needs no load.
[[nodiscard]] Bytes places_request(const std::filesystem::path& file);

/// @brief run: result: the diagonal of the model's box, output length unit, a double. Needs the
/// model.
[[nodiscard]] Bytes box_request();

/// @brief Reads the result of a box_request(). @throws InputError if it is no length.
[[nodiscard]] double box_diagonal_from_bytes(std::span<const std::byte> result);

/// @brief run: result: bytes of a model::ModelDescription in file length units. Needs the model.
/// @param[in] mesher As for netgen::describe_model().
[[nodiscard]] Bytes describe_request(surface::SurfaceMesher mesher);

/// @brief Reads the result of a describe_request(). @throws InputError if it is damaged.
[[nodiscard]] model::ModelDescription description_from_bytes(std::span<const std::byte> result);

/// @brief run: result: bytes of coarse::ModelFigures in output length units. Needs the model.
[[nodiscard]] Bytes figures_request();

/// @brief What one try at the coarse mesh has given.
struct CoarseTry {
  mesh::CoarseMesh mesh{};
  std::vector<LocalIndex> tet_part{};  ///< Shape (num_tets), if the model was cut.
  coarse::VertexDistance distance{};
  surface::Defeatured defeatured{};

  static auto fields(auto& self)
  {
    return std::tie(self.mesh, self.tet_part, self.distance, self.defeatured);
  }
};

/// @brief run: the coarse surface; result: bytes of a surface::CoarseSurface in file length units.
/// Needs the model.
/// @param[in] planes Into which parts the model is cut before; without nodes: not at all.
/// @param[in] rung   Number of the try, for the faults of tests.
[[nodiscard]] Bytes coarse_surface_request(const surface::CoarseOptions& options,
                                           const cut::CutTree& planes, LocalIndex rung);

/// @brief run: fills one domain of such a surface and makes its tets better; result: bytes of
/// surface::DomainTets. Needs the model.
[[nodiscard]] Bytes coarse_domain_request(surface::DomainSkin skin,
                                          const surface::CoarseOptions& options);

/// @brief run: puts the coarse mesh together and its vertices onto the geometry; result: bytes of a
/// CoarseTry. Needs the model.
/// @param[in] filled All domains, in their order.
[[nodiscard]] Bytes coarse_mesh_request(surface::CoarseSurface surface,
                                        std::vector<surface::DomainTets> filled,
                                        const surface::CoarseOptions& options,
                                        const cut::CutTree& planes);

/// @brief A coarse mesh with layers.
struct LayeredMesh {
  mesh::CoarseMesh mesh{};
  layers::LayerCover cover{};

  static auto fields(auto& self) { return std::tie(self.mesh, self.cover); }
};

/// @brief run: makes room for layers; result: bytes of a LayeredMesh. Needs the model.
/// @param[in] keep_tets As for layers::grow_layers().
[[nodiscard]] Bytes layer_request(const mesh::CoarseMesh& mesh,
                                  const std::vector<layers::LayerOptions>& layers, bool keep_tets);

/// @brief run: makes a coarse mesh ready to be opened; result: bytes of it. Needs the model.
/// @see topology::divide_at_rims()
[[nodiscard]] Bytes rim_request(const mesh::CoarseMesh& mesh, const topology::SplitOptions& splits);

/// @brief One subdomain that a plan job tests.
struct UntangleTest {
  LocalIndex subdomain = kNoIndex;
  fill::KernelKind kernel = fill::KernelKind::netgen;  ///< That the subdomain is for.
  int levels = 0;                                      ///< On which children must be positive.

  static auto fields(auto& self) { return std::tie(self.subdomain, self.kernel, self.levels); }
};

/// @brief run: tests subdomains for folds under the given limits; result: bytes of a
/// ProjectionLimiter with the new, smaller factors. Needs model and mesh.
[[nodiscard]] Bytes untangle_request(const std::vector<UntangleTest>& tests,
                                     const mesh::ProjectionLimiter& limiter);

/// @brief An angle that every piece beats, also one that has a tet without any.
inline constexpr double kAnyAngle = -1.0;

/// @brief What a fill job makes: the pieces of the subdomains first…last-1.
struct FillTask {
  LocalIndex batch = 0;  ///< Number of the record, and of the file if numbers are loaded.
  LocalIndex first = 0;
  LocalIndex last = 0;
  Hash128 plan{};                        ///< plan_fingerprint() of them.
  fill::FillTry how{};                   ///< The same for all.
  double angle_to_beat_deg = kAnyAngle;  ///< A piece whose smallest angle does not is an error.
  LocalIndex tries = 1;                  ///< Which try this is, from 1.
  bool was_limited = false;              ///< A try before it ended for time or memory.
  bool keep = true;                      ///< false: measure only and store nothing, for a replay.
  std::vector<std::string> failures{};   ///< What the tries before said, for the report.

  static auto fields(auto& self)
  {
    return std::tie(self.batch, self.first, self.last, self.plan, self.how, self.angle_to_beat_deg,
                    self.tries, self.was_limited, self.keep, self.failures);
  }
};

/// @brief run: refines, fills and checks subdomains and stores their record; result: bytes of their
/// FillResults. If one is folded there is no record. Needs model, mesh and plan.
[[nodiscard]] Bytes fill_request(const FillTask& task);

/// @brief One region of an improve job, and the tets that it lies in.
struct RegionToImprove {
  LocalIndex region = kNoIndex;
  std::vector<Bytes> bands{};  ///< Each of an improve::Band, in the order of the subdomains.

  static auto fields(auto& self) { return std::tie(self.region, self.bands); }
};

/// @brief run: improves some regions, each by itself; result: bytes of a vector of their
/// subdomain::RegionRecords, in their order. Needs mesh and improvement. Nothing is read or stored.
[[nodiscard]] Bytes improve_request(std::vector<RegionToImprove> regions);

/// @brief The mesh that such a job works on. Local.
[[nodiscard]] improve::RegionMesh region_mesh(const std::vector<Bytes>& bands,
                                              const improve::SeamRegions& regions,
                                              LocalIndex region);

/// @brief What jobs need to split pieces further.
struct RefineSettings {
  subdomain::PieceSplit split{};
  std::vector<number::PieceCounts> counts{};  ///< Of all pieces as they will be.
  std::string length_unit{};
  bool has_files = true;  ///< False: pieces go into the store.

  static auto fields(auto& self)
  {
    return std::tie(self.split, self.counts, self.length_unit, self.has_files);
  }
};

/// @brief load: that pieces are to be split further. Needs the mesh.
[[nodiscard]] Bytes load_refinement_message(const RefineSettings& settings,
                                            const io::OutputOptions& options);

/// @brief A piece that is to be split further.
struct PieceToRefine {
  mesh::Piece piece{};
  subdomain::PieceSurroundings around{};
  subdomain::PieceSummary before{};

  static auto fields(auto& self) { return std::tie(self.piece, self.around, self.before); }
};

/// @brief What a refine job makes: the pieces of one file, or one for the store.
struct RefineTask {
  LocalIndex batch = 0;                 ///< Number of the record and of the file.
  Hash128 plan{};                       ///< What they are made from.
  bool keep = true;                     ///< false: measure only and store nothing, for a replay.
  std::vector<PieceToRefine> pieces{};  ///< In the order of subdomains.

  static auto fields(auto& self) { return std::tie(self.batch, self.plan, self.keep, self.pieces); }
};

struct RefineTaskResult {
  std::vector<subdomain::FillResult> results{};
  std::vector<mesh::PointLimit> folds{};  ///< Of those that are folded.

  static auto fields(auto& self) { return std::tie(self.results, self.folds); }
};

/// @brief run: splits pieces further, checks them, and writes their file and record; result: bytes
/// of a RefineTaskResult. If one is folded nothing is written. Needs model, mesh, plan and
/// refinement.
[[nodiscard]] Bytes refine_request(const RefineTask& task);

/// @brief The skin of a subdomain, to be looked at.
struct SkinMesh {
  std::vector<double> vertex_xyz{};             ///< Shape (num_vertices, 3).
  std::vector<LocalIndex> triangle_vertices{};  ///< Shape (num_triangles, 3).

  static auto fields(auto& self) { return std::tie(self.vertex_xyz, self.triangle_vertices); }
};

/// @brief run: the skin of a subdomain; result: bytes of a SkinMesh. Needs model, mesh and plan.
[[nodiscard]] Bytes skin_request(LocalIndex subdomain);

}  // namespace tessera::pipeline

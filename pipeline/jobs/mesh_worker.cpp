// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/mesh_worker.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/coarse/make_room.hpp"
#include "tessera/coarse/optimize_interior.hpp"
#include "tessera/coarse/snap_vertices.hpp"
#include "tessera/layers/find_wakes.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/model/scaled_model.hpp"
#include "tessera/model/stl_file.hpp"
#include "tessera/model/triangle_surface.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/optimize/instruction_set.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/column_folds.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/improve_seam_region.hpp"
#include "tessera/subdomain/layer_tables.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_surface.hpp"
#include "tessera/subdomain/refine_piece.hpp"
#include "tessera/subdomain/seam_optimizer.hpp"
#include "tessera/surface/places.hpp"
#include "tessera/untangle/fold_test.hpp"

#include "pipeline/jobs/batch_filler.hpp"
#include "pipeline/jobs/replaceable_parts.hpp"
#include "pipeline/jobs/worker_messages.hpp"
#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

// What refine jobs start from.
struct Refinement {
  RefineSettings settings;
  io::OutputOptions output;
  subdomain::PieceRefiner refiner;
  number::IdLayout ids;
  std::optional<subdomain::LayerTables> layers{};  // After the split, of a mesh with layers.
};

const subdomain::LayerTables* get(const std::optional<subdomain::LayerTables>& layers)
{
  return layers ? &*layers : nullptr;
}

// Jobs allocate arrays and give them back all the time. Kept, their memory serves the next arrays;
// otherwise the kernel takes the pages away and clears them anew. Huge pages are hundreds of times
// fewer to touch. What loads have given back goes to the kernel: a job that uses such a page would
// first have to copy it. All are matters of speed only, so nothing is done about a refusal.
void renew_heap()
{
  constexpr int kLargestThreshold = 32 << 20;  // What is larger, malloc maps on its own.
  constexpr int kReserved = 512 << 20;         // Addresses, not memory; more is ordinary heap.
  constexpr std::size_t kMostBlocks = 64;
  constexpr std::uintptr_t kHugePage = 2 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestThreshold);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  ::malloc_trim(0);
  mallopt(M_TOP_PAD, kReserved);
  const auto old_end = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  std::vector<void*> blocks;  // Until one is behind the old end, which makes the heap longer.
  do {
    blocks.push_back(std::malloc(kLargestThreshold / 2));
  } while (reinterpret_cast<std::uintptr_t>(blocks.back()) < old_end
           && blocks.size() < kMostBlocks);
  const auto begin = (old_end + kHugePage - 1) & ~(kHugePage - 1);
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0)) & ~(kHugePage - 1);
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  for (void* const block : blocks) std::free(block);
  mallopt(M_TOP_PAD, kLargestThreshold);
}

// State of the model zygote; jobs are forked from it.
class MeshWorker final : public jobs::Worker {
 public:
  void load(std::span<const std::byte> message) override
  {
    std::visit([this](auto&& one) { take(std::move(one)); }, from_bytes<Load>(message));
    renew_heap();
  }

  Bytes run(std::span<const std::byte> request) override
  {
    return std::visit([this](const auto& one) { return this->answer(one); },
                      from_bytes<Request>(request));
  }

 private:
  void take(ModelLoad load)
  {
    scale_ = load.scale;
    netgen_model_ = netgen::load_model(load.source);
    scaled_model_ = std::make_unique<model::ScaledModel>(*netgen_model_, scale_);
  }

  // What belongs to the mesh of an earlier run goes with it.
  void take(MeshLoad load)
  {
    ids_.reset();
    layers_.reset();
    regions_.reset();
    refinement_.reset();
    limiter_ = {};
    cut_.reset();
    coarse_ = std::move(load.coarse);
    decomposition_ = std::move(load.decomposition);
    output_ = std::move(load.output);
    cut_.emplace(coarse_, decomposition_, std::move(load.tables));
    layers_ = subdomain::layer_tables(*cut_);
  }

  void take(const SegmentLoad& load)
  {
    take(std::get<MeshLoad>(from_shared_bytes<Load>(SharedBytes::map_segment(load.segment))));
  }

  void take(LimiterLoad load) { limiter_ = std::move(load.limiter); }

  void take(NumbersLoad load)
  {
    length_unit_ = std::move(load.length_unit);
    output_options_.compression = load.compression;
    output_options_.cell_quality = load.cell_quality;
    const auto levels = mesh::lattice_levels(cut_->skeleton, cut_->levels);
    ids_ = number::IdLayout::by_host(mesh::HostLayout(cut_->skeleton), levels, load.counts);
  }

  void take(ImprovementLoad load)
  {
    improve_options_ = load.options;
    split_corners_ = load.split_corners;
    kernels_ = std::move(load.kernels);
    regions_.emplace(cut_->skeleton, decomposition_);
  }

  void take(RefinementLoad load)
  {
    io::OutputOptions output{.compression = load.compression, .cell_quality = load.cell_quality};
    refinement_.emplace(Refinement{load.settings, std::move(output),
                                   subdomain::PieceRefiner(*cut_, load.settings.split),
                                   number::IdLayout::by_owner(load.settings.counts),
                                   subdomain::layer_tables(*cut_, load.settings.split.levels)});
  }

  [[nodiscard]] static Bytes answer(const ImportRequest& request)
  {
    return to_bytes(netgen::import_model(request.file, request.options, request.reader));
  }

  [[nodiscard]] static Bytes answer(const PlacesRequest& request)
  {
    return to_bytes(surface::find_places(model::welded_surface(model::read_stl(request.file))));
  }

  [[nodiscard]] Bytes answer(const BoxRequest& /*request*/) const
  {
    return to_bytes(scaled_model_->box_diagonal());
  }

  [[nodiscard]] Bytes answer(const DescribeRequest& request) const
  {
    return to_bytes(netgen::describe_model(*netgen_model_, request.mesher));
  }

  [[nodiscard]] Bytes answer(const FiguresRequest& /*request*/) const
  {
    coarse::ModelFigures figures = netgen::measure_model(*netgen_model_);
    figures.area *= scale_ * scale_;
    figures.volume *= scale_ * scale_ * scale_;
    return to_bytes(figures);
  }

  // The mesher works in file length units.
  [[nodiscard]] surface::CoarseOptions for_mesher(surface::CoarseOptions options) const
  {
    options.max_size /= scale_;
    options.defeature /= scale_;
    options.points = options.points.scaled(1.0 / scale_);
    for (surface::PeriodicPatches& side : options.periodic) {
      side.there.shift = (1.0 / scale_) * side.there.shift;
    }
    return options;
  }

  [[nodiscard]] std::unique_ptr<coarse::CoarseMesher> coarse_mesher() const
  {
    return netgen::make_coarse_mesher(*netgen_model_);
  }

  [[nodiscard]] Bytes answer(const CoarseSurfaceRequest& request) const
  {
    return to_bytes(coarse_mesher()->mesh_surface(for_mesher(request.options), request.planes));
  }

  [[nodiscard]] Bytes answer(const CoarseDomainRequest& request) const
  {
    return to_bytes(coarse_mesher()->mesh_domain(request.skin, for_mesher(request.options)));
  }

  [[nodiscard]] Bytes answer(const CoarseMeshRequest& request) const
  {
    cut::CutMesh filled = surface::fill_surface(request.surface, request.filled);
    const surface::Defeatured& merged = request.surface.defeatured;
    CoarseTry made{.distance = coarse::snap_vertices(filled.mesh, *netgen_model_, merged),
                   .defeatured = merged.scaled(scale_)};
    if (request.options.optimize) {
      coarse::optimize_interior(filled.mesh);
      if (!filled.tet_part.empty()) filled.tet_part = parts_of_tets(filled.mesh, request.planes);
    }
    coarse::make_room_for_arcs(filled, *netgen_model_);
    made.mesh = std::move(filled.mesh);
    made.tet_part = std::move(filled.tet_part);
    made.distance = made.distance.scaled(scale_);
    for (double& x : made.mesh.vertex_xyz) x *= scale_;
    netgen::name_curves(*netgen_model_, made.mesh);
    mesh::validate(made.mesh);
    return to_bytes(made);
  }

  [[nodiscard]] Bytes answer(const LayerRequest& request) const
  {
    LayeredMesh made{.mesh = request.mesh};
    topology::open_wakes(made.mesh,
                         layers::find_wakes(made.mesh, request.layers, request.keep_tets));
    made.cover = layers::grow_layers(made.mesh, request.layers, *scaled_model_, request.keep_tets);
    topology::close_joints(made.mesh);
    return to_bytes(made);
  }

  [[nodiscard]] Bytes answer(const RimRequest& request) const
  {
    mesh::CoarseMesh made = request.mesh;
    topology::divide_at_rims(made, request.splits, *scaled_model_);
    return to_bytes(made);
  }

  // After tets were flipped: by their centroids.
  [[nodiscard]] static std::vector<LocalIndex> parts_of_tets(const mesh::CoarseMesh& mesh,
                                                             const cut::CutTree& planes)
  {
    std::vector<LocalIndex> tet_part;
    for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
      const Vec3 centroid = tet_centroid(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t));
      tet_part.push_back(planes.part_of(mesh.tet_material[at(t)] - 1, centroid));
    }
    return tet_part;
  }

  [[nodiscard]] Bytes answer(const UntangleRequest& request) const
  {
    std::vector<mesh::PointLimit> all;
    for (const UntangleTest& test : request.tests) {
      const auto folds = folds_of(test, request.limiter);
      all.insert(all.end(), folds.begin(), folds.end());
    }
    return to_bytes(mesh::ProjectionLimiter(std::move(all)));
  }

  [[nodiscard]] std::vector<mesh::PointLimit> folds_of(const UntangleTest& test,
                                                       const mesh::ProjectionLimiter& limiter) const
  {
    if (is_left_out(Repair::held_back_points)) return {};
    const auto tets =
        untangle::tets_on_geometry(coarse_, cut_->tets[test.subdomain], cut_->on_geometry);
    const mesh::TetComplex complex = mesh::tet_complex(coarse_, cut_->skeleton, tets);
    refine::RefineContext context = refine_context(limiter);
    context.levels = context.levels.limited(test.levels);
    const mesh::RefinedLattice lattice = refine::refine_lattice(complex.faces, context);
    auto folds = untangle::find_folds(complex, cut_->skeleton, lattice, limiter);
    const auto of_layers =
        subdomain::find_column_folds(complex.faces, lattice, context, test.subdomain);
    // NETGEN begins with the skin alone if children are bad, and our optimiser untangles them. Both
    // need a sound skin: points are kept off the geometry only where it is not.
    if (test.kernel != fill::KernelKind::subdivide && !folds.empty()
        && !netgen::skin_overlaps(skin_of(context, test.subdomain))) {
      folds.clear();
    }
    folds.insert(folds.end(), of_layers.begin(), of_layers.end());
    return folds;
  }

  [[nodiscard]] Bytes answer(const FillTask& task) const
  {
    const auto kernel = replaceable_parts().fill_kernel(task.first);
    const auto other_model = replaceable_parts().model_of_fill(*scaled_model_, task.first);
    const refine::RefineContext context{.coarse = coarse_,
                                        .skeleton = cut_->skeleton,
                                        .model = other_model ? *other_model : *scaled_model_,
                                        .limiter = limiter_,
                                        .levels = cut_->levels,
                                        .measure_distance = true};
    std::optional<subdomain::WriteContext> numbers;
    if (ids_) {
      numbers.emplace(subdomain::WriteContext{.coarse = coarse_,
                                              .skeleton = cut_->skeleton,
                                              .ids = *ids_,
                                              .length_unit = length_unit_,
                                              .layers = get(layers_)});
    }
    BatchFiller batch(task, output_, numbers ? &*numbers : nullptr, output_options_);
    if (regions_ && kernels_[at(task.first)] != fill::KernelKind::subdivide) {
      batch.keep_seams(*regions_);
    }
    for (LocalIndex s = task.first; s < task.last; ++s) {
      batch.add(subdomain::fill_subdomain(*cut_, context, s, task.how, *kernel, get(layers_)));
    }
    return std::move(batch).finish();
  }

  // All subdomains of a region are of one material, and so have one kernel.
  [[nodiscard]] std::unique_ptr<improve::Optimizer> optimizer_of(LocalIndex region) const
  {
    const LocalIndex subdomain = regions_->subdomains_of(region).front();
    return subdomain::make_seam_optimizer(
        fill::splits_corners({.split_corners = split_corners_}, kernels_[at(subdomain)]));
  }

  [[nodiscard]] Bytes answer(const ImproveRequest& request) const
  {
    std::vector<subdomain::RegionRecord> improved;
    for (const auto& [region, bands] : request.regions) {
      const improve::RegionMesh mesh = region_mesh(bands, *regions_, region);
      const auto optimizer = replaceable_parts().optimizer(optimizer_of(region), region);
      improved.push_back(subdomain::improve_tets(mesh, improve_options_.rounds, *optimizer));
    }
    return to_bytes(improved);
  }

  [[nodiscard]] Bytes answer(const RefineTask& task) const
  {
    const Refinement& to = *refinement_;
    refine::RefineContext context = refine_context(limiter_);
    context.measure_distance = true;
    const mesh::HostLayout hosts(cut_->skeleton);
    const subdomain::WriteContext numbers{
        .coarse = coarse_,
        .skeleton = cut_->skeleton,
        .ids = to.ids,
        .length_unit = to.settings.length_unit,
        .places_of =
            [&](const mesh::Piece& piece) {
              return subdomain::places_of_split_piece(piece, hosts,
                                                      to.settings.counts[at(piece.subdomain)]);
            },
        .places_of_names =
            [&](std::span<const mesh::HostPoint> names) {
              return subdomain::places_of_split_names(names, hosts);
            },
        .layers = get(to.layers)};
    PieceBatch batch({.output = output_,
                      .record = refined_name(task.batch),
                      .file = task.batch,
                      .plan = task.plan,
                      .keep = task.keep},
                     to.settings.has_files ? &numbers : nullptr, to.output);
    RefineTaskResult made;
    for (const PieceToRefine& one : task.pieces) {
      subdomain::RefinedPiece refined =
          to.refiner.refine(one.piece, one.around, context, one.before, get(to.layers));
      made.folds.insert(made.folds.end(), refined.folds.begin(), refined.folds.end());
      batch.add(std::move(refined.filled));
    }
    made.results = std::move(batch).finish();
    return to_bytes(made);
  }

  [[nodiscard]] Bytes answer(const SkinRequest& request) const
  {
    fill::FillInput skin = skin_of(refine_context(limiter_), request.subdomain);
    return to_bytes(SkinMesh{std::move(skin.vertex_xyz), std::move(skin.triangle_vertices)});
  }

  [[nodiscard]] fill::FillInput skin_of(const refine::RefineContext& context,
                                        LocalIndex subdomain) const
  {
    const mesh::Complex complex = mesh::skin_complex(cut_->skeleton, subdomain);
    mesh::Skin skin = refine::extract_skin(complex, refine::refine_lattice(complex, context),
                                           cut_->skeleton, subdomain);
    return {.vertex_xyz = std::move(skin.vertex_xyz),
            .triangle_vertices = std::move(skin.triangle_vertices)};
  }

  [[nodiscard]] refine::RefineContext refine_context(const mesh::ProjectionLimiter& limiter) const
  {
    return {coarse_, cut_->skeleton, *scaled_model_, limiter, cut_->levels};
  }

  double scale_ = 1.0;
  std::unique_ptr<model::Model> netgen_model_{};
  std::unique_ptr<model::Model> scaled_model_{};
  mesh::CoarseMesh coarse_{};
  mesh::Decomposition decomposition_{};
  std::optional<subdomain::PartitionedMesh> cut_{};
  mesh::ProjectionLimiter limiter_{};
  std::filesystem::path output_{};
  std::optional<number::IdLayout> ids_{};           ///< If they are known before the pieces are.
  std::optional<subdomain::LayerTables> layers_{};  ///< Of a mesh with layers.
  std::string length_unit_{};
  io::OutputOptions output_options_{};
  improve::ImproveOptions improve_options_{};
  std::optional<bool> split_corners_{};
  std::vector<fill::KernelKind> kernels_{};        ///< By subdomain, as the case wants them.
  std::optional<improve::SeamRegions> regions_{};  ///< If seams are to be improved.
  std::optional<Refinement> refinement_{};         ///< If pieces are to be split further.
};

}  // namespace

std::unique_ptr<jobs::Worker> make_mesh_worker()
{
  renew_heap();
  // VTK looks for the range of each array it writes, and would start threads for that in each job.
  // Who has chosen a backend keeps it.
  ::setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);
  netgen::load_library();
  // Found once: to ask the processor takes long where it is a virtual one.
  static_cast<void>(optimize::available_instruction_sets());
  return std::make_unique<MeshWorker>();
}

}  // namespace tessera::pipeline

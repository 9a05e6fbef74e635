// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/mesh_worker.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/coarse/snap_vertices.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/model/scaled_model.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/refine/skin.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/untangle/fold_test.hpp"

#include "pipeline/jobs/batch_filler.hpp"
#include "pipeline/jobs/test_fault.hpp"
#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/region_records.hpp"

namespace tessera::pipeline {
namespace {

enum class Message : int {
  load_model,
  load_mesh,
  load_limiter,
  load_numbers,
  load_improvement,
  import,
  box,
  coarse,
  plan,
  fill,
  improve,
  improve_pieces,
  skin
};

FillTask get_fill_task(ByteReader& in)
{
  FillTask task;
  task.batch = in.get<LocalIndex>();
  task.first = in.get<LocalIndex>();
  task.last = in.get<LocalIndex>();
  task.plan = in.get<Hash128>();
  task.settings = in.get<fill::FillTry>();
  task.angle_to_beat_deg = in.get<double>();
  task.tries = in.get<LocalIndex>();
  task.was_limited = in.get<bool>();
  task.keep = in.get<bool>();
  task.failures = in.get_strings();
  return task;
}

// State of the model zygote; jobs are forked from it.
class MeshWorker final : public jobs::Worker {
 public:
  void load(std::span<const std::byte> message) override
  {
    ByteReader in(message);
    switch (in.get<Message>()) {
      case Message::load_model:
        return load_model(in);
      case Message::load_mesh:
        return load_mesh(in);
      case Message::load_limiter:
        limiter_ = mesh::projection_limiter_from_bytes(in.get_vector<std::byte>());
        return;
      case Message::load_numbers:
        return load_numbers(in);
      case Message::load_improvement:
        improve_options_ = in.get<improve::ImproveOptions>();
        regions_.emplace(cut_->skeleton, decomposition_);
        return;
      default:
        throw Error("load message of an unknown kind");
    }
  }

  Bytes run(std::span<const std::byte> request) override
  {
    ByteReader in(request);
    switch (in.get<Message>()) {
      case Message::import:
        return import(in);
      case Message::box:
        return box();
      case Message::coarse:
        return coarse(in);
      case Message::plan:
        return plan(in);
      case Message::fill:
        return fill(in);
      case Message::improve:
        return improve(in);
      case Message::improve_pieces:
        return improve_pieces(in);
      case Message::skin:
        return skin(in);
      default:
        throw Error("job request of an unknown kind");
    }
  }

 private:
  void load_model(ByteReader& in)
  {
    scale_ = in.get<double>();
    const Bytes source = in.get_vector<std::byte>();
    fail_if_asked("load");
    netgen_model_ = netgen::load_model(model::model_source_from_bytes(source));
    scaled_model_ = std::make_unique<model::ScaledModel>(*netgen_model_, scale_);
  }

  void load_mesh(ByteReader& in)
  {
    cut_.reset();
    coarse_ = mesh::coarse_mesh_from_bytes(in.get_vector<std::byte>());
    decomposition_ = mesh::decomposition_from_bytes(in.get_vector<std::byte>());
    levels_ = in.get<int>();
    const auto largest_size = in.get<double>();
    output_ = in.get_string();
    cut_.emplace(coarse_, decomposition_, largest_size);
  }

  void load_numbers(ByteReader& in)
  {
    const auto counts = in.get_vector<number::PieceCounts>();
    length_unit_ = in.get_string();
    output_options_.compression = in.get<io::Compression>();
    output_options_.cell_quality = in.get<bool>();
    ids_.emplace(mesh::HostLayout(cut_->skeleton), mesh::lattice::intervals(levels_), counts);
  }

  static Bytes import(ByteReader& in)
  {
    const std::filesystem::path file = in.get_string();
    fail_if_asked("import");
    return garbled_if_asked(
        "import", model::to_bytes(netgen::import_model(file, in.get<model::ImportOptions>())));
  }

  [[nodiscard]] Bytes box() const
  {
    fail_if_asked("box");
    ByteWriter out;
    out.put(scaled_model_->box_diagonal());
    return garbled_if_asked("box", std::move(out).take());
  }

  Bytes coarse(ByteReader& in)
  {
    auto options = in.get<coarse::CoarseOptions>();
    options.max_size /= scale_;
    const auto mesher = make_faulty_if_asked(netgen::make_coarse_mesher(*netgen_model_));
    mesh::CoarseMesh mesh = mesher->generate(options);
    coarse::VertexDistance distance = coarse::snap_vertices(mesh, *netgen_model_);
    distance.largest *= scale_;
    for (double& x : mesh.vertex_xyz) x *= scale_;
    mesh::validate(mesh);
    ByteWriter out;
    out.put(mesh::to_bytes(mesh));
    out.put(distance);
    return garbled_if_asked(stage_of(options), std::move(out).take());
  }

  Bytes plan(ByteReader& in)
  {
    const auto tests = in.get_vector<UntangleTest>();
    const mesh::ProjectionLimiter limiter =
        mesh::projection_limiter_from_bytes(in.get_vector<std::byte>());
    std::vector<mesh::PointLimit> all;
    for (const UntangleTest& test : tests) {
      const auto folds = folds_of(test, limiter);
      all.insert(all.end(), folds.begin(), folds.end());
    }
    return garbled_if_asked("plan", mesh::to_bytes(mesh::ProjectionLimiter(std::move(all))),
                            tests.front().subdomain);
  }

  [[nodiscard]] std::vector<mesh::PointLimit> folds_of(const UntangleTest& test,
                                                       const mesh::ProjectionLimiter& limiter) const
  {
    fail_if_asked("plan", test.subdomain);
    const auto tets =
        untangle::tets_on_geometry(coarse_, cut_->tets.of(test.subdomain), cut_->on_geometry);
    const mesh::TetComplex complex = mesh::tet_complex(coarse_, cut_->skeleton, tets);
    refine::RefineContext context = refine_context(limiter);
    context.levels = test.levels;
    const mesh::RefinedLattice lattice = refine::refine_lattice(complex.faces, context);
    auto folds = untangle::find_folds(complex, cut_->skeleton, lattice, limiter);
    // With bad children NETGEN begins with the skin alone, as long as that is sound: points are
    // kept off the geometry only where it is not.
    if (test.kernel == fill::KernelKind::netgen && !folds.empty()
        && !netgen::skin_overlaps(skin_of(context, test.subdomain))) {
      folds.clear();
    }
    return folds;
  }

  Bytes fill(ByteReader& in)
  {
    const FillTask task = get_fill_task(in);
    const auto kernel = make_faulty_if_asked(netgen::make_fill_kernel(), task.first);
    const auto nudged = nudged_if_asked(*scaled_model_, task.first);
    const refine::RefineContext context{.coarse = coarse_,
                                        .skeleton = cut_->skeleton,
                                        .model = nudged ? *nudged : *scaled_model_,
                                        .limiter = limiter_,
                                        .levels = levels_,
                                        .measure_distance = true};
    std::optional<subdomain::WriteContext> numbers;
    if (ids_)
      numbers.emplace(subdomain::WriteContext{coarse_, cut_->skeleton, *ids_, length_unit_});
    BatchFiller batch(task, output_, numbers ? &*numbers : nullptr, output_options_);
    for (LocalIndex s = task.first; s < task.last; ++s) {
      batch.add(subdomain::fill_subdomain(*cut_, context, s, task.settings, *kernel));
    }
    Bytes result = std::move(batch).finish();
    if (task.settings.kernel == fill::KernelKind::subdivide) return result;  // No third-party code.
    return garbled_if_asked("fill", std::move(result), task.first);
  }

  Bytes improve(ByteReader& in)
  {
    const auto region = in.get<LocalIndex>();
    const auto generation = in.get<int>();
    const io::RecordStore store(store_folder(output_));
    const auto pieces = pieces_around({*cut_, *regions_, store, generation}, region);
    store.put(region_name(region), improved(region, pieces));
    return {};
  }

  Bytes improve_pieces(ByteReader& in)
  {
    const auto region = in.get<LocalIndex>();
    std::vector<mesh::Piece> pieces;
    for (auto left = in.get<LocalIndex>(); left > 0; --left) {
      pieces.push_back(mesh::piece_from_bytes(in.get_vector<std::byte>()));
    }
    return improved(region, pieces);
  }

  [[nodiscard]] Bytes improved(LocalIndex region, const std::vector<mesh::Piece>& pieces) const
  {
    const auto optimizer = make_faulty_if_asked(netgen::make_optimizer(), region);
    subdomain::RegionRecord record = subdomain::improve_tets(
        subdomain::region_mesh(pieces, *regions_, region), improve_options_.rounds, *optimizer);
    lose_tet_if_asked(record.update, region);
    return to_bytes(record);
  }

  [[nodiscard]] Bytes skin(ByteReader& in) const
  {
    const auto subdomain = in.get<LocalIndex>();
    fail_if_asked("skin", subdomain);
    const fill::FillInput skin = skin_of(refine_context(limiter_), subdomain);
    ByteWriter out;
    out.put(skin.vertex_xyz);
    out.put(skin.triangle_vertices);
    return garbled_if_asked("skin", std::move(out).take(), subdomain);
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
    return {coarse_, cut_->skeleton, *scaled_model_, limiter, levels_};
  }

  double scale_ = 1.0;
  std::unique_ptr<model::Model> netgen_model_{};
  std::unique_ptr<model::Model> scaled_model_{};
  mesh::CoarseMesh coarse_{};
  mesh::Decomposition decomposition_{};
  std::optional<subdomain::PartitionedMesh> cut_{};
  mesh::ProjectionLimiter limiter_{};
  int levels_ = 0;
  std::filesystem::path output_{};
  std::optional<number::IdLayout> ids_{};  ///< If they are known before the pieces are.
  std::string length_unit_{};
  io::OutputOptions output_options_{};
  improve::ImproveOptions improve_options_{};
  std::optional<improve::SeamRegions> regions_{};  ///< If seams are to be improved.
};

template <class... Values>
Bytes message(Message kind, const Values&... values)
{
  ByteWriter out;
  out.put(kind);
  (out.put(values), ...);
  return std::move(out).take();
}

// A job's arrays come and go: what one gives back serves the next, instead of pages that the kernel
// takes away and clears anew; and of huge pages a job touches hundreds of times fewer. Both are
// matters of speed only, so nothing is done about a refusal.
void keep_heap()
{
  constexpr int kLargestThreshold = 32 << 20;  // What is larger, malloc maps on its own.
  constexpr int kReserved = 512 << 20;         // Addresses, not memory; more is ordinary heap.
  constexpr std::uintptr_t kHugePage = 2 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestThreshold);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, kReserved);
  void* volatile grown = std::malloc(kLargestThreshold / 2);  // Makes the heap longer by the pad.
  const auto begin = (reinterpret_cast<std::uintptr_t>(grown) + kHugePage - 1) & ~(kHugePage - 1);
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0)) & ~(kHugePage - 1);
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  std::free(grown);
  mallopt(M_TOP_PAD, kLargestThreshold);
}

}  // namespace

std::unique_ptr<jobs::Worker> make_mesh_worker()
{
  keep_heap();
  return std::make_unique<MeshWorker>();
}

Bytes load_model_message(const model::ModelSource& source, double scale)
{
  return message(Message::load_model, scale, model::to_bytes(source));
}

Bytes load_mesh_message(const mesh::CoarseMesh& coarse, const mesh::Decomposition& decomposition,
                        int levels, double largest_size, const std::filesystem::path& output)
{
  return message(Message::load_mesh, mesh::to_bytes(coarse), mesh::to_bytes(decomposition), levels,
                 largest_size, output.string());
}

Bytes load_numbers_message(const std::vector<number::PieceCounts>& counts,
                           const std::string& length_unit, const io::OutputOptions& options)
{
  return message(Message::load_numbers, counts, length_unit, options.compression,
                 options.cell_quality);
}

Bytes load_limiter_message(const mesh::ProjectionLimiter& limiter)
{
  return message(Message::load_limiter, mesh::to_bytes(limiter));
}

Bytes import_request(const std::filesystem::path& file, const model::ImportOptions& options)
{
  return message(Message::import, file.string(), options);
}

Bytes box_request() { return message(Message::box); }

double box_diagonal_from_bytes(std::span<const std::byte> result)
{
  const auto diagonal = ByteReader(result).get<double>();
  if (diagonal > 0.0 && std::isfinite(diagonal)) return diagonal;
  throw InputError("the model's box has no size");
}

Bytes coarse_request(const coarse::CoarseOptions& options)
{
  return message(Message::coarse, options);
}

Bytes untangle_request(const std::vector<UntangleTest>& tests,
                       const mesh::ProjectionLimiter& limiter)
{
  return message(Message::plan, tests, mesh::to_bytes(limiter));
}

Bytes skin_request(LocalIndex subdomain) { return message(Message::skin, subdomain); }

Bytes fill_request(const FillTask& task)
{
  return message(Message::fill, task.batch, task.first, task.last, task.plan, task.settings,
                 task.angle_to_beat_deg, task.tries, task.was_limited, task.keep, task.failures);
}

Bytes load_improvement_message(const improve::ImproveOptions& options)
{
  return message(Message::load_improvement, options);
}

Bytes improve_request(LocalIndex region, int generation)
{
  return message(Message::improve, region, generation);
}

Bytes improve_pieces_request(LocalIndex region, const std::vector<mesh::Piece>& pieces)
{
  ByteWriter out;
  out.put(Message::improve_pieces);
  out.put(region);
  out.put(static_cast<LocalIndex>(pieces.size()));
  for (const mesh::Piece& piece : pieces) out.put(mesh::to_bytes(piece));
  return std::move(out).take();
}

}  // namespace tessera::pipeline

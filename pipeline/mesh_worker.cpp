// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/mesh_worker.hpp"

#include <optional>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/fill/size_samples.hpp"
#include "tessera/io/piece_store.hpp"
#include "tessera/model/scaled_model.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/plan/fold_test.hpp"
#include "tessera/refine/skin.hpp"

#include "pipeline/fill_job.hpp"

namespace tessera::pipeline {
namespace {

enum class Message : int { load_model, load_mesh, load_plan, import, box, coarse, plan, fill };

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
      case Message::load_plan:
        damping_ = mesh::damping_from_bytes(in.get_vector<std::byte>());
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
      default:
        throw Error("job request of an unknown kind");
    }
  }

 private:
  void load_model(ByteReader& in)
  {
    scale_ = in.get<double>();
    const Bytes source = in.get_vector<std::byte>();
    netgen_model_ = netgen::load_model(model::model_source_from_bytes(source));
    scaled_model_ = std::make_unique<model::ScaledModel>(*netgen_model_, scale_);
  }

  void load_mesh(ByteReader& in)
  {
    coarse_ = mesh::coarse_mesh_from_bytes(in.get_vector<std::byte>());
    decomposition_ = mesh::decomposition_from_bytes(in.get_vector<std::byte>());
    levels_ = in.get<int>();
    piece_folder_ = in.get_string();
    skeleton_ = mesh::build_skeleton(coarse_, decomposition_);
    seam_units_ = mesh::units_on_seams(skeleton_, decomposition_);
    vertex_size_ = fill::vertex_sizes(coarse_);
  }

  static Bytes import(ByteReader& in)
  {
    const std::filesystem::path file = in.get_string();
    return model::to_bytes(netgen::import_model(file, in.get<model::ImportOptions>()));
  }

  [[nodiscard]] Bytes box() const
  {
    ByteWriter out;
    out.put(scaled_model_->box_diagonal());
    return std::move(out).take();
  }

  Bytes coarse(ByteReader& in)
  {
    auto options = in.get<coarse::CoarseOptions>();
    options.max_size /= scale_;
    mesh::CoarseMesh mesh = netgen::make_coarse_mesher(*netgen_model_)->generate(options);
    for (double& x : mesh.vertex_xyz) x *= scale_;
    mesh::validate(mesh);
    return mesh::to_bytes(mesh);
  }

  Bytes plan(ByteReader& in)
  {
    const auto subdomain = in.get<LocalIndex>();
    const mesh::Damping damping = mesh::damping_from_bytes(in.get_vector<std::byte>());
    const mesh::TetComplex complex = mesh::tet_complex(
        coarse_, skeleton_, plan::tets_on_geometry(coarse_, skeleton_, decomposition_, subdomain));
    const refine::RefineContext context = refine_context(damping);
    const mesh::RefinedLattice lattice = refine::refine_lattice(complex.faces, context);
    std::vector<mesh::PointDamping> folds = plan::find_folds(complex, skeleton_, lattice, damping);
    // Bad children do not matter to a kernel that meshes anew, as long as the skin is sound: points
    // are kept off the geometry only where it is not.
    if (!folds.empty() && !netgen::skin_overlaps(fill_input(context, subdomain))) folds.clear();
    return mesh::to_bytes(mesh::Damping(std::move(folds)));
  }

  Bytes fill(ByteReader& in)
  {
    const auto subdomain = in.get<LocalIndex>();
    const auto settings = in.get<fill::FillTry>();
    const auto angle_to_beat_deg = in.get<double>();
    const auto kernel = netgen::make_fill_kernel();
    refine::RefineContext context = refine_context(damping_);
    context.measure_distance = true;
    FilledPiece filled = fill_subdomain({context, decomposition_, seam_units_, vertex_size_},
                                        subdomain, *kernel, settings);
    if (filled.result.summary.tets.min_dihedral_deg <= angle_to_beat_deg) {
      throw MeshError("the fill is not better than the one before");
    }
    io::PieceStore(piece_folder_).put(subdomain, mesh::to_bytes(filled.piece));
    return to_bytes(filled.result);
  }

  [[nodiscard]] fill::FillInput fill_input(const refine::RefineContext& context,
                                           LocalIndex subdomain) const
  {
    const mesh::Complex complex = mesh::skin_complex(skeleton_, subdomain);
    mesh::Skin skin = refine::extract_skin(complex, refine::refine_lattice(complex, context),
                                           skeleton_, subdomain);
    return {.vertex_xyz = std::move(skin.vertex_xyz),
            .triangle_vertices = std::move(skin.triangle_vertices)};
  }

  [[nodiscard]] refine::RefineContext refine_context(const mesh::Damping& damping) const
  {
    return {coarse_, skeleton_, *scaled_model_, damping, levels_};
  }

  double scale_ = 1.0;
  std::unique_ptr<model::Model> netgen_model_{};
  std::unique_ptr<model::Model> scaled_model_{};
  mesh::CoarseMesh coarse_{};
  mesh::Decomposition decomposition_{};
  mesh::Skeleton skeleton_{};
  std::vector<char> seam_units_{};
  std::vector<double> vertex_size_{};
  mesh::Damping damping_{};
  int levels_ = 0;
  std::filesystem::path piece_folder_{};
};

template <class... Values>
Bytes message(Message kind, const Values&... values)
{
  ByteWriter out;
  out.put(kind);
  (out.put(values), ...);
  return std::move(out).take();
}

}  // namespace

std::unique_ptr<jobs::Worker> make_mesh_worker() { return std::make_unique<MeshWorker>(); }

Bytes load_model_message(const model::ModelSource& source, double scale)
{
  return message(Message::load_model, scale, model::to_bytes(source));
}

Bytes load_mesh_message(const mesh::CoarseMesh& coarse, const mesh::Decomposition& decomposition,
                        int levels, const std::filesystem::path& piece_folder)
{
  return message(Message::load_mesh, mesh::to_bytes(coarse), mesh::to_bytes(decomposition), levels,
                 piece_folder.string());
}

Bytes load_plan_message(const mesh::Damping& damping)
{
  return message(Message::load_plan, mesh::to_bytes(damping));
}

Bytes import_request(const std::filesystem::path& file, const model::ImportOptions& options)
{
  return message(Message::import, file.string(), options);
}

Bytes box_request() { return message(Message::box); }

Bytes coarse_request(const coarse::CoarseOptions& options)
{
  return message(Message::coarse, options);
}

Bytes plan_request(LocalIndex subdomain, const mesh::Damping& damping)
{
  return message(Message::plan, subdomain, mesh::to_bytes(damping));
}

Bytes fill_request(LocalIndex subdomain, const fill::FillTry& settings, double angle_to_beat_deg)
{
  return message(Message::fill, subdomain, settings, angle_to_beat_deg);
}

}  // namespace tessera::pipeline

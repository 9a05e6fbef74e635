// SPDX-License-Identifier: BSD-3-Clause
#include "faults/faulty_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tessera/improve/region_update.hpp"
#include "tessera/subdomain/improve_seam_region.hpp"

#include "pipeline/jobs/replaceable_parts.hpp"
#include "pipeline/jobs/worker_messages.hpp"

#include "faults/fault.hpp"

namespace tessera::testing {
namespace {

void drop_a_tet(std::vector<LocalIndex>& tet_vertices)
{
  tet_vertices.resize(tet_vertices.size() - 4);
}

// NETGEN loses a tet.
class FaultyKernel final : public fill::Kernel {
 public:
  [[nodiscard]] fill::FillOutput fill(const fill::FillInput& input,
                                      const fill::KernelSettings& settings) const override
  {
    fill::FillOutput output = netgen::make_fill_kernel()->fill(input, settings);
    drop_a_tet(output.tet_vertices);
    return output;
  }
};

// Loses a tet.
class FaultyOptimizer final : public improve::Optimizer {
 public:
  explicit FaultyOptimizer(std::unique_ptr<improve::Optimizer> sound) : sound_(std::move(sound)) {}

  [[nodiscard]] improve::TetMesh optimize(const improve::OptimizeInput& input,
                                          int rounds) const override
  {
    improve::TetMesh output = sound_->optimize(input, rounds);
    drop_a_tet(output.tet_vertices);
    return output;
  }

 private:
  std::unique_ptr<improve::Optimizer> sound_;
};

class NudgedModel final : public model::Model {
 public:
  explicit NudgedModel(const model::Model& sound) : sound_(sound) {}

  [[nodiscard]] bool has_parameters() const override { return sound_.has_parameters(); }
  [[nodiscard]] double surface_tolerance(LocalIndex surface) const override
  {
    return sound_.surface_tolerance(surface);
  }
  [[nodiscard]] double curve_tolerance(LocalIndex curve) const override
  {
    return sound_.curve_tolerance(curve);
  }
  [[nodiscard]] double end_tolerance(LocalIndex curve, const Vec3& point) const override
  {
    return sound_.end_tolerance(curve, point);
  }
  [[nodiscard]] double box_diagonal() const override { return sound_.box_diagonal(); }

  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override
  {
    return nudged(sound_.project_to_surface(surface, point, guess));
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override
  {
    return nudged(sound_.project_to_curve(curve, point, guess));
  }

 private:
  template <class Point>
  static Point nudged(Point point)
  {
    double& x = point.xyz[0];
    x = std::nextafter(x, std::numeric_limits<double>::infinity());
    return point;
  }

  const model::Model& sound_;
};

// Where faults are asked for.
struct Place {
  std::string_view stage{};
  LocalIndex item = kNoIndex;
};

std::string_view stage_of(const surface::CoarseOptions& options)
{
  if (options.mesher == surface::Mesher::gmsh) return "gmsh";
  return options.surface_mesher == surface::SurfaceMesher::remesh ? "remesh" : "coarse";
}

template <class Message>
Place place_of(const Message& /*message*/)
{
  return {};
}
Place place_of(const pipeline::ModelLoad& /*load*/) { return {"load"}; }
Place place_of(const pipeline::SegmentLoad& /*load*/) { return {"map"}; }
Place place_of(const pipeline::BoxRequest& /*request*/) { return {"box"}; }
Place place_of(const pipeline::CoarseDomainRequest& /*request*/) { return {"domain"}; }
Place place_of(const pipeline::LayerRequest& /*request*/) { return {"layers"}; }
Place place_of(const pipeline::RimRequest& /*request*/) { return {"rims"}; }
Place place_of(const pipeline::CoarseMeshRequest& request) { return {stage_of(request.options)}; }
Place place_of(const pipeline::CoarseSurfaceRequest& request)
{
  return {stage_of(request.options), request.rung};
}
Place place_of(const pipeline::ImportRequest& request)
{
  return {"import", static_cast<LocalIndex>(request.reader)};
}
Place place_of(const pipeline::DescribeRequest& request)
{
  return {"describe", static_cast<LocalIndex>(request.mesher)};
}
Place place_of(const pipeline::UntangleRequest& request)
{
  return {"plan", request.tests.front().subdomain};
}
Place place_of(const pipeline::FillTask& task)  // Other kernels are no third-party code.
{
  if (task.how.kernel != fill::KernelKind::netgen) return {};
  return {"fill", task.first};
}
Place place_of(const pipeline::ImproveRequest& request)  // Of the first region with a fault.
{
  for (const pipeline::RegionToImprove& one : request.regions) {
    if (!kind_at("improve", one.region).empty()) return {"improve", one.region};
  }
  return {};
}
Place place_of(const pipeline::RefineTask& task)
{
  return {"refine", task.pieces.front().piece.subdomain};
}
Place place_of(const pipeline::SkinRequest& request) { return {"skin", request.subdomain}; }

// A tet with two new corners has no face on the geometry: without one behind it, the merge of the
// piece would fail already.
void lose_a_tet(std::vector<improve::PieceUpdate>& updates)
{
  for (improve::PieceUpdate& update : updates) {
    std::vector<LocalIndex>& tets = update.tet_vertices;
    for (auto tet = tets.begin(); tet != tets.end(); tet += 4) {
      if (std::count_if(tet, tet + 4, [](LocalIndex v) { return v < 0; }) < 2) continue;
      tets.erase(tet, tet + 4);
      return;
    }
  }
}

// What a job gives in place of its result.
template <class Request>
Bytes spoilt(const Request& request, Bytes result)
{
  const Place place = place_of(request);
  return garbled_if_asked(place.stage, place.item, std::move(result));
}
Bytes spoilt(const pipeline::CoarseSurfaceRequest& /*request*/, Bytes result) { return result; }
Bytes spoilt(const pipeline::CoarseDomainRequest& request, Bytes result)
{
  if (kind_at(stage_of(request.options), kNoIndex) != "drop") return result;
  auto tets = from_bytes<surface::DomainTets>(result);
  drop_a_tet(tets.tet_vertices);
  return to_bytes(tets);
}
Bytes spoilt(const pipeline::ImproveRequest& request, Bytes result)
{
  auto records = from_bytes<std::vector<subdomain::RegionRecord>>(result);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (kind_at("improve", request.regions[i].region) == "lose") lose_a_tet(records[i].updates);
  }
  return garbled_if_asked("improve", place_of(request).item, to_bytes(records));
}

class FaultyWorker final : public jobs::Worker {
 public:
  void load(std::span<const std::byte> message) override
  {
    fail_before(from_bytes<pipeline::Load>(message));
    sound_->load(message);
  }

  [[nodiscard]] Bytes run(std::span<const std::byte> message) override
  {
    const auto request = from_bytes<pipeline::Request>(message);
    fail_before(request);
    return std::visit([&](const auto& one) { return spoilt(one, sound_->run(message)); }, request);
  }

 private:
  template <class Message>
  static void fail_before(const Message& message)
  {
    const Place place = std::visit([](const auto& one) { return place_of(one); }, message);
    fail_if_asked(place.stage, place.item);
  }

  std::unique_ptr<jobs::Worker> sound_ = pipeline::make_mesh_worker();
};

}  // namespace

void replace_parts()
{
  pipeline::ReplaceableParts& parts = pipeline::replaceable_parts();
  parts.before_sharing = fail_if_asked;
  parts.make_worker = [] { return std::make_unique<FaultyWorker>(); };
  parts.fill_kernel = [](LocalIndex first) -> std::unique_ptr<fill::Kernel> {
    if (kind_at("fill", first) != "drop") return netgen::make_fill_kernel();
    return std::make_unique<FaultyKernel>();
  };
  parts.model_of_fill = [](const model::Model& sound,
                           LocalIndex first) -> std::unique_ptr<model::Model> {
    if (kind_at("fill", first) != "nudge") return nullptr;
    return std::make_unique<NudgedModel>(sound);
  };
  parts.optimizer = [](std::unique_ptr<improve::Optimizer> wanted,
                       LocalIndex region) -> std::unique_ptr<improve::Optimizer> {
    if (kind_at("improve", region) != "drop") return wanted;
    return std::make_unique<FaultyOptimizer>(std::move(wanted));
  };
}

}  // namespace tessera::testing

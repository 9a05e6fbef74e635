// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "tessera/base/shared_bytes.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/jobs/mesh_worker.hpp"

/// What mesh_worker.hpp sends to the worker, one type for each message. The kind of a message is
/// its place in Load or Request.
namespace tessera::pipeline {

struct ModelLoad {
  double scale = 1.0;
  model::ModelSource source{};

  static auto fields(auto& self) { return std::tie(self.scale, self.source); }
};

struct MeshLoad {
  mesh::CoarseMesh coarse{};
  mesh::Decomposition decomposition{};
  subdomain::SubdomainTables tables{};
  std::string output{};

  static auto fields(auto& self)
  {
    return std::tie(self.coarse, self.decomposition, self.tables, self.output);
  }
};

/// @brief A MeshLoad whose message is in memory that the rank shares.
struct SegmentLoad {
  SegmentName segment{};

  static auto fields(auto& self) { return std::tie(self.segment); }
};

struct LimiterLoad {
  mesh::ProjectionLimiter limiter{};

  static auto fields(auto& self) { return std::tie(self.limiter); }
};

struct NumbersLoad {
  std::vector<number::PieceCounts> counts{};
  std::string length_unit{};
  io::Compression compression = io::Compression::none;
  bool cell_quality = false;

  static auto fields(auto& self)
  {
    return std::tie(self.counts, self.length_unit, self.compression, self.cell_quality);
  }
};

struct ImprovementLoad {
  improve::ImproveOptions options{};
  std::optional<bool> split_corners{};      ///< fill::FillOptions::split_corners.
  std::vector<fill::KernelKind> kernels{};  ///< Shape (num_subdomains), as the case wants them.

  static auto fields(auto& self)
  {
    return std::tie(self.options, self.split_corners, self.kernels);
  }
};

struct RefinementLoad {
  RefineSettings settings{};
  io::Compression compression = io::Compression::none;
  bool cell_quality = false;

  static auto fields(auto& self)
  {
    return std::tie(self.settings, self.compression, self.cell_quality);
  }
};

using Load = std::variant<ModelLoad, MeshLoad, SegmentLoad, LimiterLoad, NumbersLoad,
                          ImprovementLoad, RefinementLoad>;

struct ImportRequest {
  std::string file{};
  model::ImportOptions options{};
  model::StepReader reader = model::StepReader::with_names;

  static auto fields(auto& self) { return std::tie(self.file, self.options, self.reader); }
};

struct BoxRequest {
  static auto fields(auto& /*self*/) { return std::tie(); }
};

struct DescribeRequest {
  surface::SurfaceMesher mesher{};
  static auto fields(auto& self) { return std::tie(self.mesher); }
};

struct FiguresRequest {
  static auto fields(auto& /*self*/) { return std::tie(); }
};

struct CoarseSurfaceRequest {
  surface::CoarseOptions options{};
  cut::CutTree planes{};
  LocalIndex rung = 0;

  static auto fields(auto& self) { return std::tie(self.options, self.planes, self.rung); }
};

struct CoarseDomainRequest {
  surface::DomainSkin skin{};
  surface::CoarseOptions options{};

  static auto fields(auto& self) { return std::tie(self.skin, self.options); }
};

struct CoarseMeshRequest {
  surface::CoarseSurface surface{};
  std::vector<surface::DomainTets> filled{};  ///< All domains, in their order.
  surface::CoarseOptions options{};
  cut::CutTree planes{};

  static auto fields(auto& self)
  {
    return std::tie(self.surface, self.filled, self.options, self.planes);
  }
};

struct LayerRequest {
  mesh::CoarseMesh mesh{};
  std::vector<layers::LayerOptions> layers{};
  bool keep_tets = false;

  static auto fields(auto& self) { return std::tie(self.mesh, self.layers, self.keep_tets); }
};

struct RimRequest {
  mesh::CoarseMesh mesh{};
  topology::SplitOptions splits{};

  static auto fields(auto& self) { return std::tie(self.mesh, self.splits); }
};

struct UntangleRequest {
  std::vector<UntangleTest> tests{};
  mesh::ProjectionLimiter limiter{};

  static auto fields(auto& self) { return std::tie(self.tests, self.limiter); }
};

struct ImproveRequest {
  std::vector<RegionToImprove> regions{};

  static auto fields(auto& self) { return std::tie(self.regions); }
};

struct SkinRequest {
  LocalIndex subdomain = kNoIndex;

  static auto fields(auto& self) { return std::tie(self.subdomain); }
};

struct PlacesRequest {
  std::string file{};

  static auto fields(auto& self) { return std::tie(self.file); }
};

using Request = std::variant<ImportRequest, BoxRequest, CoarseSurfaceRequest, CoarseDomainRequest,
                             CoarseMeshRequest, UntangleRequest, FillTask, ImproveRequest,
                             RefineTask, SkinRequest, DescribeRequest, FiguresRequest,
                             PlacesRequest, LayerRequest, RimRequest>;

}  // namespace tessera::pipeline

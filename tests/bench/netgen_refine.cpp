// SPDX-License-Identifier: BSD-3-Clause
// NETGEN's own uniform refinement of the coarse mesh that Tessera makes: what vs_netgen_refine
// compares with.
//
//   netgen_refine MODEL LEVELS MAX_SIZE [GRADING [CURVATURE]]
//
// The coarse mesh is the one that the coarse mesher converts for Tessera, in NETGEN's own form and
// before NETGEN lets go of it, so both refine the same tets, for CSG, CAD files and STL alike.
// The last line printed is one JSON object: tets, CPU seconds of each refinement (one core, nothing
// else timed), qualities of the refined mesh by Tessera's own measure.
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <meshing.hpp>
#include <nlohmann/json.hpp>

#include "tessera/netgen/factory.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "netgen/mesh_conversion.hpp"
#include "netgen/model_mesher.hpp"

namespace tessera {
namespace {

struct Quality {
  std::size_t num_tets = 0;
  std::size_t num_inverted = 0;  // No positive volume.
  double min_mean_ratio = 1.0;
  double mean_mean_ratio = 0.0;
};

struct Refined {
  Quality coarse{};
  std::vector<double> cpu_s{};  // Of each level.
  Quality fine{};
};

// CPU time, so that what else runs on the machine does not matter.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

quality::TetCorners corners_of(const ::netgen::Mesh& mesh, const ::netgen::Element& element)
{
  quality::TetCorners corners;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto& point = mesh[element[netgen::kNetgenTetOrder[c]]];
    corners[c] = {point(0), point(1), point(2)};
  }
  return corners;
}

Quality quality_of(const ::netgen::Mesh& mesh)
{
  Quality quality;
  double sum = 0.0;
  for (const auto& element : mesh.VolumeElements()) {
    if (element.IsDeleted()) throw std::runtime_error("NETGEN's mesh has deleted elements");
    const double mean_ratio = quality::mean_ratio(corners_of(mesh, element));
    sum += mean_ratio;
    quality.min_mean_ratio = std::min(quality.min_mean_ratio, mean_ratio);
    if (!(mean_ratio > 0.0)) ++quality.num_inverted;
  }
  quality.num_tets = static_cast<std::size_t>(mesh.GetNE());
  quality.mean_mean_ratio = sum / static_cast<double>(quality.num_tets);
  return quality;
}

Refined refine(const std::string& file, int levels, const surface::CoarseOptions& options)
{
  const auto model = netgen::load_model(netgen::import_model(file, {}));
  const auto& loaded = dynamic_cast<const geometry::LoadedModel&>(*model);
  Refined refined;
  const mesh::CoarseMesh coarse = netgen::ModelMesher(loaded).generate(
      options, [&](const ::netgen::NetgenGeometry& geometry, ::netgen::Mesh& mesh) {
        refined.coarse = quality_of(mesh);
        const ::netgen::Refinement& refinement = geometry.GetRefinement();
        for (int level = 0; level < levels; ++level) {
          const double begin = cpu_seconds();
          refinement.Refine(mesh);
          refined.cpu_s.push_back(cpu_seconds() - begin);
        }
        refined.fine = quality_of(mesh);
      });
  const auto num_coarse_tets = static_cast<std::size_t>(coarse.num_tets());
  if (refined.coarse.num_tets != num_coarse_tets
      || refined.fine.num_tets != num_coarse_tets << (3 * levels)) {
    throw std::runtime_error("NETGEN refined another mesh than the coarse one");
  }
  return refined;
}

nlohmann::ordered_json to_json(const Quality& quality)
{
  return {{"num_tets", quality.num_tets},
          {"mean_ratio", {{"min", quality.min_mean_ratio}, {"mean", quality.mean_mean_ratio}}},
          {"num_inverted", quality.num_inverted}};
}

nlohmann::ordered_json to_json(const Refined& refined)
{
  double seconds = 0.0;
  for (const double level : refined.cpu_s) seconds += level;
  nlohmann::ordered_json json = to_json(refined.fine);
  json["coarse"] = to_json(refined.coarse);
  json["cpu_s_by_level"] = refined.cpu_s;
  json["cpu_s"] = seconds;
  json["tets_per_s"] = static_cast<double>(refined.fine.num_tets) / seconds;
  return json;
}

}  // namespace
}  // namespace tessera

int main(int argc, char** argv)
{
  if (argc < 4 || argc > 6 || std::atoi(argv[2]) < 1) {
    std::cerr << "usage: netgen_refine MODEL LEVELS MAX_SIZE [GRADING [CURVATURE]]\n";
    return 64;
  }
  tessera::surface::CoarseOptions options{.max_size = std::atof(argv[3])};
  if (argc > 4) options.grading = std::atof(argv[4]);
  if (argc > 5) options.curvature = std::atof(argv[5]);
  try {
    const auto refined = tessera::refine(argv[1], std::atoi(argv[2]), options);
    std::cout << tessera::to_json(refined).dump() << '\n';
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << "netgen_refine: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// Meshes a cube with the library alone: from a CAD file to checked tets, subdomain by subdomain.
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>

#include "tessera/decompose/decompose.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"

using namespace tessera;

// Returns the volume of the mesh. A program for real models runs the calls of NETGEN in a
// jobs::JobRunner, because they may crash.
double mesh_cube(int levels)
{
  std::ofstream("cube.geo") << "algebraic3d\n"
                               "solid cube = orthobrick (0, 0, 0; 1, 1, 1);\n"
                               "tlo cube;\n";
  const auto model = netgen::load_model(netgen::import_model("cube.geo", {}));
  const mesh::CoarseMesh coarse = netgen::make_coarse_mesher(*model)->generate({.max_size = 0.5});
  const auto cut = decompose::decompose(coarse, {.subdomains = 4},
                                        decompose::predicted_fine_tets(coarse, levels),
                                        *decompose::make_metis_partitioner());
  const subdomain::PartitionedMesh parts(coarse, cut.decomposition, levels);
  const mesh::ProjectionLimiter no_limits;
  const refine::RefineContext refine{coarse, parts.skeleton, *model, no_limits, levels};
  const auto kernel = netgen::make_fill_kernel();

  double volume = 0.0;
  for (LocalIndex s = 0; s < parts.num_subdomains(); ++s) {
    const auto [piece, result] = subdomain::fill_subdomain(parts, refine, s, {}, *kernel);
    volume += result.summary.volume;
    std::printf("subdomain %d: %d tets, mean ratio %.3f\n", s, piece.num_tets(),
                result.summary.tets.mean_mean_ratio());
  }
  return volume;
}

int main()
{
  try {
    const double volume = mesh_cube(2);
    std::printf("volume %.12f\n", volume);
    return std::abs(volume - 1.0) < 1e-9 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

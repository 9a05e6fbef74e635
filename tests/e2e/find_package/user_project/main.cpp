// SPDX-License-Identifier: BSD-3-Clause
// Meshes a cube with the library alone: from a CAD file to checked tets, subdomain by subdomain.
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <utility>

#include "tessera/decompose/decompose.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"
#include "tessera/fill/check.hpp"
#include "tessera/fill/size_samples.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/refine/skin.hpp"

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
  const mesh::Skeleton skeleton = mesh::build_skeleton(coarse, cut.decomposition);
  const mesh::ProjectionLimiter no_limits;
  const IndexLists tets_of = mesh::subdomain_tets(cut.decomposition);
  const std::vector<double> sizes = fill::vertex_sizes(coarse);
  const auto kernel = netgen::make_fill_kernel();

  double volume = 0.0;
  for (LocalIndex s = 0; s < cut.decomposition.num_subdomains(); ++s) {
    const mesh::Complex complex = mesh::skin_complex(skeleton, s);
    const auto lattice =
        refine::refine_lattice(complex, {coarse, skeleton, *model, no_limits, levels});
    mesh::Skin skin = refine::extract_skin(complex, lattice, skeleton, s);
    fill::FillInput input{.vertex_xyz = std::move(skin.vertex_xyz),
                          .triangle_vertices = std::move(skin.triangle_vertices)};
    fill::add_size_samples(coarse, tets_of[s], sizes, levels, input);
    const fill::FillOutput tets = kernel->fill(input, {});
    volume += fill::check_fill(input, tets).volume;
    std::printf("subdomain %d: %zu tets\n", s, tets.tet_vertices.size() / 4);
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

// SPDX-License-Identifier: BSD-3-Clause
// From a CAD file to mesh files: mpirun -n 2 mesh_from_cad part.step 5.0 DIR
#include <cstdio>
#include <cstdlib>

#include <tessera/tessera.hpp>

int main(int argc, char** argv)
{
  const tessera::Session session(argc, argv);  // First: it forks, then starts MPI.
  const tessera::comm::Communicator world = session.world();
  if (argc != 4) return 64;
  try {
    tessera::config::Case part;
    part.geometry.file = argv[1];
    part.size.target = std::atof(argv[2]);
    part.output.directory = argv[3];
    const tessera::MeshResult mesh = tessera::make_mesh(part, world);
    if (world.rank() == 0) std::printf("%.10g %s\n", mesh.volume, mesh.folder.c_str());
    return 0;
  } catch (const tessera::Error& error) {  // On all ranks.
    if (world.rank() == 0) std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// What a solver does with its share of a mesh: mpirun -n 3 mass_matrix DIR
//
// Assembles the mass matrix of linear elements, each rank the rows of its tets. The sum of all its
// entries is the volume; it must be the one in DIR/report.json. The points that ranks own must be
// all points, each counted once.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <tessera/tessera.hpp>

using tessera::LocalIndex;
using Row = std::map<LocalIndex, double>;  // By column.

double volume_of_tet(const tessera::MeshShare& mesh, std::size_t t)
{
  std::array<std::array<double, 3>, 3> edge{};
  const auto point = [&](std::size_t corner) {
    return 3 * static_cast<std::size_t>(mesh.tet_points[4 * t + corner]);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t d = 0; d < 3; ++d) {
      edge[i][d] = mesh.point_xyz[point(i + 1) + d] - mesh.point_xyz[point(0) + d];
    }
  }
  const auto& [a, b, c] = edge;
  return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
          + a[2] * (b[0] * c[1] - b[1] * c[0]))
         / 6.0;
}

std::vector<Row> assemble_mass_matrix(const tessera::MeshShare& mesh)
{
  std::vector<Row> matrix(mesh.point_ids.size());
  for (std::size_t t = 0; t < mesh.tet_ids.size(); ++t) {
    const double volume = volume_of_tet(mesh, t);
    for (std::size_t i = 0; i < 4; ++i) {
      Row& row = matrix[static_cast<std::size_t>(mesh.tet_points[4 * t + i])];
      for (std::size_t j = 0; j < 4; ++j) {
        row[mesh.tet_points[4 * t + j]] += volume / (i == j ? 10.0 : 20.0);
      }
    }
  }
  return matrix;
}

double reported_volume(const std::string& folder)
{
  std::ifstream file(folder + "/report.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string key = "\"volume\": ";
  return std::stod(text.substr(text.find(key) + key.size()));
}

bool matches_report(const std::string& folder, const tessera::comm::Communicator& world)
{
  const tessera::MeshShare mesh = tessera::read_mesh(folder, world);
  double volume = 0.0;
  for (const Row& row : assemble_mass_matrix(mesh)) {
    for (const auto& [column, value] : row) volume += value;
  }
  MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, world.handle());
  tessera::GlobalIndex num_owned = 0;
  for (const tessera::Rank owner : mesh.point_owner) num_owned += owner == world.rank() ? 1 : 0;
  num_owned = world.sum(num_owned);
  if (world.rank() == 0) {
    std::printf("volume %.12g, %lld points\n", volume, static_cast<long long>(num_owned));
  }
  return std::abs(volume / reported_volume(folder) - 1.0) < 1e-12
         && num_owned == mesh.num_global_points;
}

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);  // A program that only reads needs no tessera::Session.
  int status = 64;
  try {
    const tessera::comm::Communicator world(MPI_COMM_WORLD);
    if (argc == 2) status = matches_report(argv[1], world) ? 0 : 1;
  } catch (const tessera::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    status = 2;
  }
  MPI_Finalize();
  return status;
}

// SPDX-License-Identifier: BSD-3-Clause
// Sequential NETGEN from a CSG file to a written mesh, in one process: what vs_netgen compares
// with.
//
//   netgen_sequential MODEL.geo OUTPUT.vol MAX_SIZE [GRADING]
//
// All settings but the size (and the grading, if given) are NETGEN's defaults. Prints one JSON
// object: tets, wall seconds from reading to the written file, peak memory, quality. The quality is
// computed after the clock stopped.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include <csg.hpp>
#include <sys/resource.h>

// Defined in NETGEN's libraries and declared in none of its headers (6.2.1905).
namespace netgen {
extern DLL_HEADER MeshingParameters mparam;
}  // namespace netgen

namespace {

using Vector = netgen::Vec<3>;

struct Quality {
  double mean_ratio_mean = 0.0;
  double mean_ratio_min = 1.0;
  double min_dihedral_deg = 180.0;
};

std::unique_ptr<netgen::NetgenGeometry> read_geometry(const std::string& file)
{
  if (!std::ifstream(file)) throw std::runtime_error(file + ": cannot be read");
  for (const auto& reader : netgen::geometryregister) {
    if (auto* const geometry = reader->Load(file))
      return std::unique_ptr<netgen::NetgenGeometry>(geometry);
  }
  throw std::runtime_error(file + ": is not a NETGEN geometry");
}

std::shared_ptr<netgen::Mesh> make_mesh(const std::string& file)
{
  const auto geometry = read_geometry(file);
  std::shared_ptr<netgen::Mesh> mesh;
  if (geometry->GenerateMesh(mesh, netgen::mparam) != 0) throw std::runtime_error("NETGEN gave up");
  return mesh;
}

// 12 (3 V)^(2/3) over the sum of the squared edges: 1 for a regular tet.
double mean_ratio(const std::array<netgen::Point<3>, 4>& p)
{
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) squares += netgen::Dist2(p[i], p[j]);
  }
  const double six_volumes = std::abs(netgen::Cross(p[1] - p[0], p[2] - p[0]) * (p[3] - p[0]));
  return 12.0 * std::pow(0.5 * six_volumes, 2.0 / 3.0) / squares;
}

double min_dihedral_deg(const std::array<netgen::Point<3>, 4>& p)
{
  std::array<Vector, 4> inward;  // Unit normal of the face opposite to each corner, towards it.
  for (std::size_t c = 0; c < 4; ++c) {
    const auto& a = p[(c + 1) % 4];
    Vector normal = netgen::Cross(p[(c + 2) % 4] - a, p[(c + 3) % 4] - a);
    normal.Normalize();
    inward[c] = (p[c] - a) * normal < 0.0 ? -1.0 * normal : normal;
  }
  double largest_cosine = -1.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest_cosine = std::max(largest_cosine, -(inward[i] * inward[j]));
    }
  }
  return std::acos(std::clamp(largest_cosine, -1.0, 1.0)) * 180.0 / M_PI;
}

Quality quality_of(const netgen::Mesh& mesh)
{
  Quality quality;
  for (const auto& element : mesh.VolumeElements()) {
    const std::array<netgen::Point<3>, 4> p{mesh[element[0]], mesh[element[1]], mesh[element[2]],
                                            mesh[element[3]]};
    const double ratio = mean_ratio(p);
    quality.mean_ratio_mean += ratio / static_cast<double>(mesh.GetNE());
    quality.mean_ratio_min = std::min(quality.mean_ratio_min, ratio);
    quality.min_dihedral_deg = std::min(quality.min_dihedral_deg, min_dihedral_deg(p));
  }
  return quality;
}

std::size_t peak_rss_bytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024U;
}

// NETGEN's messages go to standard output; the JSON must stand there alone.
class NoMessages {
 public:
  NoMessages() : saved_(std::cout.rdbuf(said_.rdbuf()))
  {
    netgen::printmessage_importance = 0;
    ngcore::testout = &nothing_;
  }
  ~NoMessages() { std::cout.rdbuf(saved_); }
  NoMessages(const NoMessages&) = delete;
  NoMessages& operator=(const NoMessages&) = delete;

 private:
  std::ostringstream said_{};
  std::ostream nothing_{nullptr};
  std::streambuf* saved_;
};

int run(const std::string& model, const std::string& output)
{
  const auto start = std::chrono::steady_clock::now();
  std::shared_ptr<netgen::Mesh> mesh;
  {
    const NoMessages quiet;
    mesh = make_mesh(model);
    mesh->Save(output);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  const std::size_t peak = peak_rss_bytes();
  const Quality quality = quality_of(*mesh);
  std::cout << R"({ "num_tets": )" << mesh->GetNE() << R"(, "num_vertices": )" << mesh->GetNP()
            << R"(, "wall_time_s": )" << wall.count() << R"(, "peak_rss_bytes": )" << peak
            << R"(, "mean_ratio": { "min": )" << quality.mean_ratio_min << R"(, "mean": )"
            << quality.mean_ratio_mean << R"( }, "min_dihedral_deg": )" << quality.min_dihedral_deg
            << " }\n";
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 4 || argc > 5) {
    std::cerr << "usage: netgen_sequential MODEL.geo OUTPUT.vol MAX_SIZE [GRADING]\n";
    return 64;
  }
  netgen::mparam.maxh = std::atof(argv[3]);
  if (argc == 5) netgen::mparam.grading = std::atof(argv[4]);
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "netgen_sequential: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}

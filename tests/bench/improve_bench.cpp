// SPDX-License-Identifier: BSD-3-Clause
// Quality of the tets at the seams before and after they are improved, phase by phase.
//
//   improve_bench [--layers=N] [--rounds=N] [--fill-steps=N] [--check] LEVELS SUBDOMAINS_A_MATERIAL
//   MODEL=MAX_SIZE...
//
// Each model is cut, filled and improved with the settings given; one line a state: number of tets,
// then mean, 1st percentile and minimum of the mean ratio and the smallest dihedral angle, of all
// tets and of seam tets; the Kolmogorov-Smirnov distance between the mean ratios of seam tets and
// the others; CPU seconds; regions accepted and refused, and why. NETGEN runs in this process: for
// models that it can fill.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/quality/statistics.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/seam_optimizer.hpp"

#include "support/piece_sets.hpp"

#include "subject.hpp"

namespace {

using namespace tessera;

struct Settings {
  int levels = 2;
  int subdomains = 8;  // A material.
  int fill_steps = fill::KernelSettings{}.optimize_steps;
  int layers = improve::kDefaultLayers;
  bool with_check = false;
  int rounds = 1;
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void print_shapes(const quality::TetStatistics& shapes, const quality::Histogram& mean_ratios)
{
  std::printf(" | %8lld  %.4f %.4f %.4f %6.2f", static_cast<long long>(shapes.num_tets),
              shapes.mean_mean_ratio(), mean_ratios.percentile(0.01), shapes.min_mean_ratio,
              shapes.min_dihedral_deg);
}

void print_state(const std::string& name, const std::vector<mesh::Piece>& pieces, double seconds)
{
  quality::Histogram all(0.0, 1.0, 2000);
  quality::Histogram seam(0.0, 1.0, 2000);
  quality::ShapeSum sum_all(all);
  quality::ShapeSum sum_seam(seam);
  const auto on_seam = testing::vertices_on_seams(pieces);
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    for (LocalIndex t = 0; t < pieces[s].num_tets(); ++t) {
      const quality::TetShape shape = quality::shape_of(pieces[s].corners(t));
      const LocalIndex* v = &pieces[s].tet_vertices[4 * at(t)];
      const bool is_seam = std::any_of(v, v + 4, [&](LocalIndex i) { return on_seam[s][at(i)]; });
      sum_all.add(shape);
      if (is_seam) sum_seam.add(shape);
    }
  }
  std::printf("  %-8s", name.c_str());
  print_shapes(sum_all.statistics(), all);
  print_shapes(sum_seam.statistics(), seam);
  std::printf(" | KS %.3f | %6.2f s", quality::ks_distance(seam, all), seconds);
}

void print_regions(const testing::PhaseCount& count)
{
  std::printf(" | %d accepted, %zu refused, %d splits\n", count.num_accepted, count.refusals.size(),
              count.num_splits);
  std::map<std::string, int> reasons;
  for (const std::string& reason : count.refusals)
    ++reasons[reason.substr(0, reason.find(" from "))];
  for (const auto& [reason, times] : reasons) std::printf("      %d: %s\n", times, reason.c_str());
}

std::vector<mesh::Piece> fill_all(const testing::Subject& subject,
                                  const subdomain::PartitionedMesh& cut, const Settings& settings)
{
  const mesh::ProjectionLimiter no_limits;
  const refine::RefineContext refine{subject.coarse, cut.skeleton, *subject.model, no_limits,
                                     settings.levels};
  const auto kernel = netgen::make_fill_kernel();
  std::vector<mesh::Piece> pieces;
  for (LocalIndex s = 0; s < cut.num_subdomains(); ++s) {
    pieces.push_back(
        subdomain::fill_subdomain(cut, refine, s,
                                  {.settings = {.optimize_steps = settings.fill_steps}}, *kernel)
            .piece);
  }
  return pieces;
}

void require_sound(const std::vector<mesh::Piece>& pieces, double volume)
{
  const std::string flaw = testing::first_flaw(pieces);
  if (!flaw.empty()) throw MeshError(flaw);
  if (std::abs(testing::volume_of(pieces) - volume) > 1e-9 * volume) {
    throw MeshError("the volume has changed");
  }
}

// Runs the three phases on copies of the filled pieces.
void print_phases(const improve::SeamRegions& regions, const Settings& settings,
                  std::vector<mesh::Piece> pieces)
{
  const double volume = testing::volume_of(pieces);
  const auto optimizer = subdomain::make_seam_optimizer(false);
  testing::ImproveSetup setup{*optimizer};
  setup.layers = settings.layers;
  setup.rounds = settings.rounds;
  for (int phase = 0; phase < improve::kNumPhases; ++phase) {
    if (regions.first_of_phase(phase) == regions.first_of_phase(phase + 1)) continue;
    const double start = cpu_seconds();
    const testing::PhaseCount count = testing::improve_phase(regions, phase, setup, pieces);
    print_state("phase " + std::to_string(phase), pieces, cpu_seconds() - start);
    print_regions(count);
    std::fflush(stdout);
    if (settings.with_check) require_sound(pieces, volume);
  }
}

void print_table(const testing::Subject& subject, const Settings& settings)
{
  const int num_subdomains = settings.subdomains * subject.coarse.num_materials();
  const auto result =
      decompose::decompose(subject.coarse, {.subdomains = num_subdomains},
                           decompose::predicted_fine_tets(subject.coarse, settings.levels),
                           *decompose::make_metis_partitioner());
  const subdomain::PartitionedMesh cut(subject.coarse, result.decomposition, settings.levels);
  std::printf("%s: %d coarse tets, %d subdomains\n", subject.file.c_str(),
              subject.coarse.num_tets(), cut.num_subdomains());
  const double start = cpu_seconds();
  const std::vector<mesh::Piece> pieces = fill_all(subject, cut, settings);
  print_state("filled", pieces, cpu_seconds() - start);
  std::printf("\n");
  const improve::SeamRegions regions(cut.skeleton, cut.decomposition);
  print_phases(regions, settings, pieces);
}

// The value of an option "--name=value"; false if `argument` is another one.
bool is_option(std::string_view argument, std::string_view name, std::string& value)
{
  if (argument.substr(0, name.size()) != name) return false;
  value = argument.substr(name.size());
  return true;
}

Settings read_options(int argc, char** argv, int& next)
{
  Settings settings;
  std::string value;
  for (; next < argc && std::strncmp(argv[next], "--", 2) == 0; ++next) {
    const std::string_view argument = argv[next];
    if (is_option(argument, "--layers=", value))
      settings.layers = std::stoi(value);
    else if (is_option(argument, "--rounds=", value))
      settings.rounds = std::stoi(value);
    else if (is_option(argument, "--fill-steps=", value))
      settings.fill_steps = std::stoi(value);
    else if (argument == "--check")
      settings.with_check = true;
    else
      throw ConfigError("unknown option " + std::string(argument));
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    int next = 1;
    Settings settings = read_options(argc, argv, next);
    if (argc - next < 3) return 64;
    settings.levels = std::stoi(argv[next]);
    settings.subdomains = std::stoi(argv[next + 1]);
    for (int i = next + 2; i < argc; ++i) print_table(testing::Subject(argv[i]), settings);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "improve_bench: %s\n", error.what());
    return 2;
  }
}

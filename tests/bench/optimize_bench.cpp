// SPDX-License-Identifier: BSD-3-Clause
// Our optimiser beside NETGEN's, on the same tets in one process, in CPU time of one core.
//
//   optimize_bench [--schedule=NAME|STEPS]... [--set=INSTRUCTION_SET]... [--netgen] [--repeat=N]
//                  [--subdomains=N] [--untangle] LEVELS MODEL=MAX_SIZE...
//   optimize_bench [options] FILE.vtu...
//
// The tets are the children of each model's coarse tets, one subdomain a material or N of them, or
// those of files (of a run with fill.kernel = "subdivide"). One line a schedule and instruction
// set: seconds (the least of N, 3 unless said otherwise), thousands of the input's tets a second,
// number of tets, mean, 1st percentile and minimum of the mean ratio, smallest dihedral angle; how
// often faster than NETGEN. With --netgen its fill of the same children, one round as in a run, in
// turn with ours.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"
#include "tessera/fill/subdivide.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/optimize/optimize.hpp"
#include "tessera/quality/statistics.hpp"
#include "tessera/refine/lattice_refiner.hpp"
#include "tessera/refine/skin.hpp"

#include "subject.hpp"

namespace {

using namespace tessera;

struct NamedSchedule {
  std::string name;
  optimize::Schedule schedule;
};

struct Settings {
  std::vector<NamedSchedule> schedules{};
  std::vector<optimize::InstructionSet> sets{};
  bool with_netgen = false;
  bool untangle = false;
  int subdomains = 1;  // A material.
  int repeat = 3;
};

// Tets that are optimised apart, and what NETGEN needs to do the same.
struct Piece {
  optimize::TetMesh tets;
  fill::FillInput skin;  // With the tets as its start.
};

double cpu_seconds()
{
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Shapes {
 public:
  void add(const std::vector<double>& xyz, const std::vector<LocalIndex>& tet_vertices)
  {
    quality::Histogram histogram(0.0, 1.0, 2000);
    quality::ShapeSum sum(histogram);
    for (std::size_t t = 0; t < tet_vertices.size(); t += 4) {
      quality::TetCorners corners;
      for (std::size_t c = 0; c < 4; ++c) {
        corners[c] = point_at(std::span(xyz), tet_vertices[t + c]);
      }
      sum.add(quality::shape_of(corners));
    }
    all_.add(histogram);
    statistics_.add(sum.statistics());
  }

  void print() const
  {
    std::printf("  %8lld  %.4f %.4f %.4f %6.2f", static_cast<long long>(statistics_.num_tets),
                statistics_.mean_mean_ratio(), all_.percentile(0.01), statistics_.min_mean_ratio,
                statistics_.min_dihedral_deg);
  }

 private:
  quality::Histogram all_{0.0, 1.0, 2000};
  quality::TetStatistics statistics_{};
};

GlobalIndex num_tets_of(const std::vector<Piece>& pieces)
{
  GlobalIndex num = 0;
  for (const Piece& piece : pieces) num += std::ssize(piece.tets.tet_vertices) / 4;
  return num;
}

// Vertices of the boundary first, as a fill has them.
Piece make_piece(const std::vector<double>& xyz, const std::vector<LocalIndex>& tet_vertices)
{
  std::vector<LocalIndex> number(xyz.size() / 3, kNoIndex);
  Piece piece;
  const auto number_of = [&](LocalIndex v) {
    if (number[at(v)] == kNoIndex) {
      number[at(v)] = static_cast<LocalIndex>(piece.tets.vertex_xyz.size() / 3);
      const Vec3 p = point_at(std::span(xyz), v);
      piece.tets.vertex_xyz.insert(piece.tets.vertex_xyz.end(), p.begin(), p.end());
    }
    return number[at(v)];
  };
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    const LocalIndex* tet = &tet_vertices[4 * at(triangle.tets[0])];
    for (const std::size_t c : mesh::kTetFaceCorners[at(triangle.corners[0])]) {
      piece.skin.triangle_vertices.push_back(number_of(tet[c]));
    }
  }
  piece.skin.vertex_xyz = piece.tets.vertex_xyz;
  for (const LocalIndex v : tet_vertices) piece.tets.tet_vertices.push_back(number_of(v));
  piece.skin.start = {piece.tets.vertex_xyz, piece.tets.tet_vertices};
  return piece;
}

mesh::Decomposition decompose(const testing::Subject& subject, int levels, int subdomains)
{
  if (subdomains == 1) return subject.decomposition;
  return decompose::decompose(subject.coarse,
                              {.subdomains = subdomains * subject.coarse.num_materials()},
                              decompose::predicted_fine_tets(subject.coarse, levels),
                              *decompose::make_metis_partitioner())
      .decomposition;
}

std::vector<Piece> pieces_of_model(const testing::Subject& subject, int levels, int subdomains)
{
  const mesh::Decomposition decomposition = decompose(subject, levels, subdomains);
  const mesh::Skeleton skeleton = mesh::build_skeleton(subject.coarse, decomposition);
  const mesh::ProjectionLimiter no_limits;
  const refine::RefineContext context{subject.coarse, skeleton, *subject.model, no_limits, levels};
  const IndexLists tets = mesh::subdomain_tets(decomposition);
  std::vector<Piece> pieces;
  for (LocalIndex s = 0; s < std::ssize(tets.offsets) - 1; ++s) {
    const mesh::TetComplex complex = mesh::tet_complex(subject.coarse, skeleton, tets[s]);
    const fill::FillOutput children =
        fill::subdivide(complex, refine::refine_lattice(complex.faces, context));
    pieces.push_back(make_piece(children.vertex_xyz, children.tet_vertices));
  }
  return pieces;
}

struct Timed {
  double seconds = std::numeric_limits<double>::infinity();
  Shapes shapes{};
};

template <class Function>  // (const Piece&) -> something with vertex_xyz and tet_vertices
Timed time_pieces(const std::vector<Piece>& pieces, const Function& run)
{
  Timed result{.seconds = 0.0};
  for (const Piece& piece : pieces) {
    const double start = cpu_seconds();
    const auto tets = run(piece);
    result.seconds += cpu_seconds() - start;
    result.shapes.add(tets.vertex_xyz, tets.tet_vertices);
  }
  return result;
}

struct Contender {
  std::string name;
  optimize::Schedule schedule;
  optimize::InstructionSet set;
  Timed best{};
};

void print_line(const std::string& name, const Timed& timed, GlobalIndex num_tets,
                double netgen_seconds)
{
  std::printf("  %-22s %8.3f s %7.0f k/s", name.c_str(), timed.seconds,
              static_cast<double>(num_tets) / timed.seconds / 1e3);
  timed.shapes.print();
  if (netgen_seconds > 0.0) std::printf("  %6.1f x", netgen_seconds / timed.seconds);
  std::printf("\n");
}

void keep_faster(Timed& best, const Timed& other)
{
  if (other.seconds < best.seconds) best = other;
}

void run_contenders(const std::vector<Piece>& pieces, const Settings& settings,
                    std::vector<Contender>& contenders)
{
  for (int i = 0; i < settings.repeat; ++i) {
    for (Contender& contender : contenders) {
      keep_faster(contender.best, time_pieces(pieces, [&](const Piece& piece) {
                    return optimize::optimize(
                        piece.tets, contender.schedule,
                        {.untangle = settings.untangle, .instruction_set = contender.set});
                  }));
    }
  }
}

void print_table(const std::string& name, const std::vector<Piece>& pieces,
                 const Settings& settings)
{
  const GlobalIndex num_tets = num_tets_of(pieces);
  std::printf("%s: %lld tets in %zu pieces\n", name.c_str(), static_cast<long long>(num_tets),
              pieces.size());
  Shapes before;
  for (const Piece& piece : pieces) before.add(piece.tets.vertex_xyz, piece.tets.tet_vertices);
  std::printf("  %-45s", "before");
  before.print();
  std::printf("\n");

  Timed netgen;
  if (settings.with_netgen) {
    const auto kernel = netgen::make_fill_kernel();
    netgen = time_pieces(pieces, [&](const Piece& piece) { return kernel->fill(piece.skin, {}); });
    print_line("NETGEN", netgen, num_tets, 0.0);
  }
  std::vector<Contender> contenders;
  for (const NamedSchedule& schedule : settings.schedules) {
    for (const optimize::InstructionSet set : settings.sets) {
      contenders.push_back(
          {schedule.name + " " + std::string(optimize::name_of(set)), schedule.schedule, set});
    }
  }
  run_contenders(pieces, settings, contenders);
  for (const Contender& contender : contenders) {
    print_line(contender.name, contender.best, num_tets,
               settings.with_netgen ? netgen.seconds : 0.0);
  }
  std::fflush(stdout);
}

NamedSchedule named_schedule(const std::string& name)
{
  if (name == "fast") return {name, optimize::fast_schedule()};
  if (name == "standard") return {name, optimize::standard_schedule()};
  if (name == "thorough") return {name, optimize::thorough_schedule()};
  return {name, {.steps = optimize::parse_steps(name)}};
}

optimize::InstructionSet named_set(const std::string& name)
{
  for (const optimize::InstructionSet set : optimize::available_instruction_sets()) {
    if (optimize::name_of(set) == name) return set;
  }
  throw ConfigError("instruction set " + name + " is not available");
}

// The value of an option "--name=value"; none if `argument` is another one.
std::optional<std::string> value_of(std::string_view argument, std::string_view name)
{
  if (argument.substr(0, name.size()) != name) return std::nullopt;
  return std::string(argument.substr(name.size()));
}

Settings read_options(int argc, char** argv, int& next)
{
  Settings settings;
  for (; next < argc && std::strncmp(argv[next], "--", 2) == 0; ++next) {
    const std::string_view argument = argv[next];
    if (const auto name = value_of(argument, "--schedule=")) {
      settings.schedules.push_back(named_schedule(*name));
    } else if (const auto set = value_of(argument, "--set=")) {
      settings.sets.push_back(named_set(*set));
    } else if (const auto repeat = value_of(argument, "--repeat=")) {
      settings.repeat = std::stoi(*repeat);
    } else if (const auto subdomains = value_of(argument, "--subdomains=")) {
      settings.subdomains = std::stoi(*subdomains);
    } else if (argument == "--untangle") {
      settings.untangle = true;
    } else if (argument == "--netgen") {
      settings.with_netgen = true;
    } else {
      throw ConfigError("unknown option " + std::string(argument));
    }
  }
  if (settings.schedules.empty()) {
    for (const char* name : {"fast", "standard", "thorough"}) {
      settings.schedules.push_back(named_schedule(name));
    }
  }
  if (settings.sets.empty()) settings.sets = {optimize::available_instruction_sets().back()};
  return settings;
}

bool is_piece_file(std::string_view name)
{
  return name.size() > 4 && name.substr(name.size() - 4) == ".vtu";
}

void run_all(int argc, char** argv)
{
  int next = 1;
  const Settings settings = read_options(argc, argv, next);
  std::vector<Piece> pieces;
  for (; next < argc && is_piece_file(argv[next]); ++next) {
    const mesh::MeshArrays arrays = io::read_vtu(argv[next]);
    pieces.push_back(make_piece(arrays.point_xyz, arrays.cell_points));
  }
  if (!pieces.empty()) print_table("files", pieces, settings);
  if (next >= argc) return;
  const int levels = std::stoi(argv[next]);
  for (int i = next + 1; i < argc; ++i) {
    print_table(argv[i], pieces_of_model(testing::Subject(argv[i]), levels, settings.subdomains),
                settings);
  }
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    run_all(argc, argv);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "optimize_bench: %s\n", error.what());
    return 2;
  }
}

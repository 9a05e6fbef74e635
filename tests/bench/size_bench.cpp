// SPDX-License-Identifier: BSD-3-Clause
// Edge lengths of NETGEN's fills over the wanted length at the same place.
//
//   size_bench LEVELS SUBDOMAINS MODEL=MAX_SIZE...
//
// The wanted length h(x) is the coarse mesh's own size, interpolated and divided by 2^LEVELS: the
// background size of a fill. At an edge's middle it is that of the nearest sample. Prints
// percentiles of length / h for each model. NETGEN runs in this process: for models that it can
// fill.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tessera/decompose/decompose.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"
#include "tessera/fill/size_samples.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/mesh/tet_edges.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/refine/skin.hpp"

#include "subject.hpp"

namespace {

using namespace tessera;

// Finds the nearest sample in a grid of cells of the largest size.
class SampleGrid {
 public:
  explicit SampleGrid(const fill::FillInput& input)
      : input_(input), width_(*std::max_element(input.size_h.begin(), input.size_h.end()))
  {
    for (std::size_t i = 0; i < input.size_h.size(); ++i) {
      cells_[cell_of(point(i))].push_back(i);
    }
  }

  [[nodiscard]] double size_near(const Vec3& p) const
  {
    double nearest = std::numeric_limits<double>::max();
    double size = 0.0;
    for (int reach = 1; size == 0.0; ++reach) visit(p, reach, nearest, size);
    return size;
  }

 private:
  using Cell = std::tuple<long, long, long>;

  [[nodiscard]] Vec3 point(std::size_t i) const
  {
    return point_at(std::span<const double>(input_.size_xyz), i);
  }

  [[nodiscard]] Cell cell_of(const Vec3& p) const
  {
    return {std::lround(p[0] / width_), std::lround(p[1] / width_), std::lround(p[2] / width_)};
  }

  void visit(const Vec3& p, int reach, double& nearest, double& size) const
  {
    const auto [x, y, z] = cell_of(p);
    for (long i = x - reach; i <= x + reach; ++i) {
      for (long j = y - reach; j <= y + reach; ++j) {
        for (long k = z - reach; k <= z + reach; ++k) {
          const auto cell = cells_.find({i, j, k});
          if (cell == cells_.end()) continue;
          for (const std::size_t s : cell->second) {
            const double distance = norm(point(s) - p);
            if (distance >= nearest) continue;
            nearest = distance;
            size = input_.size_h[s];
          }
        }
      }
    }
  }

  const fill::FillInput& input_;
  double width_;
  std::map<Cell, std::vector<std::size_t>> cells_{};
};

// Length over wanted length of every edge of one subdomain's fill.
std::vector<double> ratios_of(const testing::Subject& subject, const mesh::Skeleton& skeleton,
                              std::span<const LocalIndex> tets, LocalIndex subdomain, int levels)
{
  const mesh::ProjectionLimiter no_limits;
  const mesh::Complex complex = mesh::skin_complex(skeleton, subdomain);
  const auto lattice = refine::refine_lattice(
      complex, {subject.coarse, skeleton, *subject.model, no_limits, levels});
  mesh::Skin skin = refine::extract_skin(complex, lattice, skeleton, subdomain);
  fill::FillInput input{.vertex_xyz = std::move(skin.vertex_xyz),
                        .triangle_vertices = std::move(skin.triangle_vertices)};
  fill::add_size_samples(subject.coarse, tets, fill::vertex_sizes(subject.coarse, levels), levels,
                         input);
  const fill::FillOutput filled = netgen::make_fill_kernel()->fill(input, {});
  const SampleGrid wanted(input);
  const std::span<const double> xyz(filled.vertex_xyz);
  std::vector<double> ratios;
  mesh::for_each_edge(filled.tet_vertices, static_cast<LocalIndex>(filled.vertex_xyz.size() / 3),
                      [&](LocalIndex a, LocalIndex b) {
                        const Vec3 p = point_at(xyz, a);
                        const Vec3 q = point_at(xyz, b);
                        ratios.push_back(norm(q - p) / wanted.size_near(midpoint(p, q)));
                      });
  return ratios;
}

void print_table(const testing::Subject& subject, int levels, int num_subdomains)
{
  const auto cut = decompose::decompose(subject.coarse, {.subdomains = num_subdomains},
                                        decompose::predicted_fine_tets(subject.coarse, levels),
                                        *decompose::make_metis_partitioner());
  const mesh::Skeleton skeleton = mesh::build_skeleton(subject.coarse, cut.decomposition);
  const IndexLists tets = mesh::subdomain_tets(cut.decomposition);
  std::vector<double> all;
  for (LocalIndex s = 0; s < cut.decomposition.num_subdomains(); ++s) {
    const auto ratios = ratios_of(subject, skeleton, tets[s], s, levels);
    all.insert(all.end(), ratios.begin(), ratios.end());
  }
  std::sort(all.begin(), all.end());
  std::printf("%s: %zu edges, length / h", subject.file.c_str(), all.size());
  for (const double share : {0.01, 0.1, 0.5, 0.9, 0.99}) {
    const auto place = static_cast<std::size_t>(share * static_cast<double>(all.size() - 1));
    std::printf("  %g %%: %.3f", 100.0 * share, all[place]);
  }
  const auto below = std::lower_bound(all.begin(), all.end(), 1.6) - all.begin();
  std::printf("  below 1.6: %.2f %%\n",
              100.0 * static_cast<double>(below) / static_cast<double>(all.size()));
}

}  // namespace

int main(int argc, char** argv)
{
  try {
    for (int i = 3; i < argc; ++i) {
      print_table(testing::Subject(argv[i]), std::stoi(argv[1]), std::stoi(argv[2]));
    }
    return argc > 3 ? 0 : 64;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "size_bench: %s\n", error.what());
    return 2;
  }
}

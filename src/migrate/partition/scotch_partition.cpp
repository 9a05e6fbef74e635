// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <ptscotch.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/partition.hpp"

namespace tessera::migrate {
namespace {

static_assert(sizeof(SCOTCH_Num) == sizeof(GlobalIndex), "meshes have more than 2^31 faces");

// Parts may be larger than the average by this share; the rest of the 3 % is for repairs.
constexpr double kImbalance = 0.01;

struct Closer {
  void operator()(SCOTCH_Dgraph* graph) const
  {
    SCOTCH_dgraphExit(graph);
    SCOTCH_memFree(graph);
  }
  void operator()(SCOTCH_Strat* strategy) const
  {
    SCOTCH_stratExit(strategy);
    SCOTCH_memFree(strategy);
  }
  void operator()(SCOTCH_Context* context) const
  {
    SCOTCH_contextExit(context);
    SCOTCH_memFree(context);
  }
};
template <class T>
using Handle = std::unique_ptr<T, Closer>;

// The graph of tets as PT-Scotch wants it: vertices numbered over all ranks.
struct DualGraph {
  std::vector<SCOTCH_Num> offsets{0};
  std::vector<SCOTCH_Num> neighbours{};
};

DualGraph make_graph(const comm::Communicator& comm, const DistributedMesh& mesh,
                     const TetNeighbours& neighbours)
{
  const LocalIndex num_tets = mesh.num_tets();
  std::vector<GlobalIndex> numbers(at(num_tets));
  std::iota(numbers.begin(), numbers.end(), comm.sum_of_lower_ranks(num_tets));
  const std::vector<GlobalIndex> remote = values_behind(comm, neighbours, numbers);
  DualGraph graph;
  graph.neighbours.reserve(4 * at(num_tets));
  for (LocalIndex t = 0; t < num_tets; ++t) {
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex behind = neighbours.behind[4 * at(t) + c];
      if (behind == kNoIndex) continue;
      graph.neighbours.push_back(behind < num_tets ? numbers[at(behind)]
                                                   : remote[at(behind - num_tets)]);
    }
    graph.offsets.push_back(static_cast<SCOTCH_Num>(graph.neighbours.size()));
  }
  return graph;
}

// One thread and a fixed seed: the result must not depend on when a message comes.
Handle<SCOTCH_Context> make_context(int seed)
{
  Handle<SCOTCH_Context> context(SCOTCH_contextAlloc());
  SCOTCH_contextInit(context.get());
  SCOTCH_contextOptionSetNum(context.get(), SCOTCH_OPTIONNUMDETERMINISTIC, 1);
  SCOTCH_contextThreadSpawn(context.get(), 1, nullptr);
  SCOTCH_contextRandomSeed(context.get(), seed);
  SCOTCH_contextRandomReset(context.get());
  return context;
}

Handle<SCOTCH_Dgraph> alloc_graph(const comm::Communicator& comm)
{
  Handle<SCOTCH_Dgraph> graph(SCOTCH_dgraphAlloc());
  SCOTCH_dgraphInit(graph.get(), comm.handle());
  return graph;
}

// @return Whether it went well.
bool part_graph(const comm::Communicator& comm, DualGraph& dual, LocalIndex num_parts, int seed,
                std::vector<SCOTCH_Num>& part)
{
  const auto context = make_context(seed);
  const auto graph = alloc_graph(comm);
  const auto bound = alloc_graph(comm);
  const auto num_tets = static_cast<SCOTCH_Num>(dual.offsets.size()) - 1;
  const auto num_entries = static_cast<SCOTCH_Num>(dual.neighbours.size());
  constexpr SCOTCH_Num kFirstNumber = 0;
  if (SCOTCH_dgraphBuild(graph.get(), kFirstNumber, num_tets, num_tets, dual.offsets.data(),
                         nullptr, nullptr, nullptr, num_entries, num_entries,
                         dual.neighbours.data(), nullptr, nullptr)
      != 0)
    return false;
  if (SCOTCH_contextBindDgraph(context.get(), graph.get(), bound.get()) != 0) return false;
  const Handle<SCOTCH_Strat> strategy(SCOTCH_stratAlloc());
  SCOTCH_stratInit(strategy.get());
  if (SCOTCH_stratDgraphMapBuild(strategy.get(), SCOTCH_STRATQUALITY, comm.size(), num_parts,
                                 kImbalance)
      != 0)
    return false;
  part.resize(static_cast<std::size_t>(num_tets) + 1);  // Never null.
  return SCOTCH_dgraphPart(bound.get(), num_parts, strategy.get(), part.data()) == 0;
}

}  // namespace

std::vector<LocalIndex> partition_tets(const comm::Communicator& comm, const DistributedMesh& mesh,
                                       const TetNeighbours& neighbours, LocalIndex num_parts,
                                       int seed)
{
  std::vector<LocalIndex> tet_part(mesh.tet_ids.size(), 0);
  if (num_parts == 1) return tet_part;
  DualGraph graph = make_graph(comm, mesh, neighbours);
  std::vector<SCOTCH_Num> part;
  const bool is_good = part_graph(comm, graph, num_parts, seed, part);
  comm.throw_if_any<MeshError>(is_good ? std::nullopt
                                       : std::optional<std::string>("PT-Scotch failed"));
  for (std::size_t t = 0; t < tet_part.size(); ++t) tet_part[t] = static_cast<LocalIndex>(part[t]);
  return tet_part;
}

void require_partitioner(LocalIndex /*num_parts*/) {}

std::string scotch_version()
{
  int major = 0;
  int minor = 0;
  int patch = 0;
  SCOTCH_version(&major, &minor, &patch);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace tessera::migrate

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/share_stage.hpp"

#include <functional>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <malloc.h>

#include "tessera/comm/share_on_node.hpp"

#include "pipeline/jobs/replaceable_parts.hpp"
#include "pipeline/jobs/worker_messages.hpp"

namespace tessera::pipeline {
namespace {

SharedBytes share(const std::function<MeshLoad()>& make, RunContext& context)
{
  comm::NodeShare made = comm::share_on_node(
      context.comm, [&] { return Load(make()); },
      [&] { replaceable_parts().before_sharing("share", context.comm.rank()); });
  const bool is_copy = !made.obstacle.empty();
  if (const GlobalIndex num_copies = context.comm.sum(is_copy ? 1 : 0); num_copies > 0) {
    context.log.info(fmt::format("coarse mesh: {} ranks have a copy of their own; {}", num_copies,
                                 is_copy ? made.obstacle : "other nodes cannot share memory"));
  }
  return std::move(made.bytes);
}

}  // namespace

SharedMesh share_mesh(RunResult& run, RunContext& context)
{
  mesh::CoarseMesh& coarse = run.coarse.mesh;
  mesh::Decomposition& decomposition = run.decomposition.decomposition;
  SharedBytes message = share(
      [&] {
        auto tables =
            subdomain::make_tables(coarse, decomposition, run.levels.shifted(-run.splits));
        return MeshLoad{std::move(coarse), std::move(decomposition), std::move(tables),
                        context.folder.string()};
      },
      context);
  auto mesh = std::get<MeshLoad>(from_shared_bytes<Load>(message));
  coarse = std::move(mesh.coarse);
  decomposition = std::move(mesh.decomposition);
  ::malloc_trim(0);  // The stages before had copies of all this; the fills need the memory.
  return {std::move(message), std::move(mesh.tables)};
}

SharedBytes share_message(const subdomain::PartitionedMesh& cut, RunContext& context)
{
  return share(
      [&] {
        return MeshLoad{cut.coarse, cut.decomposition, cut, context.folder.string()};
      },
      context);
}

}  // namespace tessera::pipeline

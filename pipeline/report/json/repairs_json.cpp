// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/repairs_json.hpp"

#include <string>
#include <utility>

#include "tessera/base/repair.hpp"

namespace tessera::pipeline {
namespace {

// Of the fills: their records say it, so a resumed run knows it too.
void add_repairs_of_fills(const RunResult& run, RepairCounts& repairs)
{
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    if (piece.tries > 1) repairs.add(Repair::fill_tries);
    if (piece.kernel != run.kernels[at(piece.subdomain)]) repairs.add(Repair::subdivided_fills);
  }
  const std::size_t num_held_back = run.limiter.entries().size() - run.num_straightened;
  repairs.add(Repair::held_back_points, static_cast<GlobalIndex>(num_held_back));
}

}  // namespace

Json repairs_json(const RunResult& run)
{
  RepairCounts repairs = run.import_repairs;
  repairs += run.coarse.repairs;
  add_repairs_of_fills(run, repairs);
  Json json = Json::object();
  for (const auto& [repair, name] : kEnumWords<Repair>) {
    if (repairs[repair] > 0) json[std::string(name)] = repairs[repair];
  }
  Json blocks{{"repairs", std::move(json)}};
  if (!left_out_repairs().empty()) blocks["left_out"] = names_of(left_out_repairs());
  return blocks;
}

}  // namespace tessera::pipeline

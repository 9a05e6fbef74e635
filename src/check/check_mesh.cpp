// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/check/check_mesh.hpp"

#include <optional>
#include <utility>

#include "check/check_limits.hpp"
#include "check/checker.hpp"

namespace tessera::check {
namespace {

CheckReport check_by_positions(const PieceSource& tets, const PieceSource* boundary,
                               const comm::Communicator& comm, const CheckOptions& options,
                               const CheckLimits& limits, const Findings* id_findings)
{
  Checker checker(tets, boundary, comm, {VertexIdentity::positions, options.is_partial, limits});
  static_cast<void>(checker.match());  // Ids do not matter.
  checker.measure_seams();
  return checker.report(id_findings);
}

}  // namespace

CheckReport check_mesh(const PieceSource& tets, const PieceSource* boundary,
                       const comm::Communicator& comm, const CheckOptions& options)
{
  return check_mesh(tets, boundary, comm, options, CheckLimits{});
}

CheckReport check_mesh(const PieceSource& tets, const PieceSource* boundary,
                       const comm::Communicator& comm, const CheckOptions& options,
                       const CheckLimits& limits)
{
  std::optional<Checker> by_ids(std::in_place, tets, boundary, comm,
                                CheckerOptions{VertexIdentity::ids, options.is_partial, limits});
  const bool has_ids = by_ids->match();
  if (has_ids && !by_ids->has_unusable_ids()) {
    by_ids->measure_seams();
    return by_ids->report(nullptr);
  }
  const Findings id_findings = by_ids->findings();
  by_ids.reset();  // Frees its tables, for the other run needs as much.
  return check_by_positions(tets, boundary, comm, options, limits,
                            has_ids ? &id_findings : nullptr);
}

}  // namespace tessera::check

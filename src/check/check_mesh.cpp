// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/check/check_mesh.hpp"

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
  Checker checker(tets, boundary, comm, {VertexIdentity::ids, options.is_partial, limits});
  if (!checker.match()) return check_by_positions(tets, boundary, comm, options, limits, nullptr);
  if (checker.has_unusable_ids())
    return check_by_positions(tets, boundary, comm, options, limits, &checker.findings());
  checker.measure_seams();
  return checker.report(nullptr);
}

}  // namespace tessera::check

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <mpi.h>

#include "tessera/check/check_mesh.hpp"

#include "check/check_limits.hpp"
#include "mesh_files.hpp"

namespace tessera::testing {

/// @brief So few that small meshes have several rounds, and their boundary files several readings.
inline constexpr check::CheckLimits kTightLimits{.num_triangles_in_reading = 50,
                                                 .num_triangles_in_round = 7};

/// @brief Report of the files by all ranks; those of one rank alone, and with tight limits, must
/// have the same bits.
inline check::CheckReport check_everywhere(const MeshFiles& files,
                                           const check::CheckOptions& options = {})
{
  const check::PieceSource tets = source_of(files.tets);
  const check::PieceSource boundary = source_of(files.boundary);
  const check::PieceSource* boundary_or_none = files.boundary.empty() ? nullptr : &boundary;
  const comm::Communicator world(MPI_COMM_WORLD);
  const comm::Communicator self(MPI_COMM_SELF);
  const check::CheckReport report = check::check_mesh(tets, boundary_or_none, world, options);
  EXPECT_EQ(to_json(report), to_json(check::check_mesh(tets, boundary_or_none, self, options)));
  if (world.size() <= 3) {  // Enough; a round takes long on more ranks than cores.
    EXPECT_EQ(to_json(report),
              to_json(check::check_mesh(tets, boundary_or_none, world, options, kTightLimits)));
  }
  EXPECT_EQ(report.conforms, report.defects.empty());
  return report;
}

/// @brief Number of defects of a kind.
inline GlobalIndex count(const check::CheckReport& report, const std::string& kind)
{
  for (const check::Defect& defect : report.defects)
    if (defect.kind == kind) return defect.count;
  return 0;
}

/// @brief Whether an offender of the kind is named with all of these words.
inline bool names(const check::CheckReport& report, const std::string& kind,
                  const std::vector<std::string>& words)
{
  for (const check::Defect& defect : report.defects) {
    if (defect.kind != kind) continue;
    for (const std::string& offender : defect.offenders) {
      if (std::all_of(words.begin(), words.end(), [&](const std::string& word) {
            return offender.find(word) != std::string::npos;
          }))
        return true;
    }
  }
  return false;
}

}  // namespace tessera::testing

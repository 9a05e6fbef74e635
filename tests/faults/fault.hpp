// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/jobs/job_runner.hpp"

/// Where third-party code is called, a job of the tests' program fails for real as the environment
/// variable TESSERA_TEST_FAULT asks.
///
/// Its value is words "STAGE=KIND", for every job of the stage, or "STAGE=KIND@ITEM".
/// - STAGE: import, load, box, describe, coarse, remesh (the coarse mesh from the CAD system's
///   triangles), gmsh (that of Gmsh), domain (the tets in one of its domains), layers, rims, plan,
///   fill, improve, refine, skin; share (memory of the node: in the rank itself), map (the same: in
///   its worker); join (the workers of the node: in the rank itself).
/// - KIND, for any job: throw, segv, exit, loop, sleep, memory; hold (the job goes on when the file
///   "hold" in the folder of the run is gone, so a test can meet it at this place).
/// - KIND, for results that a check must refuse: drop (a tet of the result is lost: coarse, remesh,
///   fill, improve), garbage (the bytes of the result are no longer what they were).
/// - KIND, for results that pass all checks of a job: nudge (fill: points on the geometry are one
///   bit off, as from another mathematical library), lose (improve: a tet is lost after the region
///   was judged).
/// - ITEM: of import 0, or 1 for OpenCASCADE's plain reader; of describe 0 for NETGEN's triangles,
///   1 for remeshed ones; the subdomain, of refine the first of the job; of improve the region; of
///   coarse, remesh and gmsh the try, from 0; of share and join the rank.
namespace tessera::testing {

/// @brief Checks TESSERA_TEST_FAULT, and lets no job have more than TESSERA_TEST_LIMITS allows, if
/// that is set: "CPU_S STALL_S MEMORY_GIB". Local.
/// @throws ConfigError else a misspelt name would make tests pass.
void obey_test_environment(jobs::JobRunner& jobs);

/// @brief The kind that is asked for at this place; empty if there is none. No stage: no place.
[[nodiscard]] std::string kind_at(std::string_view stage, LocalIndex item);

/// @brief Throws, dies, waits or never returns if that is asked for at this place.
void fail_if_asked(std::string_view stage, LocalIndex item);

/// @brief The result itself, or garbage if that is asked for at this place.
[[nodiscard]] Bytes garbled_if_asked(std::string_view stage, LocalIndex item, Bytes result);

}  // namespace tessera::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/batch_filler.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/filled_cube.hpp"

namespace tessera::pipeline {
namespace {

struct BatchFillerTest : testing::FilledCube {};

TEST_F(BatchFillerTest, FirstFillNeedNotBeatAnyAngle)
{
  subdomain::FilledPiece flat = pieces().front();
  flat.result.summary.tets.min_dihedral_deg = 0.0;  // A needle's, by rounding.
  const std::filesystem::path nowhere;
  FillTask task;
  task.keep = false;
  BatchFiller first(task, nowhere, nullptr, {});
  EXPECT_NO_THROW(first.add(flat));
  task.angle_to_beat_deg = 0.0;
  BatchFiller second(task, nowhere, nullptr, {});
  EXPECT_THROW(second.add(flat), MeshError);
}

}  // namespace
}  // namespace tessera::pipeline

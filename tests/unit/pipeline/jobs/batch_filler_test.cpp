// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/batch_filler.hpp"

#include <filesystem>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/io/record_store.hpp"

#include "pipeline/store/band_segments.hpp"
#include "support/filled_cube.hpp"
#include "support/temporary_folder.hpp"

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

TEST_F(BatchFillerTest, KeepsBandsOnlyIfSeamsAreToBeImproved)
{
  const testing::TemporaryFolder output;
  const improve::SeamRegions regions(body().skeleton, body().decomposition);
  ASSERT_FALSE(regions.regions_of(1, 0).empty());
  const auto num_segments = [&](const improve::SeamRegions* wanted) {
    const FillTask task{.batch = 1, .first = 1, .last = 2};
    BatchFiller batch(task, output.path(), nullptr, {});
    if (wanted != nullptr) batch.keep_seams(*wanted);
    batch.add(pieces()[1]);
    static_cast<void>(std::move(batch).finish());
    const io::RecordReader reader(store_folder(output.path()));
    return reader.num_segments(record_name(1));
  };
  const auto first_of_bands = static_cast<LocalIndex>(PieceSegment::bands);
  EXPECT_EQ(num_segments(nullptr), first_of_bands);
  EXPECT_EQ(num_segments(&regions), first_of_bands
                                        + static_cast<LocalIndex>(BandSegment::first_band)
                                        + static_cast<LocalIndex>(regions.regions_of(1, 0).size()));
}

}  // namespace
}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/part_layers.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::subdomain {
namespace {

using migrate::ColumnType;

const std::vector<migrate::TetColumn> kColumns{{"layer", ColumnType::int32},
                                               {"mean_ratio", ColumnType::float64},
                                               {"tet_of_prism", ColumnType::int32}};

migrate::MeshBlock block_of(std::vector<GlobalIndex> ids, std::vector<std::uint64_t> layer,
                            std::vector<std::uint64_t> of_prism)
{
  migrate::MeshBlock block{.tet_ids = std::move(ids)};
  block.tet_columns = {std::move(layer), std::vector<std::uint64_t>(block.tet_ids.size(), 7),
                       std::move(of_prism)};
  return block;
}

TEST(ColumnsOfLayers, GoFromTheTetsToTheWall)
{
  // A tet inside, a column of two prisms, one of a prism and a pyramid, one of two tets.
  const auto block = block_of({3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16},
                              {0, 2, 2, 2, 1, 1, 1, 2, 2, 2, 1, 1, 2, 1},
                              {0, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 0, 0});
  EXPECT_EQ(columns_of_layers(block, kColumns),
            (std::vector<LocalIndex>{0, 1, 1, 1, 1, 1, 1, 7, 7, 7, 7, 7, 12, 12}));
}

TEST(ColumnsOfLayers, OfOneLayerAreItsPrisms)
{
  const auto block = block_of({0, 1, 2, 3}, {1, 1, 1, 1}, {0, 1, 0, 1});
  EXPECT_EQ(columns_of_layers(block, kColumns), (std::vector<LocalIndex>{0, 0, 2, 2}));
}

TEST(ColumnsOfLayers, EndWhereIdsDo)
{
  const auto block = block_of({0, 1, 5, 6}, {2, 2, 1, 1}, {0, 1, 0, 1});
  EXPECT_EQ(columns_of_layers(block, kColumns), (std::vector<LocalIndex>{0, 0, 2, 2}));
}

TEST(ColumnsOfLayers, AreNoneWithoutTheArrays)
{
  migrate::MeshBlock block{.tet_ids = {0, 1}};
  EXPECT_EQ(columns_of_layers(block, {}), (std::vector<LocalIndex>{0, 1}));
}

}  // namespace
}  // namespace tessera::subdomain

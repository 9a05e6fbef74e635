// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/surface/surface_messages.hpp"

#include <gtest/gtest.h>

namespace tessera::netgen {
namespace {

TEST(SurfaceMessages, AFaceThatFailedTwiceIsTheEnd)
{
  SurfaceMessages messages;
  EXPECT_TRUE(messages.read(" Face 7 / 79 (parameter space projection)"));
  EXPECT_EQ(messages.verdict(), "");
  messages.read(" ERROR: Problem in Surface mesh generation");
  EXPECT_EQ(messages.verdict(), "NETGEN cannot mesh face 7 of 79");
  // NETGEN comes to a stop only after the others.
  messages.read(" Face 8 / 79 (parameter space projection)");
  messages.read(" ERROR: Problem in Surface mesh generation");
  EXPECT_EQ(messages.verdict(), "NETGEN cannot mesh face 7 of 79");
}

TEST(SurfaceMessages, TrialsWithoutElementsAreNoProgress)
{
  SurfaceMessages messages;
  EXPECT_TRUE(messages.read(" faces = 537 trials = 46000 elements = 46604 els/sec = 44555"));
  EXPECT_FALSE(messages.read(" faces = 537 trials = 47000 elements = 46604 els/sec = 43258"));
  EXPECT_TRUE(messages.read(" faces = 540 trials = 48000 elements = 46605 els/sec = 43200"));
}

TEST(SurfaceMessages, WarningsAreNoProgress)
{
  SurfaceMessages messages;
  EXPECT_FALSE(messages.read(" WARNING: hash"));
  EXPECT_TRUE(messages.read(" Edgeswapping, topological"));
}

TEST(SurfaceMessages, GapsThatCloseAreProgress)
{
  SurfaceMessages messages;
  messages.read(" 2678 open segments found");
  messages.read(" faces = 10 trials = 1000 elements = 900");
  EXPECT_TRUE(messages.read(" 36 open segments found"));
  EXPECT_FALSE(messages.read(" 36 open segments found"));
  EXPECT_FALSE(messages.read(" Meshing surface 2/23"));
  EXPECT_TRUE(messages.read(" 35 open segments found"));
  EXPECT_TRUE(messages.read(" 0 open segments found"));
  EXPECT_TRUE(messages.read(" Optimize Surface 1"));
}

TEST(SurfaceMessages, GapsThatStayAreTheEnd)
{
  SurfaceMessages messages;
  messages.read(" 2678 open segments found");
  messages.read(" faces = 10 trials = 1000 elements = 900");
  messages.read(" 30 open segments found");
  messages.read(" Meshing failed, trying to refine");
  messages.read(" 133 open segments found");
  messages.read(" 29 open segments found");
  messages.read(" Meshing failed, trying to refine");
  EXPECT_EQ(messages.verdict(), "");
  messages.read(" Meshing failed, trying to refine");
  EXPECT_NE(messages.verdict().find("at least 29 sides"), std::string::npos);
}

}  // namespace
}  // namespace tessera::netgen

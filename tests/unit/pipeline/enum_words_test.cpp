// SPDX-License-Identifier: BSD-3-Clause
// The words that case files, the command line, reports and messages use are promised to users.
#include <gtest/gtest.h>

#include "tessera/fill/options.hpp"
#include "tessera/io/options.hpp"
#include "tessera/surface/options.hpp"

#include "pipeline/commands/cli.hpp"

namespace tessera::pipeline {
namespace {

TEST(PromisedWords, AreThese)
{
  EXPECT_EQ(word_of(fill::KernelKind::netgen), "netgen");
  EXPECT_EQ(word_of(fill::KernelKind::subdivide), "subdivide");
  EXPECT_EQ(word_of(fill::KernelKind::optimize), "optimize");
  EXPECT_EQ(word_of(surface::SurfaceMesher::netgen), "netgen");
  EXPECT_EQ(word_of(surface::SurfaceMesher::remesh), "remesh");
  EXPECT_EQ(word_of(io::Format::pvtu), "pvtu");
  EXPECT_EQ(word_of(io::Compression::none), "none");
  EXPECT_EQ(word_of(io::Compression::lz4), "lz4");
  EXPECT_EQ(word_of(io::Compression::zlib), "zlib");
  EXPECT_EQ(word_of(ProgressMode::automatic), "auto");
  EXPECT_EQ(word_of(ProgressMode::always), "always");
  EXPECT_EQ(word_of(ProgressMode::never), "never");
}

}  // namespace
}  // namespace tessera::pipeline

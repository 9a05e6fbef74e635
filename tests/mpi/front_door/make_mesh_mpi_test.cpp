// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/hash.hpp"
#include "tessera/tessera.hpp"

#include "support/mpi_tests.hpp"
#include "support/shared_folder.hpp"

#include "mpi/front_door/session_main.hpp"

namespace tessera {
namespace {

namespace fs = std::filesystem;

Hash128 digest_of(const subdomain::MeshPart& part)
{
  Hash128 digest;
  for (std::size_t t = 0; t < part.tet_ids.size(); ++t) {
    std::array<GlobalIndex, 4> ids{};
    std::array<double, 12> xyz{};
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t point = at(part.tet_points[4 * t + c]);
      ids[c] = part.point_ids[point];
      for (std::size_t d = 0; d < 3; ++d) xyz[3 * c + d] = part.point_xyz[3 * point + d];
    }
    digest += hash_tet(ids, xyz, part.tet_material[t]);
  }
  return digest;
}

// All that ranks were handed.
struct Collected {
  std::vector<LocalIndex> numbers{};
  std::set<LocalIndex> subdomains{};
  Hash128 digest{};
  GlobalIndex num_tets = 0;
  GlobalIndex num_triangles = 0;
  bool is_consistent = true;

  void add(const MeshPiece& piece)
  {
    numbers.push_back(piece.number);
    subdomains.insert(piece.tet_subdomain.begin(), piece.tet_subdomain.end());
    digest += digest_of(piece);
    num_tets += piece.num_tets();
    num_triangles += piece.num_triangles();
    for (std::size_t f = 0; f < piece.triangle_tet.size(); ++f) {
      const std::span tet(&piece.tet_points[4 * at(piece.triangle_tet[f])], 4);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto is_corner = std::ranges::count(tet, piece.triangle_points[3 * f + c]) == 1;
        is_consistent = is_consistent && is_corner;
      }
    }
  }

  void sum_over_ranks(const comm::Communicator& comm)
  {
    std::vector<Hash128> sum{digest};
    comm.sum_in_place(sum);
    digest = sum.front();
    num_tets = comm.sum(num_tets);
    num_triangles = comm.sum(num_triangles);
  }
};

class MakeMesh : public ::testing::Test {
 protected:
  // Four subdomains of a brick that NETGEN fills, or that are subdivided.
  [[nodiscard]] config::Case brick(fill::KernelKind kernel, const std::string& folder) const
  {
    config::Case brick;
    brick.geometry.file = fs::path(TESSERA_GEOMETRY_DIR) / "brick.geo";
    brick.coarse.max_size = 0.5;
    brick.decompose.subdomains = 4;
    brick.refine.levels = 1;
    brick.fill.kernel = kernel;
    brick.output.directory = folder_ / folder;
    brick.output.report_html = false;  // A third of the time.
    return brick;
  }

  [[nodiscard]] MeshResult make(const config::Case& given, const MeshOptions& options = {}) const
  {
    return make_mesh(given, comm_, options);
  }

  // Whichever rank gets the first piece, throws.
  template <class Exception>
  [[nodiscard]] static MeshOptions throwing(const Exception& exception)
  {
    return {.on_piece = [exception](const MeshPiece&) { throw exception; }};
  }

  comm::Communicator comm_ = testing::session_of_this_process().world();
  testing::SharedFolder folder_{comm_};
};

TEST_F(MakeMesh, TheFilesHoldWhatTheResultSays)
{
  const MeshResult made = make(brick(fill::KernelKind::netgen, "files"));
  EXPECT_EQ(made.folder, folder_ / "files");
  EXPECT_EQ(made.num_subdomains, 4);
  EXPECT_NEAR(made.volume, 2.0, 1e-9);
  const MeshShare share = read_mesh(made.folder, comm_);
  EXPECT_EQ(share.num_global_tets, made.num_tets);
  EXPECT_EQ(share.num_global_points, made.num_vertices);
  std::vector<Hash128> digest{digest_of(share)};
  comm_.sum_in_place(digest);
  EXPECT_EQ(to_hex(digest.front()), made.digest);
}

TEST_F(MakeMesh, HandedOverPiecesAreThoseOfTheFiles)
{
  for (const auto kernel : {fill::KernelKind::subdivide, fill::KernelKind::netgen}) {
    config::Case given = brick(kernel, "files");
    given.output.report_html = true;
    const MeshResult files = make(given, {.existing = io::ExistingFolder::overwrite});
    const MeshShare share = read_mesh(files.folder, comm_);
    given.output.directory = folder_ / "handed";
    Collected collected;
    const MeshResult handed =
        make(given, {.existing = io::ExistingFolder::overwrite,
                     .on_piece = [&](const MeshPiece& piece) { collected.add(piece); }});
    collected.sum_over_ranks(comm_);
    EXPECT_TRUE(collected.is_consistent);
    EXPECT_EQ(handed.digest, files.digest);
    EXPECT_EQ(to_hex(collected.digest), files.digest);
    EXPECT_EQ(collected.num_tets, files.num_tets);
    EXPECT_EQ(collected.num_triangles, share.num_global_triangles);
    EXPECT_EQ(comm_.sum(static_cast<GlobalIndex>(collected.numbers.size())), 4);
    for (const char* name : {"mesh", "boundary", "mesh.pvtu", "boundary.pvtu", "pieces"}) {
      EXPECT_FALSE(fs::exists(handed.folder / name)) << name;
    }
    EXPECT_TRUE(fs::exists(handed.folder / "report.json"));
  }
}

TEST_F(MakeMesh, PiecesThatAreSplitFurtherAreHandedOver)
{
  for (const LocalIndex files : {0, 2}) {
    config::Case given = brick(fill::KernelKind::optimize, "files" + std::to_string(files));
    given.refine.levels = 2;
    given.fill.levels = 1;
    given.output.files = files;
    const MeshResult made = make(given);
    const MeshShare share = read_mesh(made.folder, comm_);
    given.output.directory = folder_ / ("handed" + std::to_string(files));
    EXPECT_THROW(static_cast<void>(make(given, throwing(std::runtime_error("no")))),
                 comm::Collective<OutputError>);
    Collected collected;
    const MeshResult handed =
        make(given, {.existing = io::ExistingFolder::resume,
                     .on_piece = [&](const MeshPiece& piece) { collected.add(piece); }});
    collected.sum_over_ranks(comm_);
    EXPECT_TRUE(collected.is_consistent);
    EXPECT_EQ(handed.digest, made.digest);
    EXPECT_EQ(to_hex(collected.digest), made.digest);
    EXPECT_EQ(collected.num_tets, made.num_tets);
    EXPECT_EQ(collected.num_triangles, share.num_global_triangles);
    EXPECT_NEAR(handed.volume, 2.0, 1e-9);
  }
}

TEST_F(MakeMesh, PiecesOfSeveralSubdomainsAreHandedOverToo)
{
  config::Case given = brick(fill::KernelKind::subdivide, "handed");
  given.output.files = 2;
  Collected collected;
  const MeshResult made =
      make(given, {.on_piece = [&](const MeshPiece& piece) { collected.add(piece); }});
  EXPECT_TRUE(collected.is_consistent);
  EXPECT_EQ(comm_.sum(static_cast<GlobalIndex>(collected.numbers.size())), 2);
  EXPECT_EQ(collected.subdomains.size(), 2 * collected.numbers.size());
  collected.sum_over_ranks(comm_);
  EXPECT_EQ(to_hex(collected.digest), made.digest);
}

TEST_F(MakeMesh, SomeSubdomainsCanBeHandedOver)
{
  Collected collected;
  const MeshResult made = make(brick(fill::KernelKind::subdivide, "some"),
                               {.only_subdomains = {1, 3},
                                .on_piece = [&](const MeshPiece& piece) { collected.add(piece); }});
  EXPECT_EQ(made.num_subdomains, 2);
  for (const LocalIndex s : collected.subdomains) EXPECT_TRUE(s == 1 || s == 3);
  collected.sum_over_ranks(comm_);
  EXPECT_EQ(to_hex(collected.digest), made.digest);
}

TEST_F(MakeMesh, WhateverACallbackThrowsEndsTheRunOnAllRanksAndItCanGoOn)
{
  const config::Case given = brick(fill::KernelKind::netgen, "broken");
  EXPECT_THROW(static_cast<void>(make(given, throwing(std::runtime_error("no")))),
               comm::Collective<OutputError>);
  MeshOptions on{.existing = io::ExistingFolder::resume};
  for (const bool is_number : {true, false}) {
    on.on_piece = [&](const MeshPiece&) {
      if (is_number) throw 42;
      throw comm::Collective<Interrupted>("as if on all ranks");
    };
    EXPECT_THROW(static_cast<void>(make(given, on)), comm::Collective<OutputError>);
  }
  // Its pieces are in the store, for this way only.
  EXPECT_THROW(static_cast<void>(make(given, {.existing = io::ExistingFolder::resume})),
               comm::Collective<InputError>);
  Collected collected;
  on.on_piece = [&](const MeshPiece& piece) { collected.add(piece); };
  const MeshResult made = make(given, on);
  collected.sum_over_ranks(comm_);
  EXPECT_EQ(to_hex(collected.digest), made.digest);
}

TEST_F(MakeMesh, AnEndedRunIsResumedByItsReport)
{
  const config::Case given = brick(fill::KernelKind::netgen, "ended");
  const MeshResult made = make(given);
  EXPECT_EQ(make(given).digest, made.digest);  // The same asked for once more is not refused.
  config::Case other = given;
  other.fill.timeout_s = 321.0;
  EXPECT_THROW(static_cast<void>(make(other)), comm::Collective<OutputError>);
  MeshOptions on{.existing = io::ExistingFolder::resume};
  const MeshResult again = make(given, on);
  EXPECT_EQ(again.digest, made.digest);
  EXPECT_EQ(again.volume, made.volume);
  EXPECT_EQ(again.num_tets, made.num_tets);
  EXPECT_EQ(again.num_vertices, made.num_vertices);
  EXPECT_EQ(again.status, made.status);
  on.on_piece = [](const MeshPiece&) {};
  EXPECT_THROW(static_cast<void>(make(given, on)), comm::Collective<InputError>);
}

TEST_F(MakeMesh, TheCaseOfRankZeroCountsAndIsChecked)
{
  config::Case given = brick(fill::KernelKind::subdivide, "checked");
  given.output.directory = folder_ / ("rank" + std::to_string(comm_.rank()));
  EXPECT_EQ(make(given).folder, folder_ / "rank0");
  config::Case sizeless = given;
  sizeless.coarse.max_size = 0.0;
  EXPECT_THROW(static_cast<void>(make(sizeless)), Error);
  config::Case lost = given;
  lost.geometry.file = folder_ / "lost.geo";
  EXPECT_THROW(static_cast<void>(make(lost)), comm::Collective<InputError>);
  EXPECT_THROW(static_cast<void>(make(given, {.only_subdomains = {3, 1}})), Error);
}

TEST_F(MakeMesh, RelativePathsStartAtTheWorkingDirectory)
{
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  config::Case given = brick(fill::KernelKind::netgen, "");
  given.output.directory = "relative";
  EXPECT_EQ(make(given).folder, fs::path(folder_ / "relative"));
  fs::current_path(before);
}

TEST_F(MakeMesh, ACallbackOnSomeRanksOnlyIsRefused)
{
  if (comm_.size() == 1) GTEST_SKIP() << "needs two ranks";
  MeshOptions options;
  if (comm_.rank() == 0) options.on_piece = [](const MeshPiece&) {};
  EXPECT_THROW(static_cast<void>(make(brick(fill::KernelKind::subdivide, "mixed"), options)),
               comm::Collective<UsageError>);
}

TEST_F(MakeMesh, SomeRanksCanMakeAMeshOfTheirOwn)
{
  const int half = comm_.rank() % 2;
  MPI_Comm handle = MPI_COMM_NULL;
  MPI_Comm_split(comm_.handle(), half, comm_.rank(), &handle);
  const std::string folder = "half" + std::to_string(half);
  const MeshResult made =
      make_mesh(brick(half == 0 ? fill::KernelKind::subdivide : fill::KernelKind::netgen, folder),
                comm::Communicator(handle));
  MPI_Comm_free(&handle);
  EXPECT_EQ(made.folder, folder_ / folder);
  EXPECT_NEAR(made.volume, 2.0, 1e-9);
}

TEST_F(MakeMesh, ThereIsOneSessionInAProgram) { EXPECT_THROW(const Session second, UsageError); }

// The last one: a stop signal counts for all later runs too.
TEST_F(MakeMesh, WhatAStopSignalEndsCanGoOn)
{
  testing::session_of_this_process().catch_stop_signals();
  MeshOptions options;
  options.on_piece = [](const MeshPiece&) { std::raise(SIGTERM); };
  EXPECT_THROW(static_cast<void>(make(brick(fill::KernelKind::netgen, "stopped"), options)),
               comm::Collective<Interrupted>);
  if (comm_.rank() == 0) {
    EXPECT_TRUE(fs::exists(folder_ / "stopped/pieces"));
  }
}

}  // namespace
}  // namespace tessera

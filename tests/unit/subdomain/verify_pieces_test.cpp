// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/verify_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "tessera/netgen/factory.hpp"
#include "tessera/subdomain/measure_piece.hpp"
#include "tessera/subdomain/seam_optimizer.hpp"

#include "support/filled_cube.hpp"
#include "support/flat_model.hpp"
#include "support/piece_sets.hpp"

namespace tessera::subdomain {
namespace {

LocalIndex* corners_of(mesh::Piece& piece, LocalIndex tet)
{
  return &piece.tet_vertices[4 * at(tet)];
}

// At most one of its faces is on the skin, so other tets have all of its edges too.
LocalIndex tet_with_inner_vertex(const mesh::Piece& piece)
{
  const auto inner = std::ranges::find_if(
      piece.tet_vertices, [&](LocalIndex v) { return v >= piece.num_skin_vertices(); });
  EXPECT_NE(inner, piece.tet_vertices.end());
  return static_cast<LocalIndex>((inner - piece.tet_vertices.begin()) / 4);
}

void remove_tet(mesh::Piece& piece, LocalIndex tet)
{
  const auto first = piece.tet_vertices.begin() + 4 * tet;
  piece.tet_vertices.erase(first, first + 4);
}

void turn_inside_out(mesh::Piece& piece, LocalIndex tet)
{
  std::swap(corners_of(piece, tet)[0], corners_of(piece, tet)[1]);
}

// Far beyond the tets around it.
void throw_out_an_inner_vertex(mesh::Piece& piece)
{
  ASSERT_GT(piece.num_interior_vertices(), 0);
  piece.vertex_xyz.back() += 10.0;
}

bool contains(const std::optional<std::string>& text, const std::string& words)
{
  return text && text->find(words) != std::string::npos;
}

// The pieces that NETGEN made of four slabs of a cube, each with its skin. A test breaks some of
// them; then all are measured as they are, and judged by what they say.
struct VerifyFilledPieces : testing::FilledCube {
  struct PieceInSkin {
    mesh::Piece piece{};
    mesh::Skin skin{};
  };

  VerifyFilledPieces()
  {
    for (LocalIndex s = 0; s < body().num_subdomains(); ++s) {
      set.push_back(
          {pieces()[at(s)].piece, testing::skin_of(body(), testing::FlatModel(), kLevels, s)});
    }
  }

  [[nodiscard]] std::optional<std::string> verdict() const
  {
    std::vector<PieceSummary> summaries;
    std::vector<Hash128> seam_sums(at(body().skeleton.num_triangles()));
    for (const auto& [piece, skin] : set) {
      const FillResult result = measure_filled_piece(cut, skin, piece);
      summaries.push_back(result.summary);
      for (const verify::SeamHash& seam : result.seams) seam_sums[at(seam.triangle)] += seam.hash;
    }
    return verify_pieces(cut, ranges, {summaries, seam_sums});
  }

  // A vertex of the skin's first triangle on a seam.
  static std::size_t vertex_on_seam(const mesh::Skin& skin)
  {
    const auto parent = std::ranges::find_if(
        skin.triangle_parent, [](LocalIndex p) { return body().skeleton.is_inside(p); });
    EXPECT_NE(parent, skin.triangle_parent.end());
    const auto triangle = static_cast<std::size_t>(parent - skin.triangle_parent.begin());
    return at(skin.triangle_vertices[3 * triangle]);
  }

  const PartitionedMesh cut{body().coarse, body().decomposition, 1};
  std::vector<SubdomainRange> ranges{{.number = 0, .first = 0, .last = 2},
                                     {.number = 1, .first = 2, .last = 4}};
  std::vector<PieceInSkin> set{};
};

TEST_F(VerifyFilledPieces, SoundOnesPass) { EXPECT_EQ(verdict(), std::nullopt); }

TEST_F(VerifyFilledPieces, AMissingOneIsNamed)
{
  set.pop_back();
  EXPECT_EQ(verdict(), "piece 3 is missing");
  set.erase(set.begin() + 1);
  EXPECT_EQ(verdict(), "piece 1 is missing");
  set.clear();
  EXPECT_EQ(verdict(), "piece 0 is missing");
}

TEST_F(VerifyFilledPieces, OneThatIsThereTwiceIsNamed)
{
  set.push_back(set.back());
  EXPECT_EQ(verdict(), "piece 3 is one too many");
  set.insert(set.begin() + 1, set[1]);
  EXPECT_EQ(verdict(), "piece 1 is one too many");
}

TEST_F(VerifyFilledPieces, OneThatNobodyAskedForIsNamed)
{
  ranges = single_ranges({0, 2});
  EXPECT_EQ(verdict(), "piece 1 is one too many");
  set.erase(set.begin() + 1);
  EXPECT_EQ(verdict(), "piece 3 is one too many");
  set.pop_back();
  EXPECT_EQ(verdict(), std::nullopt) << "Seams beside pieces that are not made count for nothing.";
}

TEST_F(VerifyFilledPieces, AMissingTetIsSeenInTheEulerCharacteristic)
{
  remove_tet(set[2].piece, tet_with_inner_vertex(set[2].piece));
  EXPECT_EQ(verdict(), "piece 2 has Euler characteristic 0, its coarse subdomain 1");
}

TEST_F(VerifyFilledPieces, ATetThatIsThereTwiceIsSeenInTheEulerCharacteristic)
{
  mesh::Piece& piece = set[2].piece;
  const std::vector<LocalIndex> tet(corners_of(piece, 5), corners_of(piece, 6));
  piece.tet_vertices.insert(piece.tet_vertices.end(), tet.begin(), tet.end());
  EXPECT_EQ(verdict(), "piece 2 has Euler characteristic 2, its coarse subdomain 1");
}

TEST_F(VerifyFilledPieces, AMissingFaceIsSeenInTheEulerCharacteristic)
{
  mesh::Skin& skin = set[0].skin;
  skin.triangle_parent.erase(skin.triangle_parent.begin());
  skin.triangle_vertices.erase(skin.triangle_vertices.begin(), skin.triangle_vertices.begin() + 3);
  EXPECT_TRUE(contains(verdict(), "piece 0 has Euler characteristic")) << verdict().value_or("");
}

TEST_F(VerifyFilledPieces, AFlippedTetIsNamed)
{
  turn_inside_out(set[1].piece, 0);
  EXPECT_TRUE(contains(verdict(), "piece 1 has a flat or inverted tet, of mean ratio -0."))
      << verdict().value_or("");
}

TEST_F(VerifyFilledPieces, AFlatTetIsNamed)
{
  mesh::Piece& piece = set[1].piece;
  const LocalIndex* v = corners_of(piece, tet_with_inner_vertex(piece));
  std::copy_n(&piece.vertex_xyz[3 * at(v[0])], 3, &piece.vertex_xyz[3 * at(v[1])]);
  EXPECT_TRUE(contains(verdict(), "piece 1 has a flat or inverted tet")) << verdict().value_or("");
}

TEST_F(VerifyFilledPieces, AnInnerVertexOutsideIsNamed)
{
  throw_out_an_inner_vertex(set[1].piece);
  EXPECT_TRUE(contains(verdict(), "piece 1 has a flat or inverted tet")) << verdict().value_or("");
}

TEST_F(VerifyFilledPieces, AnOpenSeamIsNamedByItsSides)
{
  double& x = set[1].skin.vertex_xyz[3 * vertex_on_seam(set[1].skin)];
  x = std::nextafter(x, 2.0);
  EXPECT_TRUE(contains(verdict(), "do not meet on coarse triangle")) << verdict().value_or("");
  EXPECT_TRUE(contains(verdict(), "1")) << verdict().value_or("");
}

TEST_F(VerifyFilledPieces, ASeamOfOtherVerticesIsOpen)
{
  ++set[2].skin.vertex_index[vertex_on_seam(set[2].skin)];
  EXPECT_TRUE(contains(verdict(), "do not meet on coarse triangle")) << verdict().value_or("");
}

// The same pieces after they have exchanged tets.
struct VerifyImprovedPieces : VerifyFilledPieces {
  static std::vector<mesh::Piece> filled_pieces()
  {
    std::vector<mesh::Piece> filled;
    for (const FilledPiece& one : pieces()) filled.push_back(one.piece);
    return filled;
  }

  static std::vector<mesh::Piece> improve()
  {
    const improve::SeamRegions regions(body().skeleton, body().decomposition);
    const auto optimizer = make_seam_optimizer(false);
    std::vector<mesh::Piece> improved = filled_pieces();
    LocalIndex num_accepted = 0;
    for (int phase = 0; phase < improve::kNumPhases; ++phase) {
      num_accepted +=
          testing::improve_phase(regions, phase, {.optimizer = *optimizer}, improved).num_accepted;
    }
    EXPECT_GT(num_accepted, 0) << "nothing was improved: nothing is tested";
    return improved;
  }

  VerifyImprovedPieces()
  {
    static const std::vector<mesh::Piece> kImproved = improve();
    improved = kImproved;
  }

  [[nodiscard]] std::optional<std::string> verdict_on_improved() const
  {
    std::vector<PieceSummary> summaries;
    double volume_before = 0.0;
    for (const mesh::Piece& piece : improved) {
      const PieceSummary& before = pieces()[at(piece.subdomain)].result.summary;
      volume_before += before.volume;
      const std::vector<char> on_seam(at(piece.num_skin_vertices()), 0);  // Nobody asks for it.
      summaries.push_back(
          measure_improved_part(improve::whole_piece(piece), on_seam, before).summary);
    }
    const std::vector<Hash128> closed(at(body().skeleton.num_triangles()));
    return verify_pieces(cut, ranges, {summaries, closed, volume_before, true});
  }

  std::vector<mesh::Piece> improved{};
};

constexpr const char* kDoNotMeet = "pieces do not meet: the faces of their tets do not cancel";

TEST_F(VerifyImprovedPieces, SoundOnesPass) { EXPECT_EQ(verdict_on_improved(), std::nullopt); }

TEST_F(VerifyImprovedPieces, AMissingTetLeavesAGap)
{
  remove_tet(improved[1], 0);
  EXPECT_EQ(verdict_on_improved(), kDoNotMeet);
}

TEST_F(VerifyImprovedPieces, OneThatKeptItsOldTetsDoesNotMeetTheOthers)
{
  const auto changed = std::ranges::find_if(improved, [](const mesh::Piece& piece) {
    return piece.tet_vertices != pieces()[at(piece.subdomain)].piece.tet_vertices;
  });
  ASSERT_NE(changed, improved.end());
  *changed = pieces()[at(changed->subdomain)].piece;
  EXPECT_EQ(verdict_on_improved(), kDoNotMeet);
}

TEST_F(VerifyImprovedPieces, ASharedVertexThatMovedInOneOfThemIsSeen)
{
  ASSERT_GT(improved[0].num_skin_vertices(), 0);
  double& x = improved[0].vertex_xyz[0];
  x = std::nextafter(x, 2.0);
  EXPECT_EQ(verdict_on_improved(), kDoNotMeet);
}

TEST_F(VerifyImprovedPieces, AFlippedTetIsNamed)
{
  turn_inside_out(improved[3], 0);
  EXPECT_TRUE(contains(verdict_on_improved(), "piece 3 has a flat or inverted tet"));
}

// Faces cancel, and so do the volumes: only the tets' own sign shows it.
TEST_F(VerifyImprovedPieces, AnInnerVertexOutsideIsNamed)
{
  throw_out_an_inner_vertex(improved[2]);
  EXPECT_TRUE(contains(verdict_on_improved(), "piece 2 has a flat or inverted tet"));
}

// Whose faces cancel, since both sides have the same bits; the extremes of shapes pass it over.
TEST_F(VerifyImprovedPieces, AnInnerVertexNowhereChangesTheVolume)
{
  ASSERT_GT(improved[2].num_interior_vertices(), 0);
  improved[2].vertex_xyz.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(
      contains(verdict_on_improved(), "the improvement of seams has changed the volume from 1 to"))
      << verdict_on_improved().value_or("");
}

}  // namespace
}  // namespace tessera::subdomain

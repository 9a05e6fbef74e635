// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/cut_tet.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace tessera::mesh {
namespace {

using Tet = CutTets::Simplex;
using Corner = std::size_t;

constexpr std::size_t kNumEdges = kTetEdgeCorners.size();

// Edge between two corners.
constexpr auto kEdgeOf = [] {
  std::array<std::array<std::size_t, 4>, 4> edge_of{};
  for (std::size_t e = 0; e < kNumEdges; ++e) {
    const auto [a, b] = kTetEdgeCorners[e];
    edge_of[a][b] = edge_of[b][a] = e;
  }
  return edge_of;
}();

constexpr CutNode corner(Corner c) { return static_cast<CutNode>(c); }
constexpr CutNode middle(Corner a, Corner b) { return static_cast<CutNode>(4 + kEdgeOf[a][b]); }

// Twice the barycentric coordinates of a node.
std::array<int, 4> weights_of(CutNode node)
{
  std::array<int, 4> weights{};
  if (node < 4) {
    weights[node] = 2;
  } else {
    for (const Corner c : kTetEdgeCorners[node - 4U]) weights[c] = 1;
  }
  return weights;
}

// Of three rows of four weights less those of a fourth: six times the volume.
int orientation(const Tet& tet)
{
  std::array<std::array<int, 3>, 3> m{};
  const auto origin = weights_of(tet[0]);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto weights = weights_of(tet[row + 1]);
    for (std::size_t i = 0; i < 3; ++i) m[row][i] = weights[i + 1] - origin[i + 1];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
         - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
         + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Cuts one tet; lives for one call of cut_tet().
class Cutter {
 public:
  Cutter(unsigned marks, const TetEdgeOrder& order, const DiagonalLengths& diagonals)
      : marks_(marks), order_(order), diagonals_(diagonals)
  {
  }

  CutTets run()
  {
    const Corner apex = corner_opposite_to_a_full_face();
    if (apex == kNoCorner) {
      bisect({0, 1, 2, 3}, marks_);
      return result_;
    }
    switch (std::popcount(marks_)) {
      case 3:
        join_split_face(apex);
        break;
      case 4:
        cut_with_four_marks(apex);
        break;
      default:
        cut_with_five_marks();
    }
    return result_;
  }

 private:
  static constexpr Corner kNoCorner = 4;

  [[nodiscard]] bool is_marked(Corner a, Corner b) const
  {
    return (marks_ >> kEdgeOf[a][b] & 1U) != 0;
  }

  // Whether of two marked edges with the end `a` that to `b` comes before that to `c`. Then the
  // diagonal of their face ends in c.
  [[nodiscard]] bool is_earlier(Corner a, Corner b, Corner c) const
  {
    return order_[kEdgeOf[a][b]] < order_[kEdgeOf[a][c]];
  }

  [[nodiscard]] Corner corner_opposite_to_a_full_face() const
  {
    for (Corner c = 0; c < 4; ++c) {
      const auto [p, q, r] = kTetFaceCorners[c];
      if (is_marked(p, q) && is_marked(q, r) && is_marked(p, r)) return c;
    }
    return kNoCorner;
  }

  void add(Tet tet)
  {
    if (orientation(tet) < 0) std::swap(tet[0], tet[1]);
    result_.add(tet);
  }

  // Edges by their place in the tet at hand: where a corner gives way to a midpoint, none is marked
  // any more.
  void bisect(const Tet& tet, unsigned marks)
  {
    if (marks == 0) {
      result_.add(tet);
      return;
    }
    std::size_t first = kNumEdges;
    for (std::size_t e = 0; e < kNumEdges; ++e) {
      const bool is_in = (marks >> e & 1U) != 0;
      if (is_in && (first == kNumEdges || order_[e] < order_[first])) first = e;
    }
    const auto [p, q] = kTetEdgeCorners[first];
    for (const Corner gone : {q, p}) {
      Tet half = tet;
      half[gone] = middle(p, q);
      unsigned left = marks;
      for (Corner c = 0; c < 4; ++c) {
        if (c != gone) left &= ~(1U << kEdgeOf[gone][c]);
      }
      bisect(half, left);
    }
  }

  void join_split_face(Corner d)
  {
    const auto [a, b, c] = kTetFaceCorners[d];
    add({corner(a), middle(a, b), middle(a, c), corner(d)});
    add({corner(b), middle(a, b), middle(b, c), corner(d)});
    add({corner(c), middle(a, c), middle(b, c), corner(d)});
    add({middle(a, b), middle(b, c), middle(a, c), corner(d)});
  }

  // All of face abc, and ad.
  void cut_with_four_marks(Corner d)
  {
    Corner a = kTetFaceCorners[d][0];
    Corner b = kTetFaceCorners[d][1];
    Corner c = kTetFaceCorners[d][2];
    if (is_marked(b, d)) std::swap(a, b);
    if (is_marked(c, d)) std::swap(a, c);
    const CutNode ab = middle(a, b), ac = middle(a, c), ad = middle(a, d), bc = middle(b, c);
    add({corner(a), ab, ac, ad});
    if (is_earlier(a, b, d) && is_earlier(a, c, d)) {
      add({ab, ac, bc, corner(d)});
      add({ab, corner(b), bc, corner(d)});
      add({ac, bc, corner(c), corner(d)});
      add({ab, ac, ad, corner(d)});
      return;
    }
    add({bc, ab, ac, ad});
    for (const Corner side : {b, c}) {
      const CutNode from_a = middle(a, side);
      const bool ends_in_d = is_earlier(a, side, d);
      add({bc, from_a, corner(side), ends_in_d ? corner(d) : ad});
      add({bc, ends_in_d ? from_a : corner(side), corner(d), ad});
    }
  }

  // All but cd.
  void cut_with_five_marks()
  {
    const unsigned unmarked = ~marks_ & ((1U << kNumEdges) - 1U);
    const auto e = static_cast<std::size_t>(std::countr_zero(unmarked));
    const auto [c, d] = kTetEdgeCorners[e];
    const auto [a, b] = kTetEdgeCorners[kNumEdges - 1 - e];  // The opposite edge.
    const CutNode ab = middle(a, b), ac = middle(a, c), ad = middle(a, d);
    const CutNode bc = middle(b, c), bd = middle(b, d);
    add({corner(a), ab, ac, ad});
    add({corner(b), ab, bc, bd});
    const bool at_a_in_d = is_earlier(a, c, d);  // Diagonal ac–d, else ad–c.
    const bool at_b_in_d = is_earlier(b, c, d);  // Diagonal bc–d, else bd–c.
    if (at_a_in_d != at_b_in_d) {
      if (at_b_in_d) {
        add_ring<5>(ad, bc, {corner(c), corner(d), bd, ab, ac});
      } else {
        add_ring<5>(ac, bd, {corner(c), corner(d), ad, ab, bc});
      }
      return;
    }
    const CutNode end = corner(at_a_in_d ? d : c);
    if (at_a_in_d) {
      add({corner(c), corner(d), ac, bc});
    } else {
      add({corner(c), corner(d), ad, bd});
    }
    if (length_of_diagonal(a, d) <= length_of_diagonal(a, c)) {
      add_ring<4>(ad, bc, {ab, ac, end, bd});
    } else {
      add_ring<4>(ac, bd, {ab, bc, end, ad});
    }
  }

  [[nodiscard]] double length_of_diagonal(Corner a, Corner b) const
  {
    const std::size_t e = kEdgeOf[a][b];
    return diagonals_[std::min(e, kNumEdges - 1 - e)];
  }

  template <std::size_t N>
  void add_ring(CutNode from, CutNode to, const std::array<CutNode, N>& ring)
  {
    for (std::size_t i = 0; i < N; ++i) add({from, to, ring[i], ring[(i + 1) % N]});
  }

  unsigned marks_;
  const TetEdgeOrder& order_;
  const DiagonalLengths& diagonals_;
  CutTets result_{};
};

}  // namespace

CutTets cut_tet(unsigned marks, const TetEdgeOrder& order, const DiagonalLengths& diagonals)
{
  return Cutter(marks, order, diagonals).run();
}

CutTriangles cut_triangle(unsigned marks, const SideOrder& order)
{
  // Corners of side s, turned so that they run round the triangle; its third corner is last.
  constexpr std::array<std::array<CutNode, 3>, 3> kTurned{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
  // Side from corner i of a turned triangle to the next one.
  constexpr std::array<std::array<std::size_t, 3>, 3> kSides{{{0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  const auto middle_of = [](std::size_t side) { return static_cast<CutNode>(3 + side); };
  CutTriangles result;
  switch (std::popcount(marks)) {
    case 0:
      result.add({0, 1, 2});
      break;
    case 1: {
      const auto side = static_cast<std::size_t>(std::countr_zero(marks));
      const auto [a, b, c] = kTurned[side];
      result.add({a, middle_of(side), c});
      result.add({middle_of(side), b, c});
      break;
    }
    case 2: {
      const auto unmarked = static_cast<std::size_t>(std::countr_zero(~marks));
      const auto [a, b, tip] = kTurned[unmarked];
      const std::size_t to_tip = kSides[unmarked][1];    // From b.
      const std::size_t from_tip = kSides[unmarked][2];  // To a.
      const CutNode beside_b = middle_of(to_tip);
      const CutNode beside_a = middle_of(from_tip);
      result.add({beside_b, tip, beside_a});
      const bool ends_in_a = order[to_tip] < order[from_tip];
      result.add({a, b, ends_in_a ? beside_b : beside_a});
      result.add({ends_in_a ? a : b, beside_b, beside_a});
      break;
    }
    default:
      result.add({0, 3, 4});
      result.add({3, 1, 5});
      result.add({4, 5, 2});
      result.add({3, 5, 4});
  }
  return result;
}

}  // namespace tessera::mesh

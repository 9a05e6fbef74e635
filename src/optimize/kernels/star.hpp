// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Part of kernels/code.hpp: the tets around a vertex.

#include "optimize/kernels/lanes.hpp"

// Four tets around a vertex that moves by d: the sum of squared edges is
// squares - 2 dot(opposite, d) + 3 dot(d, d), six times the volume is w + dot(inward, d).
struct StarBlock {
  Vectors inward;    // Normal of the face opposite to the vertex, twice its area long.
  Vectors opposite;  // Sum of that face's corners, from the vertex.
  Lanes w;
  Lanes squares;
};

struct Star {
  StarBlock blocks[kMaxStar / 4];
  int num_blocks;
  LocalIndex num_tets;
};

// Lanes of a block that stand for no tet: their energy is next to nothing.
inline void pad(StarBlock& block, LocalIndex num_tets)
{
  const LaneMask padding = LaneMask{0, 1, 2, 3} >= static_cast<long long>(num_tets);
  const Lanes zero{};
  block.inward = {padding ? zero : block.inward.x, padding ? zero : block.inward.y,
                  padding ? zero : block.inward.z};
  block.opposite = {padding ? zero : block.opposite.x, padding ? zero : block.opposite.y,
                    padding ? zero : block.opposite.z};
  block.w = padding ? all(kHuge) : block.w;
  block.squares = padding ? all(1.0) : block.squares;
}

// @pre 1 <= num_tets <= 4 corners.
inline StarBlock gather_block(const StarView& mesh, const LocalIndex* corners, LocalIndex num_tets,
                              Lanes origin)
{
  Lanes rows[3][4];
  for (LocalIndex lane = 0; lane < 4; ++lane) {
    const LocalIndex corner = corners[lane < num_tets ? lane : num_tets - 1];
    for (LocalIndex k = 0; k < 3; ++k) {
      rows[k][lane] = load(mesh.points[mesh.tet_vertices[corner ^ (k + 1)]]) - origin;
    }
  }
  const Vectors a = transposed(rows[0]);
  const Vectors b = transposed(rows[1]);
  const Vectors c = transposed(rows[2]);
  StarBlock block;
  block.inward = cross(c - a, b - a);
  block.opposite = a + b + c;
  block.w = -dot(block.inward, a);
  block.squares = sum_of_squares(a, b, c);
  if (num_tets < 4) pad(block, num_tets);
  return block;
}

// @pre the vertex has 1 to kMaxStar tets.
inline void gather_star(const StarView& mesh, LocalIndex vertex, Star& star)
{
  const LocalIndex first = mesh.offsets[vertex];
  star.num_tets = mesh.offsets[vertex + 1] - first;
  star.num_blocks = (star.num_tets + 3) / 4;
  const Lanes origin = load(mesh.points[vertex]);
  const LocalIndex* corners = mesh.corners + first;
  LocalIndex rest = star.num_tets;
  for (int i = 0; i < star.num_blocks; ++i, corners += 4, rest -= 4) {
    star.blocks[i] = gather_block(mesh, corners, rest < 4 ? rest : 4, origin);
  }
}

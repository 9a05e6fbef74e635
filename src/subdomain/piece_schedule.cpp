// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/piece_schedule.hpp"

#include <string>

namespace tessera::subdomain {

// Behind one pass of NETGEN's swaps, corner tets divided, 8 subdomains: mean and 1st percentile of
// the mean ratio, smallest angle.
//                                     screw.step, 0.5        shaft.toml             part1.stl, 0.2
//   standard_schedule(), divided first  0.892, 0.731, 18.0     0.894, 0.719, 16.7     0.904,
//   0.745, 17.9 divided after the first swaps       0.892, 0.732, 18.0     0.896, 0.727, 16.7
//   0.904, 0.745, 17.9 and vertices put in                 0.892, 0.732, 20.5     0.896,
//   0.728, 24.0     0.904, 0.746, 21.8 these: and two passes more          0.893, 0.734, 20.5
//   0.897, 0.730, 24.0     0.904, 0.746, 21.8
optimize::Schedule piece_schedule(bool divides, int rounds)
{
  std::string steps = divides ? "msmsd" : "msms";
  for (int round = 0; round < rounds; ++round) steps += "msicwmmscwmmscwitsmmmwwtsmmmwwww";
  // A vertex is put into what a division leaves; at the default, worse tets alone get one.
  return {.steps = optimize::parse_steps(steps), .insert_below = 0.5};
}

}  // namespace tessera::subdomain

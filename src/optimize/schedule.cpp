// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/optimize/schedule.hpp"

#include <string>

#include "tessera/base/error.hpp"

namespace tessera::optimize {
namespace {

Step parse_step(char letter)
{
  switch (letter) {
    case 'm':
      return Step::smooth;
    case 'w':
      return Step::smooth_worst;
    case 's':
      return Step::swap;
    case 'c':
      return Step::collapse;
    case 'i':
      return Step::insert;
    case 't':
      return Step::tighten;
    case 'd':
      return Step::divide;
    default:
      throw ConfigError("'" + std::string(1, letter)
                        + "' is no step: m, w, s, c, i, t or d expected");
  }
}

}  // namespace

std::vector<Step> parse_steps(std::string_view letters)
{
  std::vector<Step> steps;
  steps.reserve(letters.size());
  for (const char letter : letters) steps.push_back(parse_step(letter));
  return steps;
}

// A collapse dents the smallest mean ratio for a moment. So worst tets are looked after right
// behind it, and no schedule ends with one. Smoothing for the mean makes some good tets worse. So
// the last passes are for the worst, and the bound is tightened before swaps that come late.
Schedule fast_schedule() { return {.steps = parse_steps("mmscwmmscwsmmwww")}; }
Schedule standard_schedule() { return {.steps = parse_steps("msmscwmmscwsmmwwtsmmwww")}; }
Schedule thorough_schedule() { return {.steps = parse_steps("msmscwmmscwmmscwtsmmmwwtsmmmwww")}; }

}  // namespace tessera::optimize

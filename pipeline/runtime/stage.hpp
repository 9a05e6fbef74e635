// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "tessera/base/enum_words.hpp"

namespace tessera::pipeline {

/// @brief The stages that are timed, in the order in which a run may have them.
enum class Stage : int {
  model,
  names,
  cut,
  coarse,
  periodic,
  layers,
  levels,
  split,
  decompose,
  prepare,  ///< Of a dry run only.
  plan,
  fill,
  improve,
  verify,
  refine,
  curve,
  write,
  hand_over,
  partners,
  pictures,
  export_formats,
  neighbours
};

/// @brief Their names: in logs and reports, and in docs/design.md.
constexpr auto enum_words(Stage)
{
  return std::to_array<EnumWord<Stage>>({{Stage::model, "model"},
                                         {Stage::names, "names"},
                                         {Stage::cut, "cut"},
                                         {Stage::coarse, "coarse"},
                                         {Stage::periodic, "periodic"},
                                         {Stage::layers, "layers"},
                                         {Stage::levels, "levels"},
                                         {Stage::split, "split"},
                                         {Stage::decompose, "decompose"},
                                         {Stage::prepare, "prepare"},
                                         {Stage::plan, "plan"},
                                         {Stage::fill, "fill"},
                                         {Stage::improve, "improve"},
                                         {Stage::verify, "verify"},
                                         {Stage::refine, "refine"},
                                         {Stage::curve, "curve"},
                                         {Stage::write, "write"},
                                         {Stage::hand_over, "hand over"},
                                         {Stage::partners, "partners"},
                                         {Stage::pictures, "pictures"},
                                         {Stage::export_formats, "export"},
                                         {Stage::neighbours, "neighbours"}});
}

/// @brief Stages in the order in which they run. Local.
using StageList = std::vector<Stage>;

[[nodiscard]] inline bool contains(const StageList& stages, Stage stage)
{
  return std::ranges::find(stages, stage) != stages.end();
}

/// @brief Appends a stage, if it is wanted. Local.
inline void append_if(bool is_wanted, Stage stage, StageList& stages)
{
  if (is_wanted) stages.push_back(stage);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/assembly_json.hpp"

namespace tessera::pipeline {

Json assembly_json(const model::Assembly& assembly)
{
  Json overlaps = Json::array();
  for (const model::CommonPart& part : assembly.overlaps) {
    overlaps.push_back({{"solids", part.solids.numbers},
                        {"names", part.solids.names},
                        {"volume", part.volume},
                        {"box", {{"low", part.low}, {"high", part.high}}}});
  }
  Json gaps = Json::array();
  for (const model::ClosedGap& gap : assembly.gaps) {
    gaps.push_back({{"solids", gap.solids.numbers},
                    {"names", gap.solids.names},
                    {"width", gap.width},
                    {"place", gap.place}});
  }
  Json embedded = Json::array();
  for (const model::EmbeddedPart& part : assembly.embedded) {
    embedded.push_back({{"name", part.name},
                        {"num_faces", part.num_faces},
                        {"area", part.area},
                        {"inside", part.is_inside}});
  }
  Json lines = Json::array();
  for (const model::EmbeddedLine& line : assembly.lines) {
    lines.push_back({{"name", line.name}, {"num_edges", line.num_edges}, {"length", line.length}});
  }
  return {{"overlaps", std::move(overlaps)},
          {"closed_gaps", std::move(gaps)},
          {"embedded", std::move(embedded)},
          {"lines", std::move(lines)},
          {"tolerance", assembly.tolerance}};
}

}  // namespace tessera::pipeline

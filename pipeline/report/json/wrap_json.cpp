// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/wrap_json.hpp"

#include <fmt/format.h>

namespace tessera::pipeline {

nlohmann::ordered_json wrap_json(const model::Wrap& wrap, double scale)
{
  return {{"reason", wrap.reason},
          {"tolerance", scale * wrap.tolerance},
          {"distance_max", scale * wrap.distance_max},
          {"file_distance_max", scale * wrap.file_distance_max},
          {"num_triangles", wrap.num_triangles}};
}

std::string wrap_reason(const model::Wrap& wrap, double scale)
{
  return fmt::format(
      "the model is a wrap, as the file's {}: it is at most {:.3g} off the file's triangles, and "
      "these are at most {:.3g} off it, with geometry.wrap_tolerance {:.3g}",
      wrap.reason, scale * wrap.distance_max, scale * wrap.file_distance_max,
      scale * wrap.tolerance);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/base/hash.hpp"
#include "tessera/base/types.hpp"
#include "tessera/migrate/cut_into_parts.hpp"
#include "tessera/migrate/migrate.hpp"
#include "tessera/migrate/part_figures.hpp"

#include "pipeline/runtime/exit_code.hpp"

namespace tessera::pipeline {

struct StepTime {
  std::string name{};
  double wall_s = 0.0;
};

/// @brief What a repartition has to say of itself.
struct RepartitionFigures {
  std::string mesh_file{};
  int num_ranks = 0;
  int num_ghost_layers = 0;
  double wall_time_s = 0.0;
  GlobalIndex num_vertices = 0;
  Hash128 tets_digest{};  ///< migrate::digest_of_tets() over all ranks.
  migrate::CutFigures cut{};
  migrate::Traffic traffic{};  ///< Of migrations, over all ranks.
  std::vector<migrate::PartFigures> parts{};
  std::vector<std::string> notes{};
  std::vector<StepTime> steps{};

  [[nodiscard]] GlobalIndex num_tets() const;
  [[nodiscard]] GlobalIndex num_cut_triangles() const;  ///< Between two parts.
  [[nodiscard]] GlobalIndex largest_part() const;       ///< Its tets.
  [[nodiscard]] double balance() const;                 ///< Largest part over the average.
  [[nodiscard]] GlobalIndex num_disconnected() const;   ///< Parts of several components.
};

/// @brief report.json. Local.
[[nodiscard]] std::string repartition_json(ExitCode exit_code, const std::string& reason,
                                           const RepartitionFigures& figures);

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "tessera/base/types.hpp"
#include "tessera/fill/kernel.hpp"
#include "tessera/improve/optimizer.hpp"
#include "tessera/jobs/job_runner.hpp"
#include "tessera/model/model.hpp"
#include "tessera/netgen/factory.hpp"

#include "pipeline/jobs/mesh_worker.hpp"

namespace tessera::pipeline {

/// @brief Parts of the program that tests replace by others, which fail.
struct ReplaceableParts {
  /// Of the job processes, and of `tessera replay`.
  std::function<std::unique_ptr<jobs::Worker>()> make_worker = make_mesh_worker;

  /// Of a fill job, by its first subdomain.
  std::function<std::unique_ptr<fill::Kernel>(LocalIndex first)> fill_kernel = [](LocalIndex) {
    return netgen::make_fill_kernel();
  };
  /// What a fill job projects onto in place of the model; nothing: the model itself.
  std::function<std::unique_ptr<model::Model>(const model::Model& model, LocalIndex first)>
      model_of_fill = [](const model::Model&, LocalIndex) { return nullptr; };

  /// Of a region, in place of the one that is wanted.
  std::function<std::unique_ptr<improve::Optimizer>(std::unique_ptr<improve::Optimizer> wanted,
                                                    LocalIndex region)>
      optimizer = [](auto wanted, LocalIndex) { return wanted; };

  /// A rank calls it before it shares memory ("share") or workers ("join") with the ranks of its
  /// node. What it throws keeps the rank from that.
  std::function<void(std::string_view what, Rank rank)> before_sharing = [](auto, Rank) {};
};

/// @brief Those of this process, and of the jobs that are forked from it. To be changed before
/// there is a Session. Local.
[[nodiscard]] inline ReplaceableParts& replaceable_parts()
{
  static ReplaceableParts parts;
  return parts;
}

}  // namespace tessera::pipeline

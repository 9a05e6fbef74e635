// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/config/case.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/io/record_store.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/subdomain/piece_summary.hpp"
#include "tessera/tessera.hpp"

namespace tessera::pipeline {

/// @brief The case without the output directory and limits of time and memory. These bear on no bit
/// of the mesh, so they may differ between a run and its continuation or prediction.
[[nodiscard]] config::Case without_limits(config::Case run_case);

/// @brief The plan as it stands: what a round of fills works from.
struct Plan {
  std::vector<fill::KernelKind> kernels{};  ///< Shape (num_subdomains); subdivide where folded.
  mesh::ProjectionLimiter limiter{};
  std::vector<LocalIndex> limited{};  ///< Folded ones that lost a try for time or memory.
  std::vector<subdomain::FailedTries>
      failures{};  ///< Of folded ones, before subdivision took their place.

  static auto fields(auto& self)
  {
    return std::tie(self.kernels, self.limiter, self.limited, self.failures);
  }
};

/// @brief Hashes of the files that a run reads.
struct InputContent {
  Hash128 model{};
  Hash128 field{};  ///< Of size.field; zero without one.
};

/// @brief What a run leaves in its folder besides pieces: what `--resume` need not make again, and
/// what tells whether it is the same run. Used by rank 0; all functions are local. A record that is
/// damaged counts as absent.
class RunState {
 public:
  /// @param[in] only_subdomains That the run is to fill; empty: all.
  /// @param[in] has_files Whether its mesh goes into files.
  RunState(std::filesystem::path output, std::vector<LocalIndex> only_subdomains, bool has_files)
      : output_(std::move(output)),
        only_subdomains_(std::move(only_subdomains)),
        has_files_(has_files)
  {
  }

  /// @brief Refuses a folder that is not there or empty. @throws InputError
  void require_begun() const;

  /// @brief Refuses unless the folder's case is `given`. The output directory and limits of time
  /// and memory may differ. A folder without a case is accepted: its run was killed before it did
  /// anything.
  /// @throws InputError naming the first line that differs.
  void require_same_case(const config::Case& given) const;

  /// @brief Whether a run of this very case, limits included, has ended there with a mesh whose
  /// pieces are all there. Its input may have changed since: see require_same_input().
  [[nodiscard]] bool has_made(config::Case given) const;

  /// @brief Refuses unless the run that has ended there had this version, input and subdomains.
  /// @throws OutputError naming what has changed.
  void require_same_input(const InputContent& input) const;

  /// @brief Notes version, input and subdomains of this run, or refuses if others are noted. If
  /// nothing sound is noted, nothing else there can be trusted, and it is removed.
  /// @throws InputError naming what has changed.
  void require_same_run(const InputContent& input) const;

  void keep_coarse(std::span<const std::byte> coarse) const;
  [[nodiscard]] std::optional<Bytes> find_coarse() const;

  void keep_plan(const Plan& plan) const;
  [[nodiscard]] std::optional<Plan> find_plan() const;

  /// @brief What a run that has ended with a mesh says of it.
  [[nodiscard]] std::optional<MeshResult> finished() const;

  /// @brief Removes everything that only an unfinished run needs. @throws OutputError
  void clear() const;

 private:
  [[nodiscard]] io::RecordStore store() const;

  std::filesystem::path output_;
  std::vector<LocalIndex> only_subdomains_;
  bool has_files_;
};

}  // namespace tessera::pipeline

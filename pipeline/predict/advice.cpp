// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/error.hpp"
#include "tessera/io/options.hpp"

#include "pipeline/predict/prediction.hpp"

namespace tessera::pipeline {
namespace {

constexpr double kGB = 1e-9;
constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;

// Shares of the wall time, or of the ranks' time, from which on it is worth to change the case.
constexpr double kLargeSerialShare = 0.25;
constexpr double kSmallBusyShare = 0.5;

// So many jobs a rank keep ranks busy to the end, with jobs of usual spread.
constexpr GlobalIndex kJobsPerRank = 4;

std::string disk_advice(const Prediction& prediction, const Resources& resources)
{
  return fmt::format(
      "{:.3g} GB of disk are needed, {:.3g} GB are free: choose another output.directory, "
      "output.compression = \"{}\", a larger coarse.max_size or fewer refine.levels",
      kGB * prediction.disk_peak_bytes, kGB * resources.free_disk_bytes,
      word_of(io::Compression::zlib));
}

// Of so many ranks on one machine. What they share is there once.
double memory_of_ranks(const Prediction& prediction, int num_ranks)
{
  const double own = prediction.memory_per_rank_bytes - prediction.memory_of_node_bytes;
  return num_ranks * own + prediction.memory_of_node_bytes;
}

std::string memory_advice(const Prediction& prediction, const Resources& resources, int num_here)
{
  return fmt::format(
      "{} ranks need {:.3g} GB of memory, this machine has {:.3g} GB: start fewer ranks on it, or "
      "make jobs smaller by more decompose.subdomains (and output.files)",
      num_here, kGB * memory_of_ranks(prediction, num_here), kGB * resources.machine_memory_bytes);
}

std::string job_memory_advice(const Prediction& prediction, const Resources& resources)
{
  return fmt::format(
      "the largest job needs {:.3g} GiB, fill.memory_gib allows {:.3g}: raise it, or make jobs "
      "smaller by more decompose.subdomains",
      prediction.largest_job_bytes / kGiB, resources.job_memory_gib);
}

std::string serial_advice(const Prediction& prediction)
{
  return fmt::format(
      "{:.0f} % of the time only one rank works, for all {} coarse tets: use fewer ranks, or a "
      "larger coarse.max_size with more refine.levels",
      100.0 * prediction.serial_share, prediction.num_coarse_tets);
}

std::string busy_advice(const Prediction& prediction)
{
  const GlobalIndex wanted = kJobsPerRank * prediction.num_ranks;
  const std::string idle =
      fmt::format("ranks are idle for {:.0f} % of the time that they share work, ",
                  100.0 * (1.0 - prediction.busy_share));
  if (wanted > prediction.num_coarse_tets) {
    return idle
           + fmt::format(
               "and {} coarse tets are too few for {} ranks: use fewer ranks, or a "
               "smaller coarse.max_size",
               prediction.num_coarse_tets, prediction.num_ranks);
  }
  return idle
         + fmt::format(
             "with {} subdomains for {} ranks: use fewer ranks, or about {} "
             "decompose.subdomains (and no fewer output.files)",
             prediction.num_subdomains, prediction.num_ranks, wanted);
}

}  // namespace

Resources resources_of_this_machine(const std::filesystem::path& folder, double job_memory_gib)
{
  std::error_code error;
  const auto space = std::filesystem::space(folder, error);
  if (error) {
    throw OutputError(
        fmt::format("cannot ask for the free space of {}: {}", folder.string(), error.message()));
  }
  return {.free_disk_bytes = static_cast<double>(space.available),
          .machine_memory_bytes = static_cast<double>(::sysconf(_SC_PHYS_PAGES))
                                  * static_cast<double>(::sysconf(_SC_PAGESIZE)),
          .num_cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())),
          .job_memory_gib = job_memory_gib};
}

Advice advise(const Prediction& prediction, const Resources& resources)
{
  Advice advice;
  if (prediction.disk_peak_bytes > resources.free_disk_bytes) {
    advice.must.push_back(disk_advice(prediction, resources));
  }
  const int num_here = std::min(prediction.num_ranks, resources.num_cores);
  if (memory_of_ranks(prediction, num_here) > resources.machine_memory_bytes) {
    advice.must.push_back(memory_advice(prediction, resources, num_here));
  }
  if (prediction.largest_job_bytes > resources.job_memory_gib * kGiB) {
    advice.must.push_back(job_memory_advice(prediction, resources));
  }
  if (prediction.num_ranks == 1) return advice;
  if (prediction.serial_share > kLargeSerialShare) {
    advice.should.push_back(serial_advice(prediction));
  }
  if (prediction.busy_share < kSmallBusyShare) advice.should.push_back(busy_advice(prediction));
  return advice;
}

}  // namespace tessera::pipeline

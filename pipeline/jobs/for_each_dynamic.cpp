// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/for_each_dynamic.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <future>
#include <numeric>
#include <string_view>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/work_queue.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

// The slowest fills measured make 7 k tets/s; 20 times the time that takes is a hang.
constexpr double kSlowTetsPerSecond = 7000.0;
constexpr double kTimeMargin = 20.0;
constexpr double kLeastTime_s = 60.0;

constexpr std::chrono::milliseconds kLookAtQueue{1};

// Whether `work` has come to its end. What it throws is held back until all ranks have ended; that
// it was cancelled is no error.
bool is_done(const std::function<void()>& work, std::exception_ptr& held)
{
  try {
    work();
    return true;
  } catch (const Interrupted&) {
  } catch (...) {
    held = std::current_exception();
  }
  return false;
}

// Collective: Interrupted on a signal, or what was held back.
void throw_everywhere(const std::exception_ptr& held, const comm::Communicator& comm)
{
  throw_if_stopped(comm);
  all_or_none(comm, [&] {
    if (held) std::rethrow_exception(held);
  });
}

}  // namespace

void for_each_dynamic(std::vector<LocalIndex> order, const ItemWork& work, StageScope& stage,
                      RunContext& context, std::int64_t num_before)
{
  std::exception_ptr error;
  comm::WorkQueue queue(context.comm, std::move(order));
  const auto on_wait = [&] {
    if (stop_requested()) queue.request_stop();
    context.progress.update(num_before + queue.num_handed_out());
    return queue.progress();
  };
  while (const auto item = queue.next()) {
    if (!on_wait()) break;
    if (!is_done([&] { work(*item, on_wait); }, error)) queue.request_stop();
  }
  stage.work_is_done();
  static_cast<void>(queue.finish());
  throw_everywhere(error, context.comm);
}

double seconds_now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void run_tasks(comm::TaskSource& source, const TaskWork& work, StageScope& stage,
               RunContext& context)
{
  std::exception_ptr error;
  const auto careful = [&](const comm::Task& task, const std::function<bool()>& on_wait) {
    Bytes verdict;  // Stays empty if there is none: the board knows why, or all ranks stop.
    static_cast<void>(is_done([&] { verdict = work(task, on_wait); }, error));
    return verdict;
  };
  comm::TaskBoard(context.comm, source).run(careful, [&] {
    return stop_requested() || error != nullptr;
  });
  stage.work_is_done();
  throw_everywhere(error, context.comm);
}

ItemWork in_thread(std::function<void(LocalIndex item)> work)
{
  return [work = std::move(work)](LocalIndex item, const auto& on_wait) {
    std::future<void> done = std::async(std::launch::async, work, item);
    // What is begun is ended: a stop counts from the next item on.
    while (done.wait_for(kLookAtQueue) != std::future_status::ready) static_cast<void>(on_wait());
    done.get();
  };
}

std::vector<LocalIndex> in_order(std::size_t num_items)
{
  std::vector<LocalIndex> order(num_items);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<LocalIndex> heaviest_first(const std::vector<double>& weight)
{
  std::vector<LocalIndex> order = in_order(weight.size());
  std::ranges::stable_sort(
      order, [&](LocalIndex a, LocalIndex b) { return weight[at(a)] > weight[at(b)]; });
  const char* asked = std::getenv("TESSERA_TEST_FILL_ORDER");
  if (asked != nullptr && std::string_view(asked) == "reverse") std::ranges::reverse(order);
  return order;
}

jobs::JobLimits job_limits(const fill::FillOptions& options, double num_tets)
{
  jobs::JobLimits limits;
  limits.memory_gib = options.memory_gib;
  limits.cpu_s = std::max(kLeastTime_s, kTimeMargin * num_tets / kSlowTetsPerSecond);
  if (options.timeout_s > 0.0) {
    limits.cpu_s = options.timeout_s;
    limits.stall_s = std::min(limits.stall_s, options.timeout_s);
  }
  return limits;
}

}  // namespace tessera::pipeline

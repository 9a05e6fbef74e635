// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/task_board.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/jobs/job_runner.hpp"

#include "pipeline/runtime/run_context.hpp"

/// What all stages have in common whose items are worked on by whichever rank is free.
namespace tessera::pipeline {

/// @brief Works on one item; `on_wait` is to be called every few milliseconds.
using ItemWork = std::function<void(LocalIndex item, const jobs::JobRunner::WaitCallback& on_wait)>;

/// @brief Gives every item to one rank. The first error of any rank ends it for all.
/// @param[in] order Items in the order in which they are handed out.
/// @param[in] num_before Items of the stage that were done before these, for the progress shown.
/// @note Collective. @throws what `work` throws, on every rank; Interrupted on a signal.
void for_each_dynamic(std::vector<LocalIndex> order, const ItemWork& work, StageScope& stage,
                      RunContext& context, std::int64_t num_before = 0);

/// @brief A steady clock, seconds. Local.
[[nodiscard]] double seconds_now();

/// @brief Works on a task of a comm::TaskSource and returns its verdict; as ItemWork else.
using TaskWork =
    std::function<Bytes(const comm::Task& task, const jobs::JobRunner::WaitCallback& on_wait)>;

/// @brief All ranks work on what the source of rank 0 wants, until it is settled. A task whose job
/// was cancelled (Interrupted) counts as dropped.
/// @note Collective. @throws what `work` throws, on every rank; Interrupted on a signal.
void run_tasks(comm::TaskSource& source, const TaskWork& work, StageScope& stage,
               RunContext& context);

/// @brief What this process does itself with an item, as an ItemWork: in a thread, so that rank 0
/// answers the others meanwhile.
/// @param[in] work Must not communicate; it is never called twice at a time.
[[nodiscard]] ItemWork in_thread(std::function<void(LocalIndex item)> work);

/// @brief Items 0…num_items-1 as they come.
[[nodiscard]] std::vector<LocalIndex> in_order(std::size_t num_items);

/// @brief Items 0…num_items-1 by weight, the heaviest first: so no rank is left with a heavy one
/// while all others have nothing to do. TESSERA_TEST_FILL_ORDER=reverse turns it round: the tests
/// show with it that no bit of the mesh depends on the order. No option, for no user needs it.
[[nodiscard]] std::vector<LocalIndex> heaviest_first(const std::vector<double>& weight);

/// @brief Limits of a job that makes or optimises so many tets.
[[nodiscard]] jobs::JobLimits job_limits(const fill::FillOptions& options, double num_tets);

}  // namespace tessera::pipeline

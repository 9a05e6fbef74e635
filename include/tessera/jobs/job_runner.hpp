// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

namespace tessera::jobs {

/// @brief What runs in the worker processes: third-party code that may crash, exit, loop or run out
/// of memory. Implemented by the program; made in the zygote, so it must not touch MPI.
class Worker {
 public:
  virtual ~Worker() = default;

  /// @brief Changes the state that later jobs start from (loads the model, the coarse mesh).
  /// Runs in the model zygote itself.
  virtual void load(std::span<const std::byte> message) = 0;

  /// @brief One job, in a fresh fork of the state after the last load(); what it changes is lost.
  [[nodiscard]] virtual Bytes run(std::span<const std::byte> request) = 0;
};

/// @brief Bounds of one load or job.
struct JobLimits {
  double cpu_s = 600.0;     ///< CPU time of the job process, seconds.
  double stall_s = 120.0;   ///< Wall time without any CPU time used, seconds: finds sleepers.
  double memory_gib = 4.0;  ///< Resident memory of the job process, GiB.
  /// CPU time without report_progress(), seconds, or ten times the longest such time so far if that
  /// is more; 0: not watched.
  double idle_cpu_s = 0.0;
  /// The other ranks of the node wait for it: it has a thread for each of them, on their cores.
  bool is_alone = false;
};

/// @brief How a job ended.
enum class JobStatus : int {
  ok,
  failed,       ///< The worker threw; `message` is its text, `error` its kind.
  crashed,      ///< Ended by a signal; `code` is the signal.
  exited,       ///< Called exit(); `code` is the exit status.
  out_of_time,  ///< CPU limit.
  stalled,      ///< Stall limit, or no progress.
  out_of_memory,
  cancelled,  ///< The caller asked to stop.
};
[[nodiscard]] constexpr JobStatus last_value(JobStatus /*type*/) { return JobStatus::cancelled; }

/// @brief How a load or job has ended: well, or why not. This is all that is told of a failure,
/// from the process where it happens to all ranks.
struct JobEnd {
  JobStatus status = JobStatus::ok;
  int code = 0;
  std::optional<ErrorKind> error{};  ///< Of what the worker threw; nothing unless `failed`.
  bool loads_are_lost = false;       ///< The process that holds what was loaded died too.
  std::string message{};             ///< One line for people: what happened, in words.

  static auto fields(auto& self)
  {
    return std::tie(self.status, self.code, self.error, self.loads_are_lost, self.message);
  }
};

/// @brief How a job has ended, and what it has given and used.
struct JobOutcome : JobEnd {
  Bytes result{};                  ///< What Worker::run() returned; empty unless ok.
  double cpu_s = 0.0;              ///< CPU time used, seconds.
  double wall_s = 0.0;             ///< Wall time, seconds.
  std::size_t peak_rss_bytes = 0;  ///< Largest resident memory seen of the job process.

  static void fields(auto& self) = delete;  ///< Only its JobEnd goes to other ranks.
};

/// @brief What the worker processes of one rank have used.
struct JobUsage {
  double cpu_s = 0.0;              ///< CPU time of all loads and jobs, seconds.
  std::size_t peak_rss_bytes = 0;  ///< As JobRunner::peak_rss_bytes().
  std::size_t loaded_bytes = 0;    ///< Of the zygotes alone, after the last load.
};

/// @brief Throws the tessera error that a `failed` job names, NetgenError for a process that died
/// or was killed, Interrupted for `cancelled`; returns on `ok`. `what` is put before the text,
/// unless that begins with it.
void throw_unless_ok(const JobEnd& end, const std::string& what);

/// @brief Runs loads and jobs in processes that may die without harm.
///
/// Own code, because a job must start as a fork of a process that has loaded the model and knows no
/// MPI.
///
/// The constructor forks a *zygote*, so construct it before MPI_Init and while the process has one
/// thread. The zygote forks a *model zygote*, which runs load() and forks one process per job. If
/// the model zygote dies in a load, or somebody else kills it, a fresh one takes its place. Then
/// all earlier successful loads are gone, and the outcome of the load or job says so. If the zygote
/// itself is killed, this and all later calls are `crashed`: a rank cannot fork another one after
/// MPI_Init.
///
/// All processes end with the thread that constructed this object, however it ends. They ignore the
/// signals that a process group gets (Ctrl-C), so that the rank decides. One job at a time;
/// move-only by unique_ptr.
///
/// Ranks of one node can share a model zygote: open_to_node() and join().
class JobRunner {
 public:
  /// @brief Called every few milliseconds while waiting; returns false to cancel. Then, and when it
  /// throws, the process is killed and its result dropped. A cancelled run leaves the model as it
  /// is, a cancelled load loses what was loaded before.
  using WaitCallback = std::function<bool()>;

  explicit JobRunner(const std::function<std::unique_ptr<Worker>()>& make_worker);
  ~JobRunner();
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  /// @brief Sends standard output and error of later loads and jobs to this file (appended); a
  /// relative path starts at the working directory of this call. Without it they go to /dev/null.
  void set_log_file(const std::filesystem::path& file);

  /// @brief Tells how many ranks this node has, and on which cores they run, for jobs that are
  /// alone. Without it such a job is like others. Local.
  void set_node(int num_ranks, std::vector<int> cores);

  /// @brief Lets the worker be made while this rank does something else. Without it the first load
  /// or job waits for it. Does not wait; what fails is the outcome of that load or job. Local.
  void prepare();

  /// @brief Lets ranks of this node join: their jobs are forks of this rank's model zygote. Ends
  /// what was loaded before. Local. @pre this runner has not joined another one.
  /// @return The name by which they join.
  /// @throws Error, or as throw_unless_ok(), if they cannot.
  [[nodiscard]] std::string open_to_node();

  /// @brief Nobody else may join; who has joined stays. Local.
  void close_to_node();

  /// @brief From now on the model zygote of another rank of this node does the work: it is told
  /// `name` by open_to_node(). The one of this rank ends, with what it has loaded. Local.
  ///
  /// All ranks that use it must load the same in the same order, and none may load before all have
  /// ended the jobs that need the state before. A load is done once. A job ends with the rank that
  /// asked for it, and runs on the cores of that rank, unless it is alone; its environment and
  /// limits are those of the other rank. What a load prints goes to the log of who asked first. If
  /// the model zygote dies, all of them lose what was loaded. Then, and when a load is cancelled,
  /// every call is `crashed` until leave_node().
  /// @pre this runner neither has joined nor is open.
  /// @throws Error that says why it cannot join; then this runner works as before. (If its own
  /// processes do not answer in ten seconds, this and all later calls are `crashed`.)
  void join(const std::string& name);

  /// @brief Undoes join() and open_to_node(). Nothing is loaded then. Local.
  void leave_node();

  /// @brief No later load or job gets more than this, whatever it is given. Local.
  void cap_limits(const JobLimits& largest);

  /// @brief Runs Worker::load(message) in the model zygote. Local.
  [[nodiscard]] JobOutcome load(std::span<const std::byte> message, const JobLimits& limits,
                                const WaitCallback& on_wait);

  /// @brief Runs Worker::run(request) in a fresh process. Local.
  [[nodiscard]] JobOutcome run(std::span<const std::byte> request, const JobLimits& limits,
                               const WaitCallback& on_wait);

  /// @brief Largest resident memory of the zygotes and one job together so far, bytes. Pages that
  /// they share with each other count once.
  ///
  /// Every process reports its part at its end: a zygote its proportional size, a job its private
  /// pages and what it gave back since its peak. Of a process that died only the peak is known.
  /// What counts for it is that less the size of the model zygote, a lower bound.
  [[nodiscard]] std::size_t peak_rss_bytes() const;

  /// @brief What was used since the last restart_usage(), or ever. Local.
  [[nodiscard]] JobUsage usage() const;

  /// @brief Begins a new measurement for usage(); peak_rss_bytes() stays over all. Local.
  void restart_usage();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tessera::jobs

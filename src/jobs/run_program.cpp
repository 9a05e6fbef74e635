// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/jobs/run_program.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "tessera/base/error.hpp"

#include "jobs/child_process.hpp"
#include "jobs/process_usage.hpp"
#include "jobs/watch.hpp"

namespace tessera::jobs {
namespace {

using Clock = std::chrono::steady_clock;

// What a shell says of a program that it does not find.
constexpr int kNotFound = 127;
constexpr std::chrono::milliseconds kBetweenLooks{10};

[[noreturn]] void become_program(std::vector<char*> arguments, const std::filesystem::path& folder,
                                 const std::filesystem::path& log_file, pid_t parent)
{
  die_with_parent(parent);
  unblock_signals();
  redirect_output(open_log(log_file));
  close_all_but({});
  if (::chdir(folder.c_str()) == 0) ::execvp(arguments.front(), arguments.data());
  ::_exit(kNotFound);
}

// A program that uses no CPU time, and one that uses too much, is killed.
std::optional<JobStatus> wait_for(pid_t child, const JobLimits& limits, int& wait_status)
{
  Watch watch(limits, 0.0);
  std::optional<JobStatus> broken;
  auto last_look = Clock::now();
  for (;;) {
    const pid_t ended = ::waitpid(child, &wait_status, WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) return broken;
    std::this_thread::sleep_for(kBetweenLooks);
    const auto now = Clock::now();
    const std::chrono::duration<double> since = now - last_look;
    last_look = now;
    if (broken) continue;
    broken = watch.look(sample_process(child), since.count());
    if (broken) ::kill(child, SIGKILL);
  }
}

}  // namespace

ProgramOutcome run_program(const std::vector<std::string>& arguments,
                           const std::filesystem::path& folder,
                           const std::filesystem::path& log_file, const JobLimits& limits)
{
  std::vector<std::string> owned = arguments;
  std::vector<char*> raw;
  for (std::string& argument : owned) raw.push_back(argument.data());
  raw.push_back(nullptr);
  flush_streams();
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw MeshError("no process could be started for " + arguments.front());
  if (child == 0) become_program(std::move(raw), folder, log_file, parent);
  int wait_status = 0;
  const std::optional<JobStatus> broken = wait_for(child, limits, wait_status);
  if (broken) return {.status = *broken, .code = SIGKILL};
  if (WIFSIGNALED(wait_status))
    return {.status = JobStatus::crashed, .code = WTERMSIG(wait_status)};
  const int code = WEXITSTATUS(wait_status);
  return {.status = code == 0 ? JobStatus::ok : JobStatus::exited,
          .code = code,
          .is_missing = code == kNotFound};
}

bool is_on_path(const std::string& name)
{
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (::access(file.c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace tessera::jobs

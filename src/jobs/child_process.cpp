// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/child_process.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tessera::jobs {
namespace {

double seconds(const timeval& time)
{
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

using CoreSets = std::array<cpu_set_t, kMostCores / CPU_SETSIZE>;

}  // namespace

void die_with_parent(pid_t parent)
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // It may have died before the line above.
  if (::getppid() != parent) ::_exit(1);
}

void ignore_group_signals()
{
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGHUP, SIGPIPE})
    std::signal(signal, SIG_IGN);
  // Inherited as ignored, it would keep children from being waited for.
  std::signal(SIGCHLD, SIG_DFL);
}

void unblock_signals()
{
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

void close_all_but(std::span<const int> keep)
{
  std::vector<int> open;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    open.push_back(std::stoi(entry.path().filename().string()));
  for (const int descriptor : open) {
    const bool kept = std::find(keep.begin(), keep.end(), descriptor) != keep.end();
    if (descriptor > STDERR_FILENO && !kept) ::close(descriptor);
  }
}

FileDescriptor open_log(const std::filesystem::path& file)
{
  if (file.empty()) return {};
  return FileDescriptor(
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0644));
}

void redirect_output(const FileDescriptor& log)
{
  FileDescriptor nothing;
  if (log.get() < 0) nothing = FileDescriptor(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  const int output = log.get() < 0 ? nothing.get() : log.get();
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
}

std::optional<Cores> cores_of(pid_t process)
{
  CoreSets sets{};
  if (::sched_getaffinity(process, sizeof(sets), sets.data()) != 0) return std::nullopt;
  Cores cores;
  for (std::size_t core = 0; core < cores.size(); ++core)
    cores[core] = CPU_ISSET_S(core, sizeof(sets), sets.data());
  return cores;
}

bool move_to(const Cores& cores)
{
  CoreSets sets{};
  for (std::size_t core = 0; core < cores.size(); ++core)
    if (cores[core]) CPU_SET_S(core, sizeof(sets), sets.data());
  return ::sched_setaffinity(0, sizeof(sets), sets.data()) == 0;
}

void flush_streams()
{
  std::cout.flush();
  std::clog.flush();
  std::fflush(nullptr);
}

ChildWatch::ChildWatch()
{
  sigset_t child_ended;
  ::sigemptyset(&child_ended);
  ::sigaddset(&child_ended, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &child_ended, nullptr);
  signals_ = FileDescriptor(::signalfd(-1, &child_ended, SFD_CLOEXEC | SFD_NONBLOCK));
}

void ChildWatch::wait(std::vector<pollfd> polled) const
{
  polled.push_back({.fd = signals_.get(), .events = POLLIN, .revents = 0});
  ::poll(polled.data(), polled.size(), -1);
  signalfd_siginfo info{};
  while (::read(signals_.get(), &info, sizeof(info)) > 0) {
  }
}

std::optional<ProcessEnd> ChildWatch::reap(pid_t child) const
{
  ProcessEnd end;
  rusage usage{};
  if (child <= 0 || ::wait4(child, &end.wait_status, WNOHANG, &usage) != child) return std::nullopt;
  end.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.peak_rss_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  return end;
}

}  // namespace tessera::jobs

// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/process_usage.hpp"

#include <array>
#include <cstdio>
#include <ctime>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "tessera/base/file_descriptor.hpp"
#include "tessera/jobs/this_process.hpp"

#include "jobs/child_process.hpp"

namespace tessera::jobs {
namespace {

// Files of /proc are small and come in one read; empty if there is no such process.
std::string read_proc_file(pid_t pid, const char* name)
{
  const std::string path = fmt::format("/proc/{}/{}", pid, name);
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 4096> text;
  const ssize_t size = ::read(file.get(), text.data(), text.size());
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
}

// The value of a line "label:   123 kB", in bytes.
std::size_t bytes_of_line(const std::string& text, const std::string& label)
{
  const std::size_t at = text.find(fmt::format("\n{}:", label));
  unsigned long kib = 0;
  if (at == std::string::npos
      || std::sscanf(text.c_str() + at + label.size() + 2, "%lu", &kib) != 1)
    return 0;
  return std::size_t{kib} * 1024;
}

}  // namespace

std::optional<ProcessSample> sample_process(pid_t pid)
{
  // "pid (name) state …": a name may hold spaces and parentheses, so count from the last one. The
  // numbers are the fields' numbers in proc(5).
  const std::string text = read_proc_file(pid, "stat");
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;

  char state = 0;
  unsigned long user_ticks = 0;
  unsigned long system_ticks = 0;
  long rss_pages = 0;
  constexpr const char* kFields3To24 =
      " %c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu %*d %*d %*d %*d %*d %*d %*u %*u %ld";
  if (std::sscanf(text.c_str() + name_end + 1, kFields3To24, &state, &user_ticks, &system_ticks,
                  &rss_pages)
      != 4)
    return std::nullopt;

  static const auto ticks_per_s = static_cast<double>(::sysconf(_SC_CLK_TCK));
  static const auto page_bytes = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return ProcessSample{.cpu_s = static_cast<double>(user_ticks + system_ticks) / ticks_per_s,
                       .rss_bytes = static_cast<std::size_t>(rss_pages) * page_bytes,
                       .runnable = state == 'R'};
}

std::size_t proportional_rss_bytes(pid_t pid)
{
  return bytes_of_line(read_proc_file(pid, "smaps_rollup"), "Pss");
}

std::size_t private_rss_bytes()
{
  const std::string text = read_proc_file(::getpid(), "smaps_rollup");
  return bytes_of_line(text, "Private_Clean") + bytes_of_line(text, "Private_Dirty");
}

std::size_t peak_rss_bytes(pid_t pid)
{
  return bytes_of_line(read_proc_file(pid, "status"), "VmHWM");
}

double cpu_time_of_this_process()
{
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::size_t peak_rss_of_this_process() { return peak_rss_bytes(::getpid()); }

std::vector<int> cores_of_this_thread()
{
  const Cores cores = cores_of(0).value_or(Cores{});
  std::vector<int> numbers;
  for (std::size_t core = 0; core < cores.size(); ++core) {
    if (cores[core]) numbers.push_back(static_cast<int>(core));
  }
  return numbers;
}

}  // namespace tessera::jobs

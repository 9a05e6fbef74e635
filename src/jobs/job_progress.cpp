// SPDX-License-Identifier: BSD-3-Clause
#include "jobs/job_progress.hpp"

#include <chrono>

#include "tessera/jobs/this_process.hpp"

#include "jobs/packet.hpp"

namespace tessera::jobs {
namespace {

using Clock = std::chrono::steady_clock;

// So seldom that nobody waits for a rank that is slow to read.
constexpr std::chrono::milliseconds kBetweenReports{100};

struct Reports {
  int socket = -1;
  std::uint32_t call = 0;
  Clock::time_point last{};
};

// A process is one job at most.
Reports& reports()
{
  static Reports of_this_process;
  return of_this_process;
}

}  // namespace

void begin_progress_reports(int socket, std::uint32_t call)
{
  reports() = {.socket = socket, .call = call};
}

void report_progress()
{
  Reports& to = reports();
  if (to.socket < 0) return;
  const Clock::time_point now = Clock::now();
  if (now - to.last < kBetweenReports) return;
  to.last = now;
  send_signal(to.socket, PacketKind::progress, to.call);
}

}  // namespace tessera::jobs

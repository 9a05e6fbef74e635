// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/stop_signal.hpp"

#include <csignal>
#include <initializer_list>

#include "tessera/base/error.hpp"

namespace tessera::pipeline {
namespace {

volatile std::sig_atomic_t stop_flag = 0;

extern "C" void note_stop(int signal)
{
  if (stop_flag != 0 && signal == SIGINT) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  }
  stop_flag = 1;
}

}  // namespace

void catch_stop_signals()
{
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, note_stop);
}

void ignore_write_signals()
{
  for (const int signal : {SIGXFSZ, SIGPIPE}) {
    const auto before = std::signal(signal, SIG_IGN);
    if (before != SIG_DFL && before != SIG_ERR) std::signal(signal, before);
  }
}

bool stop_requested() { return stop_flag != 0; }

void throw_if_stop_requested()
{
  if (stop_requested()) throw Interrupted(kStopped);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace tessera {
namespace {

std::atomic<int> threads_of_this_process{1};

}  // namespace

int num_threads() noexcept { return threads_of_this_process; }

void set_num_threads(int count) noexcept { threads_of_this_process = std::max(1, count); }

void for_each_in_threads(std::size_t count, const std::function<void(std::size_t)>& work)
{
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> errors(count);
  const auto run = [&] {
    for (std::size_t item = next++; item < count; item = next++) {
      try {
        work(item);
      } catch (...) {
        errors[item] = std::current_exception();
      }
    }
  };
  {
    const std::size_t most = std::min(count, static_cast<std::size_t>(num_threads()));
    std::vector<std::jthread> others;
    try {
      while (others.size() + 1 < most) others.emplace_back(run);
    } catch (const std::system_error&) {  // There are as many as the system allows.
    }
    run();
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

void for_each_chunk_in_threads(std::size_t count,
                               const std::function<void(std::size_t, std::size_t)>& work)
{
  constexpr std::size_t kItems = 4096;
  for_each_in_threads((count + kItems - 1) / kItems, [&](std::size_t chunk) {
    work(chunk * kItems, std::min(count, (chunk + 1) * kItems));
  });
}

}  // namespace tessera

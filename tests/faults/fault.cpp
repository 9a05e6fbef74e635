// SPDX-License-Identifier: BSD-3-Clause
#include "faults/fault.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>

#include "tessera/base/error.hpp"

namespace tessera::testing {
namespace {

constexpr std::array<std::string_view, 18> kStages{
    "import", "load", "box",  "describe", "coarse", "remesh", "gmsh",  "domain", "layers",
    "rims",   "plan", "fill", "improve",  "refine", "skin",   "share", "map",    "join"};
constexpr std::array<std::string_view, 11> kKinds{
    "throw", "segv", "exit", "loop", "sleep", "hold", "memory", "garbage", "drop", "nudge", "lose"};
constexpr const char* kHoldFile = "hold";

struct Fault {
  std::string stage{};
  std::string kind{};
  std::string item{};  ///< Empty: all of them.
};

Fault parse_fault(const std::string& word)
{
  const std::size_t equals = std::min(word.find('='), word.size());
  const std::size_t at_sign = std::min(word.find('@', equals), word.size());
  Fault fault;
  fault.stage = word.substr(0, equals);
  if (equals < at_sign) fault.kind = word.substr(equals + 1, at_sign - equals - 1);
  if (at_sign < word.size()) fault.item = word.substr(at_sign + 1);
  const bool is_known = std::ranges::find(kStages, fault.stage) != kStages.end()
                        && std::ranges::find(kKinds, fault.kind) != kKinds.end();
  if (is_known) return fault;
  throw ConfigError("TESSERA_TEST_FAULT must be STAGE=KIND or STAGE=KIND@ITEM, and is " + word);
}

std::vector<Fault> asked_faults()
{
  std::vector<Fault> faults;
  const char* const asked = std::getenv("TESSERA_TEST_FAULT");
  if (asked == nullptr) return faults;
  std::istringstream words(asked);
  for (std::string word; words >> word;) faults.push_back(parse_fault(word));
  return faults;
}

[[noreturn]] void loop_for_ever()
{
  volatile unsigned counter = 0;
  for (;;) counter = counter + 1;
}

void wait_for_end_of_hold()
{
  while (std::filesystem::exists(kHoldFile))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

[[noreturn]] void take_all_memory()
{
  constexpr std::size_t kBlock = std::size_t{64} << 20;
  std::vector<std::vector<char>> blocks;
  for (;;) blocks.emplace_back(kBlock, 'x');
}

// A page without access is touched, so the signal is the kernel's own.
void touch_no_mans_land()
{
  constexpr std::size_t kPage = 4096;
  void* const page = mmap(nullptr, kPage, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  *static_cast<volatile char*>(page) = 1;
}

}  // namespace

void obey_test_environment(jobs::JobRunner& jobs)
{
  static_cast<void>(asked_faults());
  const char* const asked = std::getenv("TESSERA_TEST_LIMITS");
  if (asked == nullptr) return;
  jobs::JobLimits limits;
  std::istringstream words(asked);
  if (!(words >> limits.cpu_s >> limits.stall_s >> limits.memory_gib)) {
    throw ConfigError("TESSERA_TEST_LIMITS must be three numbers");
  }
  jobs.cap_limits(limits);
}

std::string kind_at(std::string_view stage, LocalIndex item)
{
  for (const Fault& fault : asked_faults()) {
    const bool is_here = fault.item.empty() || fault.item == fmt::to_string(item);
    if (fault.stage == stage && is_here) return fault.kind;
  }
  return {};
}

void fail_if_asked(std::string_view stage, LocalIndex item)
{
  const std::string kind = kind_at(stage, item);
  if (kind == "throw") throw NetgenError("thrown for a test");
  if (kind == "segv") touch_no_mans_land();
  if (kind == "exit") std::exit(1);
  if (kind == "loop") loop_for_ever();
  if (kind == "sleep") std::this_thread::sleep_for(std::chrono::hours(24));
  if (kind == "hold") wait_for_end_of_hold();
  if (kind == "memory") take_all_memory();
}

Bytes garbled_if_asked(std::string_view stage, LocalIndex item, Bytes result)
{
  if (kind_at(stage, item) != "garbage") return result;
  for (std::byte& byte : result) byte = ~byte;
  return result;
}

}  // namespace tessera::testing

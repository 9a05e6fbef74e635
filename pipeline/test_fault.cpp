// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/test_fault.hpp"

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/mman.h>

#include "tessera/base/error.hpp"

namespace tessera::pipeline {
namespace {

[[noreturn]] void loop_for_ever()
{
  volatile unsigned counter = 0;
  for (;;) counter = counter + 1;
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

class FaultyKernel final : public fill::Kernel {
 public:
  FaultyKernel(std::unique_ptr<fill::Kernel> sound, std::string kind)
      : sound_(std::move(sound)), kind_(std::move(kind))
  {
  }

  [[nodiscard]] fill::FillOutput fill(const fill::FillInput& input,
                                      const fill::FillTry& settings) const override
  {
    if (kind_ == "throw") throw NetgenError("fill: thrown for a test");
    if (kind_ == "segv") touch_no_mans_land();
    if (kind_ == "exit") std::exit(1);
    if (kind_ == "loop") loop_for_ever();
    if (kind_ == "sleep") std::this_thread::sleep_for(std::chrono::hours(24));
    if (kind_ == "memory") take_all_memory();
    fill::FillOutput output = sound_->fill(input, settings);
    if (kind_ != "drop") throw ConfigError("TESSERA_TEST_FAULT: no fault is called " + kind_);
    output.tet_vertices.resize(output.tet_vertices.size() - 4);
    return output;
  }

 private:
  std::unique_ptr<fill::Kernel> sound_;
  std::string kind_;
};

}  // namespace

std::unique_ptr<fill::Kernel> make_faulty_if_asked(std::unique_ptr<fill::Kernel> kernel,
                                                   LocalIndex subdomain)
{
  const char* asked = std::getenv("TESSERA_TEST_FAULT");
  if (asked == nullptr) return kernel;
  const std::string text = asked;
  const std::size_t at_sign = text.find('@');
  if (!text.starts_with("fill=") || at_sign == std::string::npos) {
    throw ConfigError("TESSERA_TEST_FAULT must be fill=KIND@SUBDOMAIN");
  }
  if (text.substr(at_sign + 1) != std::to_string(subdomain)) return kernel;
  return std::make_unique<FaultyKernel>(std::move(kernel), text.substr(5, at_sign - 5));
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/test_fault.hpp"

#include <chrono>
#include <cstdlib>
#include <optional>
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

// Fails as asked, unless the fault is one of the result.
void fail(const std::string& kind)
{
  if (kind == "throw") throw NetgenError("thrown for a test");
  if (kind == "segv") touch_no_mans_land();
  if (kind == "exit") std::exit(1);
  if (kind == "loop") loop_for_ever();
  if (kind == "sleep") std::this_thread::sleep_for(std::chrono::hours(24));
  if (kind == "memory") take_all_memory();
  if (kind != "drop") throw ConfigError("TESSERA_TEST_FAULT: no fault is called " + kind);
}

void drop_a_tet(std::vector<LocalIndex>& tet_vertices)
{
  tet_vertices.resize(tet_vertices.size() - 4);
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
    fail(kind_);
    fill::FillOutput output = sound_->fill(input, settings);
    drop_a_tet(output.tet_vertices);
    return output;
  }

 private:
  std::unique_ptr<fill::Kernel> sound_;
  std::string kind_;
};

class FaultyOptimizer final : public improve::Optimizer {
 public:
  FaultyOptimizer(std::unique_ptr<improve::Optimizer> sound, std::string kind)
      : sound_(std::move(sound)), kind_(std::move(kind))
  {
  }

  [[nodiscard]] improve::TetMesh optimize(const improve::OptimizeInput& input,
                                          const improve::OptimizeSettings& settings) const override
  {
    fail(kind_);
    improve::TetMesh output = sound_->optimize(input, settings);
    drop_a_tet(output.tet_vertices);
    return output;
  }

 private:
  std::unique_ptr<improve::Optimizer> sound_;
  std::string kind_;
};

// The kind of fault that is asked for at this place, if any.
std::optional<std::string> asked_fault(const std::string& stage, LocalIndex item)
{
  const char* asked = std::getenv("TESSERA_TEST_FAULT");
  if (asked == nullptr) return std::nullopt;
  const std::string text = asked;
  const std::size_t equals = text.find('=');
  const std::size_t at_sign = text.find('@');
  if (equals == std::string::npos || at_sign == std::string::npos || at_sign < equals) {
    throw ConfigError("TESSERA_TEST_FAULT must be fill=KIND@SUBDOMAIN or improve=KIND@REGION");
  }
  const bool is_here =
      text.substr(0, equals) == stage && text.substr(at_sign + 1) == std::to_string(item);
  if (!is_here) return std::nullopt;
  return text.substr(equals + 1, at_sign - equals - 1);
}

}  // namespace

std::unique_ptr<fill::Kernel> make_faulty_if_asked(std::unique_ptr<fill::Kernel> kernel,
                                                   LocalIndex subdomain)
{
  const auto fault = asked_fault("fill", subdomain);
  if (!fault) return kernel;
  return std::make_unique<FaultyKernel>(std::move(kernel), *fault);
}

std::unique_ptr<improve::Optimizer> make_faulty_if_asked(
    std::unique_ptr<improve::Optimizer> optimizer, LocalIndex region)
{
  const auto fault = asked_fault("improve", region);
  if (!fault) return optimizer;
  return std::make_unique<FaultyOptimizer>(std::move(optimizer), *fault);
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/test_fault.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>

#include "tessera/base/error.hpp"

namespace tessera::pipeline {
namespace {

constexpr std::array<std::string_view, 16> kStages{
    "import", "load", "box",     "describe", "coarse", "remesh", "gmsh", "domain",
    "plan",   "fill", "improve", "refine",   "skin",   "share",  "map",  "join"};
constexpr std::array<std::string_view, 10> kKinds{"throw",  "segv",    "exit", "loop",  "sleep",
                                                  "memory", "garbage", "drop", "nudge", "lose"};

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

// The kind of fault that is asked for at this place; empty if there is none.
std::string kind_at(std::string_view stage, LocalIndex item)
{
  for (const Fault& fault : asked_faults()) {
    const bool is_here = fault.item.empty() || fault.item == fmt::to_string(item);
    if (fault.stage == stage && is_here) return fault.kind;
  }
  return {};
}

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

void fail(std::string_view kind)
{
  if (kind == "throw") throw NetgenError("thrown for a test");
  if (kind == "segv") touch_no_mans_land();
  if (kind == "exit") std::exit(1);
  if (kind == "loop") loop_for_ever();
  if (kind == "sleep") std::this_thread::sleep_for(std::chrono::hours(24));
  if (kind == "memory") take_all_memory();
}

void drop_a_tet(std::vector<LocalIndex>& tet_vertices)
{
  tet_vertices.resize(tet_vertices.size() - 4);
}

class FaultyMesher final : public coarse::CoarseMesher {
 public:
  FaultyMesher(std::unique_ptr<coarse::CoarseMesher> sound, LocalIndex rung)
      : sound_(std::move(sound)), rung_(rung)
  {
  }

  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const cut::CutTree& planes) const override
  {
    fail(kind_at(stage_of(options), rung_));
    return sound_->mesh_surface(options, planes);
  }

  [[nodiscard]] surface::DomainTets fill_domain(
      const surface::DomainSkin& skin, const surface::CoarseOptions& options) const override
  {
    return sound_->fill_domain(skin, options);
  }

  [[nodiscard]] surface::DomainTets mesh_domain(
      const surface::DomainSkin& skin, const surface::CoarseOptions& options) const override
  {
    surface::DomainTets tets = sound_->mesh_domain(skin, options);
    if (kind_at(stage_of(options), kNoIndex) == "drop") drop_a_tet(tets.tet_vertices);
    return tets;
  }

  [[nodiscard]] surface::DomainTets improve_domain(const surface::DomainSkin& skin,
                                                   surface::DomainTets tets) const override
  {
    return sound_->improve_domain(skin, std::move(tets));
  }

 private:
  std::unique_ptr<coarse::CoarseMesher> sound_;
  LocalIndex rung_;
};

class FaultyKernel final : public fill::Kernel {
 public:
  FaultyKernel(std::unique_ptr<fill::Kernel> sound, std::string kind)
      : sound_(std::move(sound)), kind_(std::move(kind))
  {
  }

  [[nodiscard]] fill::FillOutput fill(const fill::FillInput& input,
                                      const fill::KernelSettings& settings) const override
  {
    fail(kind_);
    fill::FillOutput output = sound_->fill(input, settings);
    if (kind_ == "drop") drop_a_tet(output.tet_vertices);
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
                                          int rounds) const override
  {
    fail(kind_);
    improve::TetMesh output = sound_->optimize(input, rounds);
    if (kind_ == "drop") drop_a_tet(output.tet_vertices);
    return output;
  }

 private:
  std::unique_ptr<improve::Optimizer> sound_;
  std::string kind_;
};

class NudgedModel final : public model::Model {
 public:
  explicit NudgedModel(const model::Model& sound) : sound_(sound) {}

  [[nodiscard]] bool has_parameters() const override { return sound_.has_parameters(); }
  [[nodiscard]] double surface_tolerance(LocalIndex surface) const override
  {
    return sound_.surface_tolerance(surface);
  }
  [[nodiscard]] double curve_tolerance(LocalIndex curve) const override
  {
    return sound_.curve_tolerance(curve);
  }
  [[nodiscard]] double end_tolerance(LocalIndex curve, const Vec3& point) const override
  {
    return sound_.end_tolerance(curve, point);
  }
  [[nodiscard]] double box_diagonal() const override { return sound_.box_diagonal(); }

  [[nodiscard]] model::SurfacePoint project_to_surface(
      LocalIndex surface, const Vec3& point, const model::SurfaceParameters& guess) const override
  {
    return nudged(sound_.project_to_surface(surface, point, guess));
  }
  [[nodiscard]] model::CurvePoint project_to_curve(LocalIndex curve, const Vec3& point,
                                                   double guess) const override
  {
    return nudged(sound_.project_to_curve(curve, point, guess));
  }

 private:
  template <class Point>
  static Point nudged(Point point)
  {
    double& x = point.xyz[0];
    x = std::nextafter(x, std::numeric_limits<double>::infinity());
    return point;
  }

  const model::Model& sound_;
};

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

void fail_if_asked(std::string_view stage, LocalIndex item) { fail(kind_at(stage, item)); }

Bytes garbled_if_asked(std::string_view stage, Bytes result, LocalIndex item)
{
  if (kind_at(stage, item) != "garbage") return result;
  for (std::byte& byte : result) byte = ~byte;
  return result;
}

std::string_view stage_of(const surface::CoarseOptions& options)
{
  if (options.mesher == surface::Mesher::gmsh) return "gmsh";
  return options.surface_mesher == surface::SurfaceMesher::remesh ? "remesh" : "coarse";
}

std::unique_ptr<coarse::CoarseMesher> make_faulty_if_asked(
    std::unique_ptr<coarse::CoarseMesher> mesher, LocalIndex rung)
{
  if (asked_faults().empty()) return mesher;
  return std::make_unique<FaultyMesher>(std::move(mesher), rung);
}

std::unique_ptr<fill::Kernel> make_faulty_if_asked(std::unique_ptr<fill::Kernel> kernel,
                                                   LocalIndex subdomain)
{
  const std::string kind = kind_at("fill", subdomain);
  if (kind.empty()) return kernel;
  return std::make_unique<FaultyKernel>(std::move(kernel), kind);
}

std::unique_ptr<improve::Optimizer> make_faulty_if_asked(
    std::unique_ptr<improve::Optimizer> optimizer, LocalIndex region)
{
  const std::string kind = kind_at("improve", region);
  if (kind.empty()) return optimizer;
  return std::make_unique<FaultyOptimizer>(std::move(optimizer), kind);
}

std::unique_ptr<model::Model> nudged_if_asked(const model::Model& model, LocalIndex subdomain)
{
  if (kind_at("fill", subdomain) != "nudge") return nullptr;
  return std::make_unique<NudgedModel>(model);
}

// A tet with two new corners has no face on the geometry: without one behind it, the merge of the
// piece would fail already.
void lose_tet_if_asked(std::vector<improve::PieceUpdate>& updates, LocalIndex region)
{
  if (kind_at("improve", region) != "lose") return;
  for (improve::PieceUpdate& update : updates) {
    std::vector<LocalIndex>& tets = update.tet_vertices;
    for (auto tet = tets.begin(); tet != tets.end(); tet += 4) {
      if (std::count_if(tet, tet + 4, [](LocalIndex v) { return v < 0; }) < 2) continue;
      tets.erase(tet, tet + 4);
      return;
    }
  }
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace tessera::pipeline {
namespace {

constexpr std::int64_t kBarWidth = 30;
constexpr double kBarInterval_s = 0.1;
constexpr double kLineInterval_s = 10.0;

std::string duration(double seconds)
{
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const std::int64_t whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace

Progress::Progress(Style style, std::shared_ptr<spdlog::logger> log)
    : style_(style), log_(std::move(log))
{
}

void Progress::begin(const std::string& stage, std::int64_t total, const std::string& unit)
{
  stage_ = stage;
  unit_ = unit;
  total_ = total;
  last_tenth_ = 0;
  start_ = last_output_ = Clock::now();
  if (style_ == Style::bar) draw_bar(0);
}

void Progress::update(std::int64_t done)
{
  if (style_ == Style::silent || total_ == 0) return;
  const double since = std::chrono::duration<double>(Clock::now() - last_output_).count();
  if (style_ == Style::bar) {
    if (since >= kBarInterval_s) draw_bar(done);
    return;
  }
  const std::int64_t tenth = 10 * done / total_;
  if (tenth == last_tenth_ || since < kLineInterval_s) return;
  last_tenth_ = tenth;
  last_output_ = Clock::now();
  log_->info(fmt::format("{:<10} {} of {} {}{}", stage_, done, total_, unit_, rate_and_rest(done)));
}

void Progress::end(const std::string& summary)
{
  clear();
  if (style_ != Style::silent) {
    log_->info(fmt::format("{:<10} {:>12}   {}", stage_, duration(elapsed_s()), summary));
  }
}

void Progress::clear()
{
  if (!bar_is_drawn_) return;
  std::fputs("\r\033[K", stdout);
  std::fflush(stdout);
  bar_is_drawn_ = false;
}

double Progress::elapsed_s() const
{
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string Progress::rate_and_rest(std::int64_t done) const
{
  if (done == 0) return "";
  const double rate = static_cast<double>(done) / std::max(elapsed_s(), 1e-3);
  return fmt::format(", {:.1f} {}/s, {} left", rate, unit_,
                     duration(static_cast<double>(total_ - done) / rate));
}

void Progress::draw_bar(std::int64_t done)
{
  last_output_ = Clock::now();
  bar_is_drawn_ = true;
  if (total_ == 0) {
    fmt::print("\r\033[K{:<10} …", stage_);
  } else {
    const auto filled = static_cast<std::size_t>(kBarWidth * done / total_);
    fmt::print("\r\033[K{:<10} [{:<{}}] {}/{} {}{}", stage_, std::string(filled, '='), kBarWidth,
               done, total_, unit_, rate_and_rest(done));
  }
  std::fflush(stdout);
}

}  // namespace tessera::pipeline

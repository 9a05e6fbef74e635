// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/log.hpp"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

#include "tessera/base/error.hpp"

namespace tessera::pipeline {
namespace {

// "%*": "warning: " or "error: " where people should look, else nothing.
class SeverityMark final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override
  {
    std::string mark;
    if (message.level == spdlog::level::warn) mark = "warning: ";
    if (message.level >= spdlog::level::err) mark = "error: ";
    out.append(mark.data(), mark.data() + mark.size());
  }

  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override
  {
    return spdlog::details::make_unique<SeverityMark>();
  }
};

spdlog::sink_ptr console_sink(Verbosity verbosity)
{
  auto sink = std::make_shared<spdlog::sinks::stdout_sink_st>();
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<SeverityMark>('*').set_pattern("%*%v");
  sink->set_formatter(std::move(formatter));
  sink->set_level(verbosity == Verbosity::quiet     ? spdlog::level::warn
                  : verbosity == Verbosity::verbose ? spdlog::level::debug
                                                    : spdlog::level::info);
  return sink;
}

// A log that cannot be written is no reason to end a run, and is said once.
auto warn_once()
{
  return [was_said = false](const std::string& message) mutable {
    if (!was_said) std::fprintf(stderr, "warning: the log is incomplete: %s\n", message.c_str());
    was_said = true;
  };
}

}  // namespace

std::shared_ptr<spdlog::logger> make_log(const std::filesystem::path& file, Verbosity verbosity)
{
  auto log = std::make_shared<spdlog::logger>("tessera");
  if (file.empty()) {
    log->set_level(spdlog::level::off);
    return log;
  }
  // The sink would follow a link out of the output folder.
  if (std::filesystem::is_symlink(file)) std::filesystem::remove(file);
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string());
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
    log->sinks() = {console_sink(verbosity), sink};
  } catch (const spdlog::spdlog_ex& error) {
    throw OutputError(fmt::format("{}: cannot write the log: {}", file.string(), error.what()));
  }
  log->set_error_handler(warn_once());
  log->set_level(spdlog::level::debug);
  log->flush_on(spdlog::level::info);
  return log;
}

}  // namespace tessera::pipeline

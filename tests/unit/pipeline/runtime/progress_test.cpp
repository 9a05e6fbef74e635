// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/progress.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>

namespace tessera::pipeline {
namespace {

bool has_control_characters(const std::string& text)
{
  return std::any_of(text.begin(), text.end(), [](char c) {
    return std::iscntrl(static_cast<unsigned char>(c)) != 0 && c != '\n';
  });
}

struct ProgressOutput : ::testing::Test {
  std::ostringstream lines{};
  std::shared_ptr<spdlog::logger> log = std::make_shared<spdlog::logger>(
      "test", std::make_shared<spdlog::sinks::ostream_sink_st>(lines));

  ProgressOutput() { log->set_pattern("%v"); }

  // What a stage of ten steps writes on standard output; the log's lines are in `lines`.
  std::string stage(Progress::Style style, std::int64_t total, int wait_ms = 0)
  {
    ::testing::internal::CaptureStdout();
    Progress progress(style, log);
    progress.begin("fill", total, "subdomains");
    for (std::int64_t done = 0; done <= std::max<std::int64_t>(total, 3); ++done) {
      std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
      progress.update(done);
    }
    progress.end("12 tets");
    return ::testing::internal::GetCapturedStdout();
  }
};

TEST_F(ProgressOutput, InALogIsOnePlainLineAStage)
{
  EXPECT_EQ(stage(Progress::Style::lines, 7), "");
  const std::string text = lines.str();
  EXPECT_FALSE(has_control_characters(text));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.find("fill"), 0U);
  EXPECT_NE(text.find(" s   12 tets"), std::string::npos);
}

TEST_F(ProgressOutput, OfOtherRanksIsNothing)
{
  EXPECT_EQ(stage(Progress::Style::silent, 7), "");
  EXPECT_EQ(lines.str(), "");
}

TEST_F(ProgressOutput, OnATerminalIsABarThatIsGoneAfterwards)
{
  const std::string text = stage(Progress::Style::bar, 2, 120);
  EXPECT_NE(text.find("0/2 subdomains"), std::string::npos);
  EXPECT_NE(text.find("[===============               ] 1/2"), std::string::npos);
  EXPECT_NE(text.find("/s, "), std::string::npos);
  EXPECT_TRUE(text.ends_with("\r\033[K"));
  EXPECT_NE(lines.str().find("12 tets"), std::string::npos);
}

TEST_F(ProgressOutput, OfUnknownWorkHasNoBarAndNoRate)
{
  const std::string text = stage(Progress::Style::bar, 0, 120);
  EXPECT_EQ(text.find('['), text.find("[K"));
  EXPECT_EQ(text.find("/s"), std::string::npos);
  EXPECT_EQ(stage(Progress::Style::lines, 0), "");
}

TEST_F(ProgressOutput, IsDrawnAtMostTenTimesASecond)
{
  const std::string text = stage(Progress::Style::bar, 1000);
  EXPECT_LE(std::count(text.begin(), text.end(), '\r'), 20);
}

TEST_F(ProgressOutput, ClearTakesTheBarAwayOnce)
{
  ::testing::internal::CaptureStdout();
  Progress progress(Progress::Style::bar, log);
  progress.clear();
  progress.begin("plan", 0, "");
  progress.clear();
  progress.clear();
  const std::string text = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);  // Drawn, taken away.
}

}  // namespace
}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/html.hpp"

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tessera::pipeline {
namespace {

Bytes bytes_of(std::string_view text)
{
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::size_t count_of(const std::string& text, std::string_view word)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Escaped, LeavesNothingThatCouldEndATextOrAnAttribute)
{
  EXPECT_EQ(escaped("<script>alert('1')</script>"),
            "&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;");
  EXPECT_EQ(escaped("a \"b\" & c"), "a &quot;b&quot; &amp; c");
  EXPECT_EQ(escaped("&lt;"), "&amp;lt;");
}

TEST(Escaped, KeepsOtherAlphabetsAndReplacesControlCharacters)
{
  EXPECT_EQ(escaped("Außen → 入口"), "Außen → 入口");
  EXPECT_EQ(escaped("a\nb\tc"), "a\nb\tc");
  EXPECT_EQ(escaped(std::string_view("a\0b\x1b", 4)),
            "a\xef\xbf\xbd"
            "b\xef\xbf\xbd");
}

TEST(ShellWord, QuotesWhatAShellWouldTakeApart)
{
  EXPECT_EQ(shell_word("outputs/shaft_2"), "outputs/shaft_2");
  EXPECT_EQ(shell_word("my mesh"), "'my mesh'");
  EXPECT_EQ(shell_word("it's; rm"), "'it'\\''s; rm'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(Base64, PadsAsRfc4648Says)
{
  for (const auto& [text, expected] :
       std::vector<std::pair<std::string, std::string>>{{"", ""},
                                                        {"f", "Zg=="},
                                                        {"fo", "Zm8="},
                                                        {"foo", "Zm9v"},
                                                        {"foob", "Zm9vYg=="},
                                                        {"\xff\xfe\xfd", "//79"}}) {
    EXPECT_EQ(base64(bytes_of(text)), expected);
  }
}

TEST(Numbers, AreWrittenForPeople)
{
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(-1000), "-1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(duration_text(0.125), "0.12 s");
  EXPECT_EQ(duration_text(12.34), "12.3 s");
  EXPECT_EQ(duration_text(245.0), "4 min 05 s");
  EXPECT_EQ(duration_text(7800.0), "2 h 10 min");
  EXPECT_EQ(bytes_text(0.0), "0 B");
  EXPECT_EQ(bytes_text(1.5e9), "1.5 GB");
}

TEST(HistogramSvg, ShowsEveryBinThatIsNotEmpty)
{
  const std::string svg =
      histogram_svg({.title = "angle <deg>"}, {{"a", {0, 1, 0, 1'000'000}, {{1, 2, 3}}}});
  EXPECT_EQ(count_of(svg, "<rect"), 2U);
  EXPECT_NE(svg.find("1,000,000 tets from 0.75 to 1"), std::string::npos);
  EXPECT_EQ(svg.find("<deg>"), std::string::npos);
  EXPECT_NE(svg.find("#010203"), std::string::npos);
  const std::regex height("height=\"([0-9.]+)\" fill");
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), height); at != std::sregex_iterator();
       ++at) {
    EXPECT_GE(std::stod((*at)[1]), 1.0);
  }
}

TEST(HistogramSvg, OfNothingIsAnEmptyChart)
{
  EXPECT_EQ(count_of(histogram_svg({}, {{"a", {0, 0}, {{0, 0, 0}}}}), "<rect"), 0U);
}

TEST(BarsSvg, PutsPartsSideBySide)
{
  const std::string svg =
      bars_svg({.title = "times", .full = 4.0, .width = 1000.0},
               {{"fill", {{1.0, "#111", "busy"}, {2.0, "#222", "idle"}}, "<3 s"}});
  EXPECT_NE(svg.find("width=\"150.00\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("width=\"300.00\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("&lt;3 s"), std::string::npos);
}

TEST(BarsSvg, HasNoBarsWithoutTime)
{
  const std::string svg = bars_svg({.full = 0.0}, {{"fill", {{0.0, "#111", "busy"}}, ""}});
  EXPECT_NE(svg.find("width=\"0.00\""), std::string::npos) << svg;
}

TEST(Sections, WithoutContentAreLeftOut)
{
  EXPECT_EQ(section_html("Pictures", ""), "");
  EXPECT_NE(section_html("a < b", "x").find("<h2>a &lt; b</h2>"), std::string::npos);
}

}  // namespace
}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/xml_escape.hpp"

#include <gtest/gtest.h>

namespace tessera {
namespace {

TEST(XmlEscape, WritesWhatXmlHasAMeaningFor)
{
  EXPECT_EQ(xml_escape(R"(<a b="c" d='e'> & </a>)"),
            "&lt;a b=&quot;c&quot; d=&apos;e&apos;&gt; &amp; &lt;/a&gt;");
}

TEST(XmlEscape, EscapesWhatIsEscapedAgain) { EXPECT_EQ(xml_escape("&lt;"), "&amp;lt;"); }

TEST(XmlEscape, LeavesAllOtherText)
{
  EXPECT_EQ(xml_escape(""), "");
  EXPECT_EQ(xml_escape("wall_1 Öl/Wasser;\n"), "wall_1 Öl/Wasser;\n");
}

}  // namespace
}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace tessera {

/// @brief A character that XML and HTML have a meaning of their own for, and how it is written.
struct XmlEntity {
  std::string_view written{};
  char character = 0;
};
inline constexpr std::array kXmlEntities{XmlEntity{"&amp;", '&'}, XmlEntity{"&lt;", '<'},
                                         XmlEntity{"&gt;", '>'}, XmlEntity{"&quot;", '"'},
                                         XmlEntity{"&apos;", '\''}};

/// @brief `text` as the text of an element of XML or HTML, or as the value of an attribute.
[[nodiscard]] std::string xml_escape(std::string_view text);

}  // namespace tessera

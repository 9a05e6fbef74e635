// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/xml_escape.hpp"

#include <algorithm>

namespace tessera {

std::string xml_escape(std::string_view text)
{
  std::string escaped;
  for (const char character : text) {
    const auto* entity = std::ranges::find(kXmlEntities, character, &XmlEntity::character);
    if (entity == kXmlEntities.end()) {
      escaped += character;
    } else {
      escaped += entity->written;
    }
  }
  return escaped;
}

}  // namespace tessera

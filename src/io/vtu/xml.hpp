// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::io {

/// @brief One element of an XML file.
struct XmlElement {
  std::string name{};
  std::map<std::string, std::string> attributes{};
  std::string_view text{};  ///< First text in it that is not blank, as in the file; a view of it.
  std::vector<XmlElement> children{};

  /// @brief Value of an attribute. @throws InputError if it is missing.
  [[nodiscard]] const std::string& attribute(const std::string& key) const;
  [[nodiscard]] std::string attribute_or(const std::string& key, const std::string& other) const;
  /// @brief An attribute that is a count. @throws InputError if it is missing or not a count.
  [[nodiscard]] std::size_t count_attribute(const std::string& key) const;
  /// @brief First child of that name, or null.
  [[nodiscard]] const XmlElement* child(std::string_view child_name) const;
};

/// @brief A VTK XML file. Its tail, the element "AppendedData", may hold raw bytes and is not XML.
struct XmlDocument {
  XmlElement root{};
  std::string_view appended{};  ///< All that follows the "_" of AppendedData; empty without one.
  bool appended_is_base64 = false;
};

/// @brief Parses the part of XML that VTK files use. The result refers to `file`. Local.
///
/// Own, because a general parser stops at raw bytes, and so that depth and memory are bounded by
/// the size of the file. @throws InputError saying what is wrong and at which byte.
[[nodiscard]] XmlDocument parse_vtk_xml(std::string_view file);

}  // namespace tessera::io

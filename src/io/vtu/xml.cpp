// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu/xml.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/xml_escape.hpp"

namespace tessera::io {
namespace {

constexpr std::string_view kSpace = " \t\r\n";
constexpr std::size_t kMaxDepth = 64;

class Parser {
 public:
  explicit Parser(std::string_view file) : file_(file) {}

  [[nodiscard]] XmlDocument parse()
  {
    while (!done_) {
      const std::size_t tag = file_.find('<', at_);
      if (tag == std::string_view::npos) fail("the file ends within an element");
      keep_text(file_.substr(at_, tag - at_));
      at_ = tag + 1;
      parse_tag();
    }
    return std::move(document_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const
  {
    throw InputError(fmt::format("not a sound VTK XML file: {} (byte {})", what, at_));
  }

  void require(bool condition, const char* what) const
  {
    if (!condition) fail(what);
  }

  [[nodiscard]] char peek() const
  {
    require(at_ < file_.size(), "the file ends within a tag");
    return file_[at_];
  }

  void skip_space() { at_ = std::min(file_.find_first_not_of(kSpace, at_), file_.size()); }

  void skip_past(std::string_view end)
  {
    at_ = file_.find(end, at_);
    require(at_ != std::string_view::npos, "the file ends within a comment or declaration");
    at_ += end.size();
  }

  void keep_text(std::string_view text)
  {
    const bool is_blank = text.find_first_not_of(kSpace) == std::string_view::npos;
    if (!is_blank && !open_.empty() && open_.back()->text.empty()) open_.back()->text = text;
  }

  void parse_tag()
  {
    const std::string_view rest = file_.substr(at_);
    if (rest.starts_with("!--")) {
      skip_past("-->");
    } else if (rest.starts_with("?") || rest.starts_with("!")) {
      skip_past(">");
    } else if (rest.starts_with("/")) {
      ++at_;
      close_element(parse_name());
    } else {
      open_element();
    }
  }

  [[nodiscard]] std::string parse_name()
  {
    const std::size_t end = std::min(file_.find_first_of(" \t\r\n=/><\"'", at_), file_.size());
    require(end > at_, "a name is missing");
    const std::string_view name = file_.substr(at_, end - at_);
    at_ = end;
    return std::string(name);
  }

  void open_element()
  {
    XmlElement element;
    element.name = parse_name();
    for (skip_space(); peek() != '>' && peek() != '/'; skip_space()) {
      parse_attribute(element);
    }
    const bool is_closed = peek() == '/';
    if (is_closed) ++at_;
    require(peek() == '>', "a tag does not end");
    ++at_;
    require(open_.size() < kMaxDepth, "elements are nested too deeply");

    XmlElement* added = &document_.root;
    if (open_.empty()) {
      document_.root = std::move(element);
    } else {
      added = &open_.back()->children.emplace_back(std::move(element));
    }
    open_.push_back(added);
    if (added->name == "AppendedData") return take_appended(*added);
    if (is_closed) pop();
  }

  void parse_attribute(XmlElement& element)
  {
    const std::string key = parse_name();
    skip_space();
    require(peek() == '=', "an attribute has no value");
    ++at_;
    skip_space();
    const char quote = peek();
    require(quote == '"' || quote == '\'', "the value of an attribute has no quotes");
    ++at_;
    const std::size_t end = file_.find(quote, at_);
    require(end != std::string_view::npos, "the value of an attribute does not end");
    element.attributes[key] = unescape(file_.substr(at_, end - at_));
    at_ = end + 1;
  }

  /// Entities that are not known stay as they are: they can only be in names that nobody asks for.
  [[nodiscard]] static std::string unescape(std::string_view text)
  {
    std::string plain;
    while (!text.empty()) {
      const auto* entity = std::ranges::find_if(kXmlEntities, [&](const XmlEntity& candidate) {
        return text.starts_with(candidate.written);
      });
      const bool is_entity = entity != kXmlEntities.end();
      plain += is_entity ? entity->character : text.front();
      text.remove_prefix(is_entity ? entity->written.size() : 1);
    }
    return plain;
  }

  void close_element(const std::string& name)
  {
    skip_space();
    require(peek() == '>', "a tag does not end");
    ++at_;
    require(!open_.empty() && open_.back()->name == name, "an end tag does not match");
    pop();
  }

  void pop()
  {
    open_.pop_back();
    done_ = open_.empty();
  }

  void take_appended(const XmlElement& element)
  {
    skip_space();
    require(peek() == '_', "appended data do not begin with _");
    document_.appended = file_.substr(at_ + 1);
    document_.appended_is_base64 = element.attribute_or("encoding", "base64") == "base64";
    done_ = true;
  }

  std::string_view file_;
  std::size_t at_ = 0;
  bool done_ = false;
  XmlDocument document_{};
  std::vector<XmlElement*> open_{};  ///< From the root to where the parser is.
};

}  // namespace

const std::string& XmlElement::attribute(const std::string& key) const
{
  const auto found = attributes.find(key);
  if (found == attributes.end()) {
    throw InputError(fmt::format("element {} has no attribute {}", name, key));
  }
  return found->second;
}

std::string XmlElement::attribute_or(const std::string& key, const std::string& other) const
{
  const auto found = attributes.find(key);
  return found == attributes.end() ? other : found->second;
}

std::size_t XmlElement::count_attribute(const std::string& key) const
{
  const std::string& value = attribute(key);
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), count);
  if (error != std::errc() || end != value.data() + value.size()) {
    throw InputError(fmt::format("attribute {} of element {} is not a count", key, name));
  }
  return count;
}

const XmlElement* XmlElement::child(std::string_view child_name) const
{
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

XmlDocument parse_vtk_xml(std::string_view file) { return Parser(file).parse(); }

}  // namespace tessera::io

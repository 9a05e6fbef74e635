// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files/netcdf_file.hpp"

#include <algorithm>
#include <string_view>

namespace tessera::formats {
namespace {

// Numbers that the format has for what lists hold.
constexpr std::uint32_t kNothing = 0;
constexpr std::uint32_t kDimensions = 10;
constexpr std::uint32_t kVariables = 11;
constexpr std::uint32_t kAttributes = 12;

constexpr GlobalIndex kAlignment = 8;  // The format asks for 4; so arrays of 8 bytes are aligned.

GlobalIndex padded(GlobalIndex size, GlobalIndex alignment)
{
  return (size + alignment - 1) / alignment * alignment;
}

GlobalIndex size_of(NetcdfType type)
{
  switch (type) {
    case NetcdfType::text:
      return 1;
    case NetcdfType::int32:
    case NetcdfType::float32:
      return 4;
    case NetcdfType::float64:
    case NetcdfType::int64:
      return 8;
  }
  return 1;
}

class Header {
 public:
  explicit Header(const NetcdfLayout& layout) : layout_(layout) {}

  // @param begins Of each variable.
  std::string bytes(const std::vector<GlobalIndex>& begins)
  {
    bytes_ = "CDF\x05";
    count(0);  // Of records.
    list(kDimensions, layout_.dimensions.size());
    for (const NetcdfDimension& dimension : layout_.dimensions) {
      text(dimension.name);
      count(dimension.length);
    }
    attributes(layout_.attributes);
    list(kVariables, layout_.variables.size());
    for (std::size_t v = 0; v < begins.size(); ++v) variable(layout_.variables[v], begins[v]);
    return std::move(bytes_);
  }

  [[nodiscard]] bool is_of_records(const NetcdfVariable& variable) const
  {
    return !variable.dimensions.empty() && length_of(variable.dimensions.front()) == 0;
  }

  // Of records: of one.
  [[nodiscard]] GlobalIndex bytes_of(const NetcdfVariable& variable) const
  {
    GlobalIndex size = size_of(variable.type);
    for (const std::string& name : variable.dimensions)
      size *= std::max(length_of(name), GlobalIndex{1});
    return size;
  }

 private:
  template <class Value>
  void put(Value value)
  {
    bytes_ += big_endian(std::span<const Value>(&value, 1));
  }

  void count(GlobalIndex value) { put(value); }

  void list(std::uint32_t kind, std::size_t length)
  {
    put(length == 0 ? kNothing : kind);
    count(static_cast<GlobalIndex>(length));
  }

  void padding() { bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0'); }

  void text(std::string_view characters)
  {
    count(static_cast<GlobalIndex>(characters.size()));
    bytes_ += characters;
    padding();
  }

  void type(NetcdfType type) { put(static_cast<std::uint32_t>(type)); }

  void value_of(const std::string& characters)
  {
    type(NetcdfType::text);
    text(characters);
  }

  void value_of(std::int32_t value)
  {
    type(NetcdfType::int32);
    count(1);
    put(value);
  }

  void value_of(float value)
  {
    type(NetcdfType::float32);
    count(1);
    put(value);
  }

  void attributes(const std::vector<NetcdfAttribute>& attributes)
  {
    list(kAttributes, attributes.size());
    for (const NetcdfAttribute& attribute : attributes) {
      text(attribute.name);
      std::visit([this](const auto& value) { value_of(value); }, attribute.value);
    }
  }

  void variable(const NetcdfVariable& variable, GlobalIndex begin)
  {
    text(variable.name);
    count(static_cast<GlobalIndex>(variable.dimensions.size()));
    for (const std::string& name : variable.dimensions) count(find(name) - first_dimension());
    attributes(variable.attributes);
    type(variable.type);
    count(padded(bytes_of(variable), 4));
    count(begin);
  }

  using Place = std::vector<NetcdfDimension>::const_iterator;

  [[nodiscard]] Place first_dimension() const { return layout_.dimensions.begin(); }
  [[nodiscard]] Place find(const std::string& name) const
  {
    return std::ranges::find(layout_.dimensions, name, &NetcdfDimension::name);
  }
  [[nodiscard]] GlobalIndex length_of(const std::string& name) const { return find(name)->length; }

  const NetcdfLayout& layout_;
  std::string bytes_{};
};

void append_padded(const std::string& values, std::string& bytes)
{
  bytes += values;
  bytes.resize(static_cast<std::size_t>(padded(static_cast<GlobalIndex>(bytes.size()), kAlignment)),
               '\0');
}

}  // namespace

std::vector<RecordSection> netcdf_sections(const NetcdfLayout& layout)
{
  Header header(layout);
  // Its size does not depend on the places that it tells.
  std::vector<GlobalIndex> begins(layout.variables.size(), 0);
  auto end = padded(static_cast<GlobalIndex>(header.bytes(begins).size()), kAlignment);
  for (std::size_t v = 0; v < begins.size(); ++v) {
    const NetcdfVariable& variable = layout.variables[v];
    if (header.is_of_records(variable)) continue;
    begins[v] = end;
    end += padded(header.bytes_of(variable), kAlignment);
  }
  for (GlobalIndex& begin : begins) {
    if (begin == 0) begin = end;  // Records stand behind all else.
  }
  std::vector<RecordSection> sections;
  std::string head;
  append_padded(header.bytes(begins), head);
  for (const NetcdfVariable& variable : layout.variables) {
    if (!variable.values.empty()) {
      append_padded(variable.values, head);
    } else if (!header.is_of_records(variable)) {
      constexpr GlobalIndex kRecordSize = 8;
      sections.push_back({std::move(head), header.bytes_of(variable) / kRecordSize, kRecordSize});
      head.clear();
    }
  }
  return sections;
}

}  // namespace tessera::formats

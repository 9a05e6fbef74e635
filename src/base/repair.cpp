// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/repair.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera {
namespace {

constexpr const char* kVariable = "TESSERA_LEAVE_OUT";

RepairCounts& noted()
{
  static RepairCounts counts;
  return counts;
}

Repair repair_of(std::string_view name)
{
  if (const auto repair = value_of<Repair>(name)) return *repair;
  throw ConfigError(fmt::format("{}: there is no repair '{}'; there are {}", kVariable, name,
                                fmt::join(kWords<Repair>, ", ")));
}

}  // namespace

RepairCounts& RepairCounts::operator+=(const RepairCounts& other)
{
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  return *this;
}

void note_repair(Repair repair, GlobalIndex times) { noted().add(repair, times); }

void note_repairs(const RepairCounts& counts) { noted() += counts; }

RepairCounts take_noted_repairs() { return std::exchange(noted(), {}); }

std::vector<Repair> parse_repairs(std::string_view names)
{
  std::vector<Repair> repairs;
  for (bool is_more = !names.empty(); is_more;) {
    const std::size_t comma = std::min(names.find(','), names.size());
    repairs.push_back(repair_of(names.substr(0, comma)));
    is_more = comma < names.size();
    names.remove_prefix(is_more ? comma + 1 : comma);
  }
  std::ranges::sort(repairs);
  return repairs;
}

std::string names_of(const std::vector<Repair>& repairs)
{
  std::string names;
  for (const Repair repair : repairs) {
    names += names.empty() ? "" : ",";
    names += word_of(repair);
  }
  return names;
}

const std::vector<Repair>& left_out_repairs()
{
  static const std::vector<Repair> repairs = [] {
    const char* const names = std::getenv(kVariable);
    return parse_repairs(names == nullptr ? "" : names);
  }();
  return repairs;
}

bool is_left_out(Repair repair) { return std::ranges::binary_search(left_out_repairs(), repair); }

}  // namespace tessera

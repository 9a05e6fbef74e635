// SPDX-License-Identifier: BSD-3-Clause
#include "formats/files/record_file.hpp"

#include <utility>

namespace tessera::formats {

RecordFile::RecordFile(std::filesystem::path path, std::vector<RecordSection> sections,
                       std::string tail)
    : file_(std::move(path)), sections_(std::move(sections)), tail_(std::move(tail))
{
  GlobalIndex end = 0;
  for (const RecordSection& section : sections_) {
    first_byte_.push_back(end + static_cast<GlobalIndex>(section.head.size()));
    end = first_byte_.back() + section.num_records * section.record_size;
  }
  first_byte_.push_back(end);
}

void RecordFile::begin()
{
  file_.create();
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    const std::string& head = sections_[s].head;
    file_.write(first_byte_[s] - static_cast<GlobalIndex>(head.size()), head);
  }
  file_.write(first_byte_.back(), tail_);
}

void RecordFile::write(std::size_t section, GlobalIndex first_record, std::string_view records)
{
  file_.write(first_byte_[section] + first_record * sections_[section].record_size, records);
}

}  // namespace tessera::formats

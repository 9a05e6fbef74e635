// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::surface {

/// @brief A few numbers in one line of the cache; if they are more, they are elsewhere. Local.
class ShortList {
 public:
  [[nodiscard]] std::span<const LocalIndex> values() const noexcept
  {
    return {is_short() ? few_.data() : many_.data(), at(size_)};
  }
  [[nodiscard]] bool is_empty() const noexcept { return size_ == 0; }

  void add(LocalIndex value)
  {
    if (at(size_) == few_.size()) many_.assign(few_.begin(), few_.end());
    if (at(size_) >= few_.size()) {
      many_.push_back(value);
    } else {
      few_[at(size_)] = value;
    }
    ++size_;
  }

  /// @brief Those behind it move up. @pre It is there.
  void remove(LocalIndex value)
  {
    LocalIndex* const first = is_short() ? few_.data() : many_.data();
    LocalIndex* const last = first + size_;
    LocalIndex* const gone = std::find(first, last, value);
    std::copy(gone + 1, last, gone);
    const bool was_short = is_short();
    --size_;
    if (was_short) return;
    many_.pop_back();
    if (is_short()) std::ranges::copy(many_, few_.begin());
  }

 private:
  [[nodiscard]] bool is_short() const noexcept { return at(size_) <= few_.size(); }

  std::vector<LocalIndex> many_{};  // All, if they do not fit below.
  LocalIndex size_ = 0;
  std::array<LocalIndex, 9> few_{};
};

}  // namespace tessera::surface

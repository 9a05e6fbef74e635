// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <tuple>

#include "tessera/base/bytes.hpp"

namespace tessera {

/// @brief Where other processes of this machine find a segment of shared memory.
struct SegmentName {
  std::int32_t process = 0;      ///< Made it and has it open.
  std::int32_t descriptor = -1;  ///< There.
  std::uint64_t device = 0;
  std::uint64_t inode = 0;  ///< With the device: what must be found there.
  std::uint64_t size = 0;   ///< Bytes.

  static auto fields(auto& self)
  {
    return std::tie(self.process, self.descriptor, self.device, self.inode, self.size);
  }
};

/// @brief Bytes that nobody changes any more, as long as somebody holds them: on the heap of this
/// process, or in a segment of memory that processes of one machine share.
///
/// A segment has no name in any file system. So nothing is left of it when the last process ends
/// that holds it, however that ends. It is sealed: nobody can make it shorter or write to it.
class SharedBytes {
 public:
  SharedBytes() = default;

  /// @brief Takes bytes of this process.
  SharedBytes(Bytes bytes);  // NOLINT(google-explicit-constructor)

  /// @brief Makes a segment. All of its memory is there before anything is written.
  /// @param[in] size Bytes, at least one. @param[in] fill Writes them.
  /// @note Local. @throws Error if the system has no such memory or not enough.
  [[nodiscard]] static SharedBytes make_segment(
      std::size_t size, const std::function<void(std::span<std::byte>)>& fill);

  /// @brief Maps a segment that another process has made and still holds.
  /// @note Local. @throws Error if it cannot be found or is another.
  [[nodiscard]] static SharedBytes map_segment(const SegmentName& name);

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

  /// @brief Of the bytes.
  [[nodiscard]] const std::shared_ptr<const void>& keeper() const noexcept { return keeper_; }

  /// @brief By which other processes find the bytes as long as the process holds them that made the
  /// segment: the same in all that map it. Nothing if they are this process's own.
  [[nodiscard]] const std::optional<SegmentName>& segment() const noexcept { return segment_; }

 private:
  class Mapping;

  explicit SharedBytes(std::shared_ptr<const Mapping> mapping);

  std::span<const std::byte> bytes_{};
  std::shared_ptr<const void> keeper_{};
  std::optional<SegmentName> segment_{};
};

/// @brief from_bytes() whose flat arrays borrow their values from the bytes. Local.
/// @throws InputError as from_bytes().
template <class T>
[[nodiscard]] T from_shared_bytes(const SharedBytes& shared)
{
  ByteReader in(shared.bytes(), shared.keeper());
  T value = in.get<T>();
  in.require_end();
  return value;
}

/// @brief to_bytes() into a segment. Local. @throws Error as SharedBytes::make_segment().
template <class T>
[[nodiscard]] SharedBytes to_segment(const T& value)
{
  ByteCounter counter;
  ValueWriter(counter).put(value);
  return SharedBytes::make_segment(counter.size(), [&](std::span<std::byte> bytes) {
    ByteSpan sink(bytes);
    ValueWriter(sink).put(value);
  });
}

}  // namespace tessera

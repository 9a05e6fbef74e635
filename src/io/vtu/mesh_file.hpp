// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"

namespace tessera::io {

/// @brief The first `max_size` bytes of a file. @throws InputError naming it
[[nodiscard]] std::string load_file(const std::filesystem::path& path,
                                    std::size_t max_size = std::string::npos);

/// @brief Bytes of a file, read as they are asked for, or bytes in memory.
class StoredBytes {
 public:
  StoredBytes() = default;
  explicit StoredBytes(std::string_view bytes) : memory_(bytes), size_(bytes.size()) {}
  /// @throws InputError if the file cannot be read
  explicit StoredBytes(const std::filesystem::path& path);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// @brief Those from `begin` on, of the same file or memory. @pre begin <= size()
  [[nodiscard]] StoredBytes from(std::size_t begin) const;
  /// @brief What is in memory; empty of a file.
  [[nodiscard]] std::string_view in_memory() const { return memory_; }
  /// @brief Bytes from `begin` to `end`. @pre begin <= end <= size()
  /// @throws InputError if the file has become shorter
  [[nodiscard]] Bytes read(std::size_t begin, std::size_t end) const;

 private:
  std::string_view memory_{};
  std::shared_ptr<std::ifstream> file_{};
  std::size_t begin_ = 0;  // In the file, which is the one that was opened first.
  std::size_t size_ = 0;
};

/// @brief Runs `read`, and names the file in what goes wrong, also when memory does.
template <class Read>
[[nodiscard]] auto naming_the_file(const std::filesystem::path& path, Read read)
{
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  } catch (const std::bad_alloc&) {
    throw InputError(path.string() + ": not enough memory for what it claims to hold");
  } catch (const std::length_error&) {
    throw InputError(path.string() + ": not enough memory for what it claims to hold");
  }
}

}  // namespace tessera::io

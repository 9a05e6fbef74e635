// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::io {

/// @brief The first `max_size` bytes of a file. @throws InputError naming it
[[nodiscard]] std::string load_file(const std::filesystem::path& path,
                                    std::size_t max_size = std::string::npos);

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

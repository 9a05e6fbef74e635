// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

/// @brief What libFuzzer calls with every input, and run_corpus with every file of the corpus. An
/// input is read, or refused with the exception that stands for it; any other exception, a broken
/// promise or a sanitizer's finding ends the process.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace tessera::fuzz {

/// @brief The input as text.
[[nodiscard]] inline std::string text_of(const std::uint8_t* data, std::size_t size)
{
  return {reinterpret_cast<const char*>(data), size};
}

/// @brief Ends the process unless the promise is kept.
inline void promise(bool is_kept)
{
  if (!is_kept) std::abort();
}

}  // namespace tessera::fuzz

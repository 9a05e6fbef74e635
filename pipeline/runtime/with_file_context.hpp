// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

namespace tessera::pipeline {

/// @brief What `work` returns. A ConfigError of it is about a key that does not suit this model:
/// the model's file is put before its words. Local.
template <class Work>
decltype(auto) with_file_context(const config::Case& run_case, Work&& work)
{
  try {
    return std::forward<Work>(work)();
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}", run_case.geometry.file.string(), error.what()));
  }
}

}  // namespace tessera::pipeline

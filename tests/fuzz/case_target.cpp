// SPDX-License-Identifier: BSD-3-Clause
// A case file; what follows a first 0 is an override, as of `--set`.
#include <string_view>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "fuzz_target.hpp"

namespace tessera {
namespace {

void load_and_write(const std::string& text, const std::vector<std::string>& overrides)
{
  const config::Case loaded = config::parse_case(text, "folder/case.toml", overrides);
  std::string resolved;
  try {
    resolved = config::to_toml(loaded);
  } catch (const ConfigError&) {
    return;  // A path that is not valid UTF-8.
  }
  fuzz::promise(config::parse_case(resolved, "other/resolved.toml") == loaded);
}

}  // namespace
}  // namespace tessera

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  std::string text = tessera::fuzz::text_of(data, size);
  std::vector<std::string> overrides;
  if (const std::size_t end = text.find('\0'); end != std::string::npos) {
    overrides.push_back(text.substr(end + 1));
    text.resize(end);
  }
  try {
    tessera::load_and_write(text, overrides);
  } catch (const tessera::ConfigError& error) {
    tessera::fuzz::promise(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/viewer/three_js.hpp"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>
#include <vector>

#include "pipeline/drawing/deflate.hpp"
#include "pipeline/report/html.hpp"
#include "pipeline/runtime/installed.hpp"

namespace tessera::pipeline {

std::filesystem::path three_js_file()
{
  const char* const named = std::getenv("TESSERA_THREE_JS");
  if (named != nullptr && *named != '\0') return named;
  std::filesystem::path packed = install_prefix() / "share/tessera/three.min.js";
  std::error_code failed;
  if (std::filesystem::exists(packed, failed)) return packed;
  return "/usr/share/javascript/three/three.min.js";
}

std::optional<std::string> packed_three_js()
{
  std::ifstream in(three_js_file(), std::ios::binary);
  const std::vector<std::uint8_t> code{std::istreambuf_iterator<char>(in), {}};
  if (!in || code.empty()) return std::nullopt;
  const std::vector<std::uint8_t> packed = deflated(code);
  return base64(std::as_bytes(std::span(packed)));
}

}  // namespace tessera::pipeline

// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <iostream>
#include <span>
#include <string>

#include "tessera/base/error.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/config/case.hpp"

int main()
{
  const auto loaded = tessera::config::parse_case(
      "geometry.file = 'cube.geo'\ncoarse.max_size = 0.5", "/case.toml");
  const std::string text = tessera::config::to_toml(loaded);
  std::cout << text << tessera::to_hex(tessera::hash_bytes(std::as_bytes(std::span(text)))) << '\n';
  try {
    (void)tessera::config::parse_case("colour = 'red'", "case.toml");
  } catch (const tessera::ConfigError& error) {  // The type is known across the library's border.
    return loaded.coarse.max_size == 0.5 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  return EXIT_FAILURE;
}

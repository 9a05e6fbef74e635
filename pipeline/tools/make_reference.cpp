// SPDX-License-Identifier: BSD-3-Clause
// Writes configs/reference.toml from the key table, or with --check compares it.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "tessera/config/case.hpp"

namespace {

int check(const std::string& file, const std::string& wanted)
{
  std::ifstream stream(file, std::ios::binary);
  const std::string found{std::istreambuf_iterator<char>(stream), {}};
  if (found == wanted) return EXIT_SUCCESS;
  std::cerr << file << " is not up to date; build the target update_reference\n";
  return EXIT_FAILURE;
}

int write(const std::string& file, const std::string& text)
{
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (stream) return EXIT_SUCCESS;
  std::cerr << file << ": cannot be written\n";
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool is_check = arguments.size() == 2 && arguments.front() == "--check";
  if (arguments.size() != 1 && !is_check) {
    std::cerr << "usage: make_reference [--check] FILE\n";
    return EXIT_FAILURE;
  }
  const std::string text = tessera::config::reference_toml();
  return is_check ? check(arguments.back(), text) : write(arguments.back(), text);
}

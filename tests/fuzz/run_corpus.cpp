// SPDX-License-Identifier: BSD-3-Clause
// Feeds every file of a folder to a fuzz target, without any fuzzer: run_corpus FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz_target.hpp"

int main(int argc, char** argv)
{
  if (argc != 2) return 2;
  int num_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    std::fprintf(stderr, "%s\n", entry.path().c_str());  // So that a crash names its file.
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    static_cast<void>(
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    ++num_files;
  }
  return num_files > 0 ? 0 : 1;
}

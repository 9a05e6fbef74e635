// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into a program (LD_PRELOAD), it runs main() once for each line on standard input, in a
// child of its own: what is spared is the loading of a hundred libraries, most of a short run's
// time. A line is a folder and the arguments, separated by tabs; the child writes its standard
// output and error to the files out and err in the folder. Answered are two lines, the child's
// process (also its group) and its wait status.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using Main = int (*)(int, char**, char**);
Main program = nullptr;

[[noreturn]] void run_child(std::vector<std::string> words)
{
  ::setsid();
  const std::string folder = words.front();
  words.front() = "tessera";
  const bool is_ready = std::freopen("/dev/null", "r", stdin) != nullptr
                        && std::freopen((folder + "/out").c_str(), "w", stdout) != nullptr
                        && std::freopen((folder + "/err").c_str(), "w", stderr) != nullptr;
  if (!is_ready) ::_exit(126);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::exit(program(static_cast<int>(words.size()), arguments.data(), environ));
}

int serve(int /*argc*/, char** /*argv*/, char** /*environment*/)
{
  for (std::string line; std::getline(std::cin, line);) {
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; std::getline(in, word, '\t');) words.push_back(word);
    const pid_t child = ::fork();
    if (child == 0) run_child(words);
    std::cout << child << std::endl;
    int status = 0;
    ::waitpid(child, &status, 0);
    std::cout << status << std::endl;
  }
  return 0;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-reserved-identifier): glibc calls it before main().
extern "C" int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void* stack_end)
{
  program = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(serve, argc, argv, init, fini, rtld_fini, stack_end);
}

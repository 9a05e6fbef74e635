// SPDX-License-Identifier: BSD-3-Clause
#include "support/failing_worker.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>
#include <sstream>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include "tessera/base/error.hpp"
#include "tessera/base/threads.hpp"

namespace tessera::testing {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

[[noreturn]] void throw_kind(const std::string& kind)
{
  if (kind == "config") throw ConfigError("no config");
  if (kind == "input") throw InputError("no input");
  if (kind == "geometry") throw GeometryError("no geometry");
  if (kind == "mesh") throw MeshError("no mesh");
  if (kind == "netgen") throw NetgenError("no netgen");
  if (kind == "output") throw OutputError("no output");
  if (kind == "alloc") throw std::bad_alloc();
  if (kind == "int") throw 42;
  throw std::logic_error("no logic");
}

// UBSan would report the null pointer before it is used.
__attribute__((no_sanitize("undefined"))) void write_nowhere()
{
  volatile int* volatile nowhere = nullptr;
  *nowhere = 1;
}

// Without the handlers of sanitizers and without a core file.
void die_by(int signal)
{
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::signal(signal, SIG_DFL);
  if (signal == SIGABRT) std::abort();
  write_nowhere();
}

[[noreturn]] void never_end(const std::string& how)
{
  std::vector<Bytes> all;
  volatile unsigned count = 0;
  while (true) {
    if (how == "sleep") std::this_thread::sleep_for(std::chrono::seconds(1));
    if (how == "loop") count = count + 1;
    if (how == "allocate") {
      all.emplace_back(8 * kMiB, std::byte{1});
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
}

// Of /proc/PID/stat: number, name, state, parent.
pid_t parent_of(pid_t pid)
{
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number;
  std::string name;
  std::string state;
  pid_t parent = 0;
  stat >> number >> name >> state >> parent;
  return parent;
}

std::string pids()
{
  const pid_t model = ::getppid();
  std::ostringstream text;
  text << parent_of(model) << " " << model << " " << ::getpid();
  return text.str();
}

std::string num_open_descriptors()
{
  std::vector<int> open;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    open.push_back(std::stoi(entry.path().filename().string()));
  // One of them belonged to the iterator.
  return std::to_string(std::count_if(open.begin(), open.end(), [](int fd) { return fd > 2; }) - 1);
}

}  // namespace

Bytes bytes_of(const std::string& text)
{
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::string text_of(std::span<const std::byte> bytes)
{
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Bytes FailingWorker::obey(const std::string& text)
{
  std::istringstream words(text);
  std::string command;
  std::string argument;
  words >> command >> argument;
  if (command == "throw") throw_kind(argument);
  if (command == "segfault") die_by(SIGSEGV);
  if (command == "abort") die_by(SIGABRT);
  if (command == "exit") std::exit(std::stoi(argument));
  if (command == "loop" || command == "sleep" || command == "allocate") never_end(command);
  if (command == "write") {
    std::printf("stdout %s", argument.c_str());  // no newline: what is buffered must not be lost
    std::cerr << "stderr " << argument << '\n';
  }
  if (command == "append") state_ += argument;
  if (command == "get") return bytes_of(state_);
  if (command == "late") {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return Bytes(std::stoul(argument) * kMiB / 1024);
  }
  if (command == "zeros") return Bytes(std::stoul(argument) * kMiB);
  if (command == "keep") kept_ = Bytes(std::stoul(argument) * kMiB, std::byte{1});
  if (command == "touch") std::fill(kept_.begin(), kept_.end(), std::byte{2});
  if (command == "pids") return bytes_of(pids());
  if (command == "threads") return bytes_of(std::to_string(num_threads()));
  if (command == "descriptors") return bytes_of(num_open_descriptors());
  return {};
}

}  // namespace tessera::testing

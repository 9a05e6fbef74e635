// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/terminal.hpp"

#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tessera::pipeline {
namespace {

std::string output_of(pid_t process) { return "/proc/" + std::to_string(process) + "/fd/1"; }

// In /proc/N/stat the state and the parent follow the name, which may hold blanks and brackets.
std::optional<pid_t> parent_of(pid_t process)
{
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  if (!std::getline(file, text)) return std::nullopt;
  const std::size_t name_end = text.rfind(") ");
  if (name_end == std::string::npos || name_end + 4 >= text.size()) return std::nullopt;
  const pid_t parent = std::atoi(text.c_str() + name_end + 4);
  return parent > 0 ? std::optional(parent) : std::nullopt;
}

// Looked at before it is opened: a pipe that somebody opens once more may stay open too long.
bool is_terminal(const std::string& path)
{
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISCHR(status.st_mode)) return false;
  const int file = open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  const bool is_one = isatty(file) != 0;
  close(file);
  return is_one;
}

bool is_same_file(const std::string& a, const std::string& b)
{
  struct stat of_a {};
  struct stat of_b {};
  if (stat(a.c_str(), &of_a) != 0 || stat(b.c_str(), &of_b) != 0) return false;
  return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

// mpirun, or its helper on this host: the nearest process above that writes elsewhere. Between may
// be a shell.
std::optional<pid_t> launcher()
{
  const std::string ours = output_of(getpid());
  std::optional<pid_t> process = parent_of(getpid());
  while (process && is_same_file(output_of(*process), ours)) process = parent_of(*process);
  return process;
}

}  // namespace

bool output_ends_on_terminal()
{
  if (isatty(STDOUT_FILENO) == 0) return false;
  if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr) return true;
  const auto above = launcher();
  return above && is_terminal(output_of(*above));
}

}  // namespace tessera::pipeline

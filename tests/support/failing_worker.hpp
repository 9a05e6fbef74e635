// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "tessera/jobs/job_runner.hpp"

namespace tessera::testing {

[[nodiscard]] Bytes bytes_of(const std::string& text);
[[nodiscard]] std::string text_of(std::span<const std::byte> bytes);

/// @brief Does what it is told, really: loads and jobs are commands of one or two words.
///
/// | command | effect |
/// |---|---|
/// | `throw KIND` | throws: `config` `input` `geometry` `mesh` `netgen` `output` `other` `int`
/// `alloc` | | `segfault`, `abort`, `exit CODE` | ends the process | | `loop`, `sleep`, `allocate`
/// | never ends: uses CPU, none, ever more memory | | `write TEXT` | to standard output and error |
/// | `append TEXT` | to the state |
/// | `get` | returns the state |
/// | `zeros MIB` | returns that many MiB |
/// | `late KIB` | returns that many KiB after 0.3 seconds |
/// | `keep MIB`, `touch` | keeps that many MiB as state; writes to all of them |
/// | `pids` | returns the numbers of zygote, model zygote and this process |
/// | `descriptors` | returns the number of open file descriptors above 2 |
class FailingWorker final : public jobs::Worker {
 public:
  void load(std::span<const std::byte> message) override { (void)obey(text_of(message)); }
  [[nodiscard]] Bytes run(std::span<const std::byte> request) override
  {
    return obey(text_of(request));
  }

 private:
  Bytes obey(const std::string& text);

  std::string state_{};
  Bytes kept_{};
};

}  // namespace tessera::testing

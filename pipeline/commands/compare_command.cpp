// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/compare_command.hpp"

#include <cstdio>
#include <string>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/files.hpp"

#include "pipeline/report/report_page.hpp"

namespace tessera::pipeline {

ExitCode run_compare_command(const CompareCommand& command, const comm::Communicator& comm)
{
  const std::string text = on_root(comm, [&] {
    const ReportSource a = read_report_source(command.folder_a);
    const ReportSource b = read_report_source(command.folder_b);
    io::write_text_atomically(command.output, compare_page(a, b));
    return compare_text(a, b) + "\npage: " + command.output.string() + "\n";
  });
  if (comm.rank() == 0) std::fputs(text.c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace tessera::pipeline

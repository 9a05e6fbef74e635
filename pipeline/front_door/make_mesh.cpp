// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/tessera.hpp"

#include "pipeline/front_door/session.hpp"
#include "pipeline/run_case.hpp"

namespace tessera {
namespace {

// Job processes, folder lock and stop signals are there once: a call within a callback of another
// one, or from a second thread, would take the model away from it.
class OnlyCall {
 public:
  OnlyCall()
  {
    if (!is_running.exchange(true)) return;
    throw UsageError("make_mesh() is running in this process already; on_piece must not call it");
  }
  ~OnlyCall() { is_running = false; }
  OnlyCall(const OnlyCall&) = delete;
  OnlyCall& operator=(const OnlyCall&) = delete;

 private:
  inline static std::atomic<bool> is_running = false;
};

// On all ranks if on one: without its job processes a rank could not do its share of the work.
void require_session(const comm::Communicator& comm)
{
  std::optional<std::string> defect;
  if (pipeline::session_jobs() == nullptr) {
    defect =
        "make_mesh() needs a tessera::Session, constructed in main() before MPI_Init. A program "
        "that cannot have one runs `tessera mesh`, and then reads the folder with read_mesh()";
  }
  comm.throw_if_any<UsageError>(defect);
}

void require_same_way(bool has_callback, const comm::Communicator& comm)
{
  const GlobalIndex num_with = comm.sum(has_callback ? 1 : 0);
  if (num_with == 0 || num_with == comm.size()) return;
  throw comm::Collective<UsageError>("MeshOptions::on_piece is set on some ranks only");
}

// Checked as a case file is. The job processes keep the working directory of the time when they
// were forked, so paths are absolute.
config::Case checked(config::Case given, const std::string& case_name)
{
  if (!given.geometry.file.empty()) given.geometry.file = absolute(given.geometry.file);
  if (!given.geometry.cad.empty()) given.geometry.cad = absolute(given.geometry.cad);
  config::require_in_range(given, case_name);
  config::Case result = config::parse_case(config::to_toml(given), case_name);
  result.output.directory = absolute(result.output.directory);
  return result;
}

// What rank 0 was told, so that no rank can see anything else.
struct Told {
  std::string case_name{};
  std::string case_text{};
  io::ExistingFolder existing = io::ExistingFolder::refuse;
  std::vector<LocalIndex> only_subdomains{};

  static auto fields(auto& self)
  {
    return std::tie(self.case_name, self.case_text, self.existing, self.only_subdomains);
  }
};

Told told_by_root(const config::Case& given, const MeshOptions& options,
                  const comm::Communicator& comm)
{
  return comm::on_root(comm, [&] {
    return Told{options.case_name, config::to_toml(checked(given, options.case_name)),
                options.existing, options.only_subdomains};
  });
}

}  // namespace

MeshResult make_mesh(const config::Case& given, const comm::Communicator& comm,
                     const MeshOptions& options)
{
  const OnlyCall only;
  comm::roll_call(comm.handle(), "make_mesh()", options.rank_timeout_s);
  require_session(comm);
  require_same_way(static_cast<bool>(options.on_piece), comm);
  Told told = told_by_root(given, options, comm);
  const config::Case checked_case = config::parse_case(told.case_text, told.case_name);
  MeshOptions same = options;
  same.case_name = std::move(told.case_name);
  same.existing = told.existing;
  same.only_subdomains = std::move(told.only_subdomains);
  return pipeline::run_case(checked_case, same, comm, *pipeline::session_jobs());
}

}  // namespace tessera

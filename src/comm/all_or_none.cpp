// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/comm/all_or_none.hpp"

#include <exception>

#include "comm/run_on_root.hpp"

namespace tessera::comm {

void all_or_none(const Communicator& comm, const std::function<void()>& work)
{
  try {
    work();
  } catch (const ThrownOnAllRanks&) {
    throw;
  } catch (const std::exception& error) {
    comm.throw_first(&error);  // Does not return, since this rank has an error.
  }
  comm.throw_first(nullptr);
}

Bytes run_on_root(const Communicator& comm, const std::function<Bytes()>& work)
{
  Bytes bytes;
  std::exception_ptr error;
  if (comm.rank() == 0) {
    try {
      bytes = work();
    } catch (...) {
      error = std::current_exception();
    }
  }
  comm.quiet_barrier();
  all_or_none(comm, [&] {
    if (error) std::rethrow_exception(error);
  });
  return bytes;
}

Bytes bytes_on_root(const Communicator& comm, const std::function<Bytes()>& work)
{
  return comm.broadcast(run_on_root(comm, work), 0);
}

}  // namespace tessera::comm

// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/traffic.hpp"

#include <utility>

namespace tessera::migrate {

std::vector<comm::Message> exchange(const comm::Communicator& comm,
                                    std::vector<comm::Message> messages, Traffic& traffic)
{
  for (const comm::Message& message : messages) {
    if (message.rank == comm.rank()) continue;
    ++traffic.num_messages;
    traffic.num_bytes += static_cast<GlobalIndex>(message.bytes.size());
  }
  return comm.exchange(std::move(messages));
}

}  // namespace tessera::migrate

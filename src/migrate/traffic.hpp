// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/migrate.hpp"

namespace tessera::migrate {

/// @brief comm.exchange(), and counts what goes to other ranks. @note Collective.
[[nodiscard]] std::vector<comm::Message> exchange(const comm::Communicator& comm,
                                                  std::vector<comm::Message> messages,
                                                  Traffic& traffic);

}  // namespace tessera::migrate

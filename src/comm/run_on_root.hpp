// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "tessera/base/bytes.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::comm {

/// @brief Runs `work` on rank 0 while others wait asleep. Its bytes on rank 0, none elsewhere; its
/// error on all ranks. @note Collective.
[[nodiscard]] Bytes run_on_root(const Communicator& comm, const std::function<Bytes()>& work);

}  // namespace tessera::comm

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace tessera::jobs {

/// @brief From now on this process is that job: report_progress() writes to this socket.
void begin_progress_reports(int socket, std::uint32_t call);

}  // namespace tessera::jobs

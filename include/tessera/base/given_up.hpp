// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string_view>

namespace tessera {

/// @brief Says on standard error, which is the log of a job, what was given up and why, where an
/// error is none because there is another way. Local.
void note_given_up(std::string_view what, const std::exception& why);

}  // namespace tessera

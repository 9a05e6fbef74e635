// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string_view>

namespace tessera {

/// @brief Says what was given up and why, on standard error: that is the log of a job. For errors
/// that are none, because there is another way. Local.
void note_given_up(std::string_view what, const std::exception& why);

}  // namespace tessera

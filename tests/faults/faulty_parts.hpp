// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera::testing {

/// @brief Puts parts into the program that fail where that is asked for: see fault.hpp. To be
/// called before there is a Session. Local.
void replace_parts();

}  // namespace tessera::testing

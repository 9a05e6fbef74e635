// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace tessera {

/// @brief The noise of corners that a file holds in single precision, in parts of the whole box's
/// diagonal. What is nearer was meant to be one, what is thinner to have no thickness.
inline constexpr double kSinglePrecisionNoise = 1e-6;

}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "decompose/labelling.hpp"

namespace tessera::decompose {

/// @brief Gives light labels, left by splits, whole to a neighbour where its skin stays one closed
/// manifold surface, while there are more labels than wanted. Returns the number of merges.
/// @pre All labels keep the promises of decompose(); they still do afterwards.
LocalIndex merge_small(const TetGraph& graph, Labelling& labelling, LocalIndex num_wanted);

}  // namespace tessera::decompose

// SPDX-License-Identifier: BSD-3-Clause
// CMake includes the precompiled header here, for that needs a source.

// SPDX-License-Identifier: BSD-3-Clause
// What most tests include, compiled once: measured on six of them, that is two fifths of their
// time. No headers of Tessera: each of these would make all tests anew. A test includes what it
// uses, as ever.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

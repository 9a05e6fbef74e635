// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/fill_subdomain.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

#include "support/bodies.hpp"

namespace tessera::testing {

/// @brief Fills one subdomain of a body on a flat model; by default with NETGEN.
[[nodiscard]] subdomain::FilledPiece fill_of(const Body& body, int levels, LocalIndex subdomain,
                                             const fill::FillTry& how = {});

/// @brief two_material_cube(2) in four slabs, refined twice, filled with NETGEN and numbered, as
/// the stages of the program do it. The pieces are made once for all tests.
struct FilledCube : ::testing::Test {
  static constexpr int kLevels = 2;  ///< Triangles have inner points from 2 on.

  static void SetUpTestSuite();
  static void TearDownTestSuite();

  static const Body& body() { return shared_->body; }
  static const std::vector<subdomain::FilledPiece>& pieces() { return shared_->pieces; }
  static const number::IdLayout& ids() { return shared_->ids; }
  static subdomain::WriteContext context()
  {
    return {shared_->body.coarse, shared_->body.skeleton, shared_->ids, shared_->length_unit};
  }

 private:
  struct Shared {
    Body body;
    std::vector<subdomain::FilledPiece> pieces;
    number::IdLayout ids;
    std::string length_unit;
  };

  static inline Shared* shared_ = nullptr;
};

}  // namespace tessera::testing

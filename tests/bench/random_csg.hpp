// SPDX-License-Identifier: BSD-3-Clause
// Random trees of boolean operations on simple bodies, for the bench random_models: as shapes of
// OpenCASCADE and as solids of NETGEN's .geo.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>

/// @brief A model that is not worth keeping: the next one is drawn.
struct Rejected : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @brief Random numbers that are the same on every machine: the standard fixes the generator, but
/// not its distributions.
class Dice {
 public:
  /// @brief Local.
  explicit Dice(std::uint64_t seed) : generator(seed) {}

  /// @brief Local. Uniform in [low, high).
  double between(double low, double high)
  {
    return low + (high - low) * 0x1p-53 * static_cast<double>(generator() >> 11);
  }

  /// @brief Local. 0 to `count` - 1.
  int below(int count) { return static_cast<int>(between(0.0, count)); }

  /// @brief Local. True with the probability `share`.
  bool chance(double share) { return between(0.0, 1.0) < share; }

 private:
  std::mt19937_64 generator;
};

/// @brief A simple body. `frame` is at its centre, or at the middle of its base (cylinder, cone).
struct Body {
  enum class Kind { box, cylinder, ball, cone, torus };

  Kind kind = Kind::box;
  gp_Ax2 frame;
  double a = 1.0;  ///< Half the first side; radius; radius of the base; larger radius of the torus.
  double b = 1.0;  ///< Half the second side; height; smaller radius of the torus.
  double c = 1.0;  ///< Half the third side; radius of the cone's top, 0: it has an apex.
};

/// @brief A body, or an operation on two trees.
struct CsgTree {
  enum class Operation { none, unite, cut, intersect };

  Operation operation = Operation::none;
  Body body;  ///< If the operation is `none`.
  std::unique_ptr<CsgTree> left;
  std::unique_ptr<CsgTree> right;
};

/// @brief Local. A body near the origin, of size about 1; a part of all have round numbers and axes
/// along the coordinates, so that faces and edges coincide.
Body random_body(Dice& dice);

/// @brief Local. A tree with up to 2^depth bodies.
std::unique_ptr<CsgTree> random_tree(Dice& dice, int depth);

/// @brief Local. The body as a solid.
TopoDS_Shape shape_of(const Body& body);

/// @brief Local. The tree as a shape.
/// @throws Rejected if an operation fails, or if a volume is not that of the parts of a unite, cut
/// or intersection, up to 1e-5 of it.
TopoDS_Shape shape_of(const CsgTree& tree);

/// @brief Local. The tree in NETGEN's language, one top level object.
std::string geo_of(const CsgTree& tree);

/// @brief Local. The volume of a shape.
/// @throws Rejected if two ways to integrate differ by more than 1e-4 of it, or it is not positive.
double clean_volume(const TopoDS_Shape& shape);

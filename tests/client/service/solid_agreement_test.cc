// Goal:   the client refuses solids exactly where the service does; for those that both accept they
//         have the same radius and the same solids.
// Method: random solids with fields spoilt at random, encoded here field by field; both judgements.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "client/library/validation.h"
#include "collision/shape.h"
#include "idl/limits.h"
#include "idl/shape_bytes.h"
#include "server/shapes/shape_builder.h"
#include "server/shapes/shape_decoding.h"
#include "tests/support/random.h"

namespace collision::client {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double Spoilt(Random* random) {
  const double values[] = {0,     -0.0,      -1,         1e-7,   1e-6,  1e7,    1.0000001e7,
                           1e300, kInfinity, -kInfinity, 1e-200, 1e200, 5e-324, std::nan("")};
  return values[random->Below(std::size(values))];
}

Solid RandomSolid(Random* random) {
  const auto number = [&] { return random->Uniform(0, 2); };
  switch (random->Below(5)) {
    case 0:
      return Solid::Ball(number());
    case 1:
      return Solid::Capsule(number(), number());
    case 2:
      return Solid::Box({number(), number(), number()});
    case 3:
      return Solid::Ellipsoid({number(), number(), number()});
    default:
      return Solid::Hull({{number(), 0, 1}, {0, number(), 2}, {number(), 1, 0}, {0, 0, number()}});
  }
}

/// Any one of its numbers.
double* ANumberOf(Solid* solid, Random* random) {
  switch (random->Below(5)) {
    case 0:
      return &solid->half_extents_m[random->Below(3)];
    case 1:
      return &solid->position_m[random->Below(3)];
    case 2:
      return &solid->orientation[random->Below(4)];
    case 3:
      if (!solid->points_m.empty()) return &solid->points_m[random->Below(4)][random->Below(3)];
      [[fallthrough]];
    default:
      return &solid->rounding_m;
  }
}

SolidContent ContentOf(const Solid& solid) {
  return {static_cast<SolidKind>(static_cast<int>(solid.kind) + 1),
          solid.position_m,
          solid.orientation,
          solid.half_extents_m,
          solid.rounding_m,
          solid.points_m};
}

TEST(SolidAgreement, ClientAndServiceRefuseTheSame) {
  EXPECT_EQ(kShapeHullPointsMax, wire::kShapeHullPointsMax);
  Random random(11);
  int refused = 0, taken = 0;
  for (int run = 0; run < 4000; ++run) {
    Solid solid = RandomSolid(&random);
    for (std::uint64_t i = random.Below(3); i > 0; --i)
      *ANumberOf(&solid, &random) = Spoilt(&random);
    std::string error, refusal;
    std::shared_ptr<const Shape> shape;
    try {
      shape = Shape::Make({.solids = {Solid::Ball(1), solid}});
    } catch (const std::invalid_argument& thrown) {
      error = thrown.what();
    }
    const std::string bytes = EncodeShape({{}, {}, {ContentOf(Solid::Ball(1)), ContentOf(solid)}});
    const auto decoded = server::DecodeAndCheck(bytes, 1000, &refusal);
    ASSERT_EQ(shape == nullptr, !decoded) << "client: " << error << "\nservice: " << refusal;
    (shape ? taken : refused) += 1;
    if (!shape) {
      EXPECT_EQ(error.rfind("solids[1] (", 0), 0u) << error;
      continue;
    }
    const auto built = server::BuildShape(shape->hash(), shape->bytes(), {.triangles_max = 1000});
    ASSERT_TRUE(built.shape) << built.refusal;
    EXPECT_EQ(shape->radius_m(), built.shape->facts().radius);
    EXPECT_EQ(built.shape->solids().size(), 2u);
  }
  EXPECT_GE(refused, 800);
  EXPECT_GE(taken, 800);
}

}  // namespace
}  // namespace collision::client

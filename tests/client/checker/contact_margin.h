// What the margin of a contact promises.
#pragma once

#include <gtest/gtest.h>

#include "client/checker/shape/bodies.h"
#include "tests/support/random.h"

namespace collision::checker {

/// Whether the two touch in this pose; then so they do wherever one is moved by less than the
/// margin, which is expected.
inline bool TouchWithinTheirMargin(const Body& a, const Body& b, const Pose& pose, Random* random) {
  Hint hint;
  const Standing standing = StandingOf(a, b, pose, &hint);
  for (int i = 0; standing.contact && i < 30; ++i) {
    const auto u = random->UnitVector();
    Pose moved = pose;
    moved.p_AB = pose.p_AB + 0.9999 * standing.margin * Vector{u.x(), u.y(), u.z()};
    EXPECT_TRUE(InContact(a, b, moved, &hint));
  }
  return standing.contact;
}

}  // namespace collision::checker

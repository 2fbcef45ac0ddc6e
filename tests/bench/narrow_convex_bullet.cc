// Bullet's convex shapes, by its GJK and EPA, without margins.
#include "tests/bench/narrow_bullet_shapes.h"
#include "tests/bench/narrow_convex.h"

namespace collision::bench {

NarrowQueries BulletConvexQueries(const PlainConvex& plain_a, const PlainConvex& plain_b) {
  const auto a = BulletGeometry(plain_a, 0), b = BulletGeometry(plain_b, 0);
  const auto decide = [a, b](const PlainPose& at) {
    return Plain(BulletDistance(*a, *b, at) <= 0);
  };
  const auto measure = [a, b](const PlainPose& at) { return Plain(BulletDistance(*a, *b, at)); };
  return {{"Bullet GJK", Task::kDecision, Who::kLibrary, decide},
          {"Bullet GJK", Task::kDistance, Who::kLibrary, measure}};
}

}  // namespace collision::bench

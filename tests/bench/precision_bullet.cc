// Bullet over its margins: GImpact's triangles, and convex shapes by GJK.
#include "tests/bench/narrow_bullet_shapes.h"
#include "tests/bench/precision_convex.h"

namespace collision::bench {
namespace {

/// The last one is what Bullet gives its shapes by default [m].
constexpr double kMargins[] = {0, 1e-6, 1e-4, 1e-3, 1e-2, 0.04};

}  // namespace

PrecisionMethods BulletMeshMethods(const PlainMesh& mesh) {
  PrecisionMethods methods;
  for (const double margin : kMargins) {
    PrecisionMethod method;
    method.name = "Bullet GImpact";
    method.setting = SettingText("margin", margin, "m");
    method.decides = true;
    method.limited_by = "single precision and quantised boxes; then the margin";
    method.ask = GImpactDecision(mesh, margin);
    methods.push_back(std::move(method));
  }
  return methods;
}

PrecisionMethods BulletConvexMethods(const PlainConvex& plain_a, const PlainConvex& plain_b) {
  PrecisionMethods methods;
  for (const double margin : kMargins) {
    const auto a = BulletGeometry(plain_a, margin), b = BulletGeometry(plain_b, margin);
    PrecisionMethod method;
    method.name = "Bullet GJK";
    method.setting = SettingText("margin", margin, "m");
    method.limited_by = "single precision; then the margin";
    method.ask = [a, b](const PlainPose& at) { return Plain(BulletDistance(*a, *b, at)); };
    methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace collision::bench

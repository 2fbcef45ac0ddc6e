// Points and vectors of three coordinates, one per lane. After a lanes header (lanes_plain.h).
#pragma once

namespace collision::simd::COLLISION_SIMD {

struct Points {
  Lanes x, y, z;
};

WIDE inline Points LoadPoints(const float* x, const float* y, const float* z) {
  return {Load(x), Load(y), Load(z)};
}
/// One point in all lanes.
WIDE inline Points AllOf(const float* p) { return {All(p[0]), All(p[1]), All(p[2])}; }

WIDE inline Points operator+(const Points& a, const Points& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
WIDE inline Points operator-(const Points& a, const Points& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
WIDE inline Lanes Dot(const Points& a, const Points& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
WIDE inline Points Cross(const Points& a, const Points& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace collision::simd::COLLISION_SIMD

// Points in wide vectors. Only for sphere_pair_kernel_wide.h: see sphere_pair_kernel_wide.h.
#pragma once

#include "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h"

namespace collision::narrow_phase {
namespace {

struct WidePoint {
  Lanes x, y, z;
};

WIDE inline WidePoint Minus(const WidePoint& a, const WidePoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

WIDE inline Lanes Dot(const WidePoint& a, const WidePoint& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

WIDE inline WidePoint Cross(const WidePoint& a, const WidePoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

WIDE inline WidePoint AllOf(const float* p) { return {All(p[0]), All(p[1]), All(p[2])}; }

WIDE inline WidePoint Turned(const KernelPose& pose, const WidePoint& p) {
  const float* const m = pose.matrix;
  return {(All(m[0]) * p.x + All(m[1]) * p.y) + All(m[2]) * p.z,
          (All(m[3]) * p.x + All(m[4]) * p.y) + All(m[5]) * p.z,
          (All(m[6]) * p.x + All(m[7]) * p.y) + All(m[8]) * p.z};
}

WIDE inline WidePoint Posed(const KernelPose& pose, const WidePoint& p) {
  const WidePoint turned = Turned(pose, p);
  return {turned.x + All(pose.offset[0]), turned.y + All(pose.offset[1]),
          turned.z + All(pose.offset[2])};
}

}  // namespace
}  // namespace collision::narrow_phase

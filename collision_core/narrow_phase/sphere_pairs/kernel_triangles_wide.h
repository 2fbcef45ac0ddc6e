// Pairs of triangles in wide vectors: gaps along a direction, along normals and across edges. For
// sphere_pair_kernel_wide.h.
#pragma once

#include "collision_core/narrow_phase/sphere_pairs/kernel_edges_wide.h"

namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD {

struct WideTriangles {
  Points corner[3], normal;
  Lanes above, below;
};

/// Corners and normals of a block, turned as B is.
struct TurnedBlock {
  alignas(64) float x[16], y[16], z[16];
  alignas(64) float along[16];  ///< On a direction.
};

WIDE inline void Turn(const KernelPose& pose, const sphere_tree::TriangleBlock& block,
                      TurnedBlock* turned) {
  const Points direction = AllOf(pose.direction);
  for (std::uint32_t k = 0; k < 16; k += kWidth) {
    const Points p = Turned(pose, LoadPoints(block.x + k, block.y + k, block.z + k));
    Store(turned->x + k, p.x), Store(turned->y + k, p.y), Store(turned->z + k, p.z);
    Store(turned->along + k, Dot(direction, p));
  }
}

WIDE inline WideTriangles TrianglesOfB(const KernelPose& pose,
                                       const sphere_tree::TriangleBlock& block,
                                       const TurnedBlock& turned) {
  WideTriangles t;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    t.corner[k] = {LoadFour(turned.x + 4 * k) + All(pose.offset[0]),
                   LoadFour(turned.y + 4 * k) + All(pose.offset[1]),
                   LoadFour(turned.z + 4 * k) + All(pose.offset[2])};
  }
  t.normal = {LoadFour(turned.x + 12), LoadFour(turned.y + 12), LoadFour(turned.z + 12)};
  const Lanes shift = Dot(t.normal, AllOf(pose.offset));
  t.above = LoadFour(block.above) + shift;
  t.below = LoadFour(block.below) + shift;
  return t;
}

WIDE inline WideTriangles TrianglesOfA(const sphere_tree::TriangleBlock& block, std::uint32_t row) {
  WideTriangles t;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    t.corner[k] = {SpreadFours(block.x + 4 * k, row), SpreadFours(block.y + 4 * k, row),
                   SpreadFours(block.z + 4 * k, row)};
  }
  t.normal = {SpreadFours(block.x + 12, row), SpreadFours(block.y + 12, row),
              SpreadFours(block.z + 12, row)};
  t.above = SpreadFours(block.above, row);
  t.below = SpreadFours(block.below, row);
  return t;
}

struct WideRange {
  Lanes low, high;
};

WIDE inline WideRange RangeAlong(const Points& n, const Points* corners) {
  const Lanes p = Dot(n, corners[0]), q = Dot(n, corners[1]), r = Dot(n, corners[2]);
  return {Lesser(Lesser(p, q), r), Greater(Greater(p, q), r)};
}

/// How far two projections on a line are apart, whichever is first.
WIDE inline Lanes Gap(const WideRange& a, const WideRange& b) {
  return Greater(b.low - a.high, a.low - b.high);
}

WIDE inline Lanes GapAlongNormals(const WideTriangles& a, const WideTriangles& b) {
  const Lanes along_a = Gap({a.below, a.above}, RangeAlong(a.normal, b.corner));
  const Lanes along_b = Gap({b.below, b.above}, RangeAlong(b.normal, a.corner));
  return Greater(along_a, along_b);
}

WIDE inline Lanes GapAcrossEdges(const WideTriangles& a, const WideTriangles& b,
                                 const Lanes& other) {
  Lanes gap = other;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Points edge_a = a.corner[(i + 1) % 3] - a.corner[i];
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const Points n = Cross(edge_a, b.corner[(j + 1) % 3] - b.corner[j]);
      const Lanes along = Gap(RangeAlong(n, a.corner), RangeAlong(n, b.corner));
      // The square may underflow. For a direction that short, the added term makes the gap about 0,
      // which claims nothing.
      gap = Greater(along / Root(Dot(n, n) + All(kShortSquare)), gap);
    }
  }
  return gap;
}

/// The projections of B's triangles on the direction.
WIDE inline WideRange AlongB(const KernelPose& pose, const TurnedBlock& turned) {
  const float* const n = pose.direction;
  const float* const o = pose.offset;
  const Lanes shift = All((n[0] * o[0] + n[1] * o[1]) + n[2] * o[2]);
  const Lanes p = LoadFour(turned.along), q = LoadFour(turned.along + 4),
              r = LoadFour(turned.along + 8);
  return {Lesser(Lesser(p, q), r) + shift, Greater(Greater(p, q), r) + shift};
}

WIDE inline WideRange AlongA(const KernelPose& pose, const sphere_tree::TriangleBlock& block,
                             std::uint32_t row) {
  const Points n = AllOf(pose.direction);
  Points corner[3];
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    corner[k] = {SpreadFours(block.x + 4 * k, row), SpreadFours(block.y + 4 * k, row),
                 SpreadFours(block.z + 4 * k, row)};
  }
  return RangeAlong(n, corner);
}

constexpr std::uint32_t kGroups = 16 / kWidth;

/// Which lower bounds are within the limit: whole blocks go on to the next directions or none, so
/// that all widths of vectors tell the same.
WIDE inline unsigned Within(const BlockScanTask& task, const Lanes* gaps) {
  unsigned within = 0;
  for (std::uint32_t g = 0; g < kGroups; ++g) {
    within |= NotGreater(gaps[g] - All(task.slack), All(task.limit)) << (g * kWidth);
  }
  return within;
}

WIDE inline unsigned NotApart(const KernelPose& pose, const BlockScanTask& task,
                              const TurnedBlock& turned) {
  constexpr float kHere[3] = {0, 0, 0};
  const Lanes apart = All(kEdgeSlack * task.slack + task.limit);
  EdgeBlock of_a, of_b;
  EdgesOf(task.a->x, task.a->y, task.a->z, kHere, &of_a);
  EdgesOf(turned.x, turned.y, turned.z, pose.offset, &of_b);
  const WideEdges edges_b = EdgesOfB(of_b);
  unsigned within = 0;
  for (std::uint32_t g = 0; g < kGroups; ++g) {
    within |= NotApartAcrossEdges(EdgesOfA(of_a, g * kWidth / 4), edges_b, apart) << (g * kWidth);
  }
  return within;
}

WIDE inline unsigned ScanTriangles(const KernelPose& pose, const BlockScanTask& task, float* beyond,
                                   float* lowers) {
  const sphere_tree::TriangleBlock &a = *task.a, &b = *task.b;
  TurnedBlock turned;
  Turn(pose, b, &turned);
  const WideRange along_b = AlongB(pose, turned);
  Lanes gaps[kGroups];
  for (std::uint32_t g = 0; g < kGroups; ++g) {
    gaps[g] = Gap(AlongA(pose, a, g * kWidth / 4), along_b);
  }
  unsigned within = Within(task, gaps);
  if (within != 0) {
    const WideTriangles of_b = TrianglesOfB(pose, b, turned);
    for (std::uint32_t g = 0; g < kGroups; ++g) {
      gaps[g] = Greater(GapAlongNormals(TrianglesOfA(a, g * kWidth / 4), of_b), gaps[g]);
    }
    within = Within(task, gaps);
    if (within != 0 && task.only_within) {
      within &= NotApart(pose, task, turned);
    } else if (within != 0) {
      for (std::uint32_t g = 0; g < kGroups; ++g) {
        gaps[g] = GapAcrossEdges(TrianglesOfA(a, g * kWidth / 4), of_b, gaps[g]);
      }
      within = Within(task, gaps);
    }
  }
  if (task.only_within) {
    for (std::uint32_t g = 0; g < kGroups; ++g) {
      Store(lowers + g * kWidth, gaps[g] - All(task.slack));
    }
    beyond[0] = beyond[0] < task.limit ? beyond[0] : task.limit;
    return within;
  }
  Lanes least_beyond = Load(beyond);
  for (std::uint32_t g = 0; g < kGroups; ++g) {
    const Lanes lower = gaps[g] - All(task.slack);
    const Lanes others = Greater(
        WhereGreater(lower, All(task.limit), All(sphere_tree::kFarDistance)), All(task.parent));
    least_beyond = Lesser(others, least_beyond);
    Store(lowers + g * kWidth, lower);
  }
  Store(beyond, least_beyond);
  return within;
}

}  // namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD

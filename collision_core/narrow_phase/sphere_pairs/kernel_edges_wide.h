// Whether triangles are apart across their edges, in wide vectors. For kernel_triangles_wide.h.
#pragma once

#include "collision_core/narrow_phase/sphere_pairs/kernel_pose_wide.h"

namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD {

/// Edges of four triangles, edge k of triangle i at 4 k + i, from corner k to the next one.
struct EdgeBlock {
  alignas(64) float x[16], y[16], z[16];
  alignas(64) float moment_x[16], moment_y[16], moment_z[16];  ///< Corner by edge.
  alignas(64) float square[16];                                ///< Of the length.
};

/// Corners in their order, and the first ones once more.
struct CornerCircle {
  alignas(64) float x[24], y[24], z[24];
};

WIDE inline void Close(const float* corners, float* circle) {
  __builtin_memcpy(circle, corners, 12 * sizeof(float));
  __builtin_memcpy(circle + 12, corners, 8 * sizeof(float));
}

WIDE inline void EdgesOf(const float* x, const float* y, const float* z, const float* offset,
                         EdgeBlock* edges) {
  CornerCircle circle;
  Close(x, circle.x), Close(y, circle.y), Close(z, circle.z);
  const Points shift = AllOf(offset);
  for (std::uint32_t k = 0; k < 16; k += kWidth) {
    const Points from = LoadPoints(circle.x + k, circle.y + k, circle.z + k) + shift;
    const Points to = LoadPoints(circle.x + 4 + k, circle.y + 4 + k, circle.z + 4 + k) + shift;
    const Points edge = to - from, moment = Cross(from, edge);
    Store(edges->x + k, edge.x), Store(edges->y + k, edge.y), Store(edges->z + k, edge.z);
    Store(edges->moment_x + k, moment.x), Store(edges->moment_y + k, moment.y);
    Store(edges->moment_z + k, moment.z), Store(edges->square + k, Dot(edge, edge));
  }
}

struct WideEdges {
  Points edge[3], moment[3];
  Lanes longest;  ///< No edge is longer, but for rounding.
};

WIDE inline Lanes LongestOf(const Lanes& p, const Lanes& q, const Lanes& r) {
  return Root(Greater(Greater(p, q), r) + All(kDistinctMin * kDistinctMin));
}

WIDE inline WideEdges EdgesOfA(const EdgeBlock& block, std::uint32_t row) {
  WideEdges e;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    e.edge[k] = {SpreadFours(block.x + 4 * k, row), SpreadFours(block.y + 4 * k, row),
                 SpreadFours(block.z + 4 * k, row)};
    e.moment[k] = {SpreadFours(block.moment_x + 4 * k, row),
                   SpreadFours(block.moment_y + 4 * k, row),
                   SpreadFours(block.moment_z + 4 * k, row)};
  }
  e.longest = LongestOf(SpreadFours(block.square, row), SpreadFours(block.square + 4, row),
                        SpreadFours(block.square + 8, row));
  return e;
}

WIDE inline WideEdges EdgesOfB(const EdgeBlock& block) {
  WideEdges e;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    e.edge[k] = {LoadFour(block.x + 4 * k), LoadFour(block.y + 4 * k), LoadFour(block.z + 4 * k)};
    e.moment[k] = {LoadFour(block.moment_x + 4 * k), LoadFour(block.moment_y + 4 * k),
                   LoadFour(block.moment_z + 4 * k)};
  }
  e.longest =
      LongestOf(LoadFour(block.square), LoadFour(block.square + 4), LoadFour(block.square + 8));
  return e;
}

/// Which pairs no direction across two edges shows to be apart by more than `apart`. Across edges e
/// and f, from corners p and q, B is beyond A by D = (e × f)·(q − p) = −(e·(q × f) + f·(p × e));
/// seen from p, A's third corner is at −f·N with its normal N, and seen from q, B's is at e·N.
WIDE inline unsigned NotApartAcrossEdges(const WideEdges& a, const WideEdges& b,
                                         const Lanes& apart) {
  const Lanes none = All(0);
  const Points normal_a = Cross(a.edge[0], a.edge[1]), normal_b = Cross(b.edge[0], b.edge[1]);
  Lanes low_a[3], high_a[3], most = All(-sphere_tree::kFarDistance),
                             least = All(sphere_tree::kFarDistance);
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    const Lanes third = Dot(b.edge[j], normal_a);
    low_a[j] = Lesser(third, none), high_a[j] = Greater(third, none);
  }
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Lanes third = Dot(a.edge[i], normal_b);
    const Lanes low_b = Lesser(third, none), high_b = Greater(third, none);
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const Lanes before = Dot(a.edge[i], b.moment[j]) + Dot(b.edge[j], a.moment[i]);
      most = Greater((low_b + low_a[j]) - before, most);
      least = Lesser((high_b + high_a[j]) - before, least);
    }
  }
  const Lanes wanted = (apart * a.longest) * b.longest + All(kProductLoss);
  return NotGreater(most, wanted) & NotGreater(none - wanted, least);
}

}  // namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD

// The kernels of sphere_pair_kernel.h, in whatever a wide vector is. Only for
// sphere_pair_kernel*.cc, which say so first: WIDE, the attribute of functions for their processor;
// Lanes, with the four operators, and kWidth, a multiple of eight; All(); OfEight() and OfFour(),
// so many values again and again; RowsOfEight(), values of one row and of another, and
// RowsOfFour(), from a row on, each in eight or four lanes; Load() and Store(); Lesser() and
// Greater() (of two, the second where they do not compare); Root(); Least() of all lanes;
// NotGreater(), the lanes of a for which it does not hold beside b; and Beyond(), a where it is
// greater, else kNowhere.
#pragma once

#include "collision_core/narrow_phase/sphere_pairs/kernel_edges_wide.h"

namespace collision::narrow_phase {
namespace {

struct WideBalls {
  WidePoint c;
  Lanes radius, distance;
};

/// The arrays of balls of which one after the other is taken.
struct RowArrays {
  const float *x, *y, *z, *radius, *distance;
};

WIDE inline WideBalls BallsOf(const sphere_tree::BallPack& pack) {
  return {{OfEight(pack.x), OfEight(pack.y), OfEight(pack.z)},
          OfEight(pack.radius),
          OfEight(pack.signed_distance)};
}

/// What turning may move the centres by belongs to the radii and to the signed distances.
WIDE inline void LetTurn(float turn, const float* from, WideBalls* balls) {
  const WidePoint own = {balls->c.x + All(from[0]), balls->c.y + All(from[1]),
                         balls->c.z + All(from[2])};
  const Lanes moved = All(turn) * Root(Dot(own, own));
  balls->radius = balls->radius + moved;
  balls->distance = balls->distance + moved;
}

WIDE inline WideBalls BallsOfA(const KernelPose& pose, const sphere_tree::BallPack& pack) {
  WideBalls balls = BallsOf(pack);
  if (pose.turn_a > 0) LetTurn(pose.turn_a, pose.from_a, &balls);
  return balls;
}

WIDE inline WideBalls BallsOfB(const KernelPose& pose, const sphere_tree::BallPack& pack) {
  WideBalls balls = BallsOf(pack);
  if (pose.turn_b > 0) LetTurn(pose.turn_b, pose.from_b, &balls);
  balls.c = Posed(pose, balls.c);
  return balls;
}

/// Room for balls that were computed, to be taken one after the other.
struct RowRoom {
  alignas(64) float x[kWidth], y[kWidth], z[kWidth], radius[kWidth], distance[kWidth];
};

WIDE inline RowArrays Stored(const WideBalls& balls, RowRoom* room) {
  Store(room->x, balls.c.x), Store(room->y, balls.c.y), Store(room->z, balls.c.z);
  Store(room->radius, balls.radius), Store(room->distance, balls.distance);
  return {room->x, room->y, room->z, room->radius, room->distance};
}

WIDE inline RowArrays RowsOfA(const KernelPose& pose, const sphere_tree::BallPack& pack,
                              RowRoom* room) {
  if (pose.turn_a > 0) return Stored(BallsOfA(pose, pack), room);
  return {pack.x, pack.y, pack.z, pack.radius, pack.signed_distance};
}

constexpr unsigned kAllLanes = (1u << kWidth) - 1;

WIDE inline void ScanRows(const KernelPose& pose, const RowArrays& rows, std::uint32_t first,
                          const BallScanTask& task, const WideBalls& others, float* beyond,
                          BallHits* hits, float* uppers) {
  const Lanes slack = All(pose.slack), parent = All(task.parent), limit = All(task.limit);
  Lanes least = All(sphere_tree::kNowhere), least_beyond = Load(beyond);
  std::uint64_t within = 0;
  for (std::uint32_t done = 0; done < task.rows; done += kWidth / 8) {
    // The last of an odd number of rows stands beside itself, and is told once.
    const std::uint32_t row = first + done;
    const bool is_last = done + 1 >= task.rows;
    const std::uint32_t next = is_last ? row : row + 1;
    const WidePoint d = {others.c.x - RowsOfEight(rows.x, row, next),
                         others.c.y - RowsOfEight(rows.y, row, next),
                         others.c.z - RowsOfEight(rows.z, row, next)};
    const Lanes distance = Root(Dot(d, d));
    const Lanes radii = others.radius + RowsOfEight(rows.radius, row, next);
    const Lanes depths = others.distance + RowsOfEight(rows.distance, row, next);
    const Lanes lower = Greater((distance - radii) - slack, parent);
    const Lanes upper = (distance + depths) + slack;
    least = Lesser(upper, least);
    least_beyond = Lesser(Beyond(lower, limit), least_beyond);
    const unsigned mask = NotGreater(lower, limit) & (is_last ? 0xffu : kAllLanes);
    within |= std::uint64_t{mask} << (8 * done);
    Store(hits->lowers + 8 * done, lower);
    if (uppers != nullptr) Store(uppers + 8 * done, upper);
  }
  Store(beyond, least_beyond);
  const bool is_news = NotGreater(All(task.upper), least) != kAllLanes;
  hits->upper = is_news ? Least(least) : sphere_tree::kNowhere;
  hits->within = within;
}

/// Where only the limit counts, by squares. False where an upper bound may be news, roughly: then
/// it has to be looked at closely.
WIDE inline bool ScanRowsWithin(const KernelPose& pose, const RowArrays& rows, std::uint32_t first,
                                const BallScanTask& task, const WideBalls& others, float* beyond,
                                BallHits* hits) {
  const Lanes reach = All(pose.slack + task.limit), news = All(task.upper - pose.slack);
  const Lanes none = All(0), nearest = All(kDistinctMin);
  std::uint64_t within = 0;
  unsigned is_news = 0;
  for (std::uint32_t done = 0; done < task.rows; done += kWidth / 8) {
    const std::uint32_t row = first + done;
    const bool is_last = done + 1 >= task.rows;
    const std::uint32_t next = is_last ? row : row + 1;
    const WidePoint d = {others.c.x - RowsOfEight(rows.x, row, next),
                         others.c.y - RowsOfEight(rows.y, row, next),
                         others.c.z - RowsOfEight(rows.z, row, next)};
    const Lanes square = Dot(d, d);
    const Lanes radii = others.radius + RowsOfEight(rows.radius, row, next);
    const Lanes depths = others.distance + RowsOfEight(rows.distance, row, next);
    const Lanes apart = Greater(radii + reach, nearest), deep = Greater(news - depths, none);
    const unsigned mask = NotGreater(square, apart * apart) & (is_last ? 0xffu : kAllLanes);
    is_news |= NotGreater(deep * deep, square) ^ kAllLanes;
    within |= std::uint64_t{mask} << (8 * done);
    Store(hits->lowers + 8 * done, square - apart * apart);
  }
  if (is_news != 0) return false;
  beyond[0] = beyond[0] < task.limit ? beyond[0] : task.limit;
  hits->upper = sphere_tree::kNowhere;
  hits->within = within;
  return true;
}

WIDE inline void ScanAll(const KernelPose& pose, const RowArrays& rows, std::uint32_t first,
                         const BallScanTask& task, const WideBalls& others, float* beyond,
                         BallHits* hits, float* uppers) {
  const bool only_within = task.only_within && uppers == nullptr;
  if (only_within && ScanRowsWithin(pose, rows, first, task, others, beyond, hits)) return;
  ScanRows(pose, rows, first, task, others, beyond, hits, uppers);
}

WIDE void ScanBalls(const KernelPose& pose, const BallScanTask& task, float* beyond, BallHits* hits,
                    float* uppers) {
  RowRoom room;
  if (task.opened == Opened::kA) {
    const RowArrays rows = Stored(BallsOfB(pose, *task.b), &room);
    ScanAll(pose, rows, task.lane, task, BallsOfA(pose, *task.a), beyond, hits, uppers);
    return;
  }
  const RowArrays rows = RowsOfA(pose, *task.a, &room);
  const std::uint32_t first = task.opened == Opened::kB ? task.lane : 0;
  ScanAll(pose, rows, first, task, BallsOfB(pose, *task.b), beyond, hits, uppers);
}

struct WideTriangles {
  WidePoint corner[3], normal;
  Lanes above, below;
};

/// Corners and normals of a block, turned as B is.
struct TurnedBlock {
  alignas(64) float x[16], y[16], z[16];
  alignas(64) float along[16];  ///< On a direction.
};

WIDE inline void Turn(const KernelPose& pose, const sphere_tree::TriangleBlock& block,
                      TurnedBlock* turned) {
  const WidePoint direction = AllOf(pose.direction);
  for (std::uint32_t k = 0; k < 16; k += kWidth) {
    const WidePoint p = Turned(pose, {Load(block.x + k), Load(block.y + k), Load(block.z + k)});
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
    t.corner[k] = {OfFour(turned.x + 4 * k) + All(pose.offset[0]),
                   OfFour(turned.y + 4 * k) + All(pose.offset[1]),
                   OfFour(turned.z + 4 * k) + All(pose.offset[2])};
  }
  t.normal = {OfFour(turned.x + 12), OfFour(turned.y + 12), OfFour(turned.z + 12)};
  const Lanes shift = Dot(t.normal, AllOf(pose.offset));
  t.above = OfFour(block.above) + shift;
  t.below = OfFour(block.below) + shift;
  return t;
}

WIDE inline WideTriangles TrianglesOfA(const sphere_tree::TriangleBlock& block, std::uint32_t row) {
  WideTriangles t;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    t.corner[k] = {RowsOfFour(block.x + 4 * k, row), RowsOfFour(block.y + 4 * k, row),
                   RowsOfFour(block.z + 4 * k, row)};
  }
  t.normal = {RowsOfFour(block.x + 12, row), RowsOfFour(block.y + 12, row),
              RowsOfFour(block.z + 12, row)};
  t.above = RowsOfFour(block.above, row);
  t.below = RowsOfFour(block.below, row);
  return t;
}

struct WideRange {
  Lanes low, high;
};

WIDE inline WideRange RangeAlong(const WidePoint& n, const WidePoint* corners) {
  const Lanes p = Dot(n, corners[0]), q = Dot(n, corners[1]), r = Dot(n, corners[2]);
  return {Lesser(Lesser(p, q), r), Greater(Greater(p, q), r)};
}

/// How far two shadows on a line are apart, whichever is first.
WIDE inline Lanes Gap(const WideRange& a, const WideRange& b) {
  return Greater(b.low - a.high, a.low - b.high);
}

WIDE inline Lanes GapAlongNormals(const WideTriangles& a, const WideTriangles& b) {
  const Lanes along_a = Gap({a.below, a.above}, RangeAlong(a.normal, b.corner));
  const Lanes along_b = Gap({b.below, b.above}, RangeAlong(b.normal, a.corner));
  return Greater(along_a, along_b);
}

WIDE inline Lanes GapAcrossEdges(const WideTriangles& a, const WideTriangles& b, Lanes gap) {
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const WidePoint edge_a = Minus(a.corner[(i + 1) % 3], a.corner[i]);
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const WidePoint n = Cross(edge_a, Minus(b.corner[(j + 1) % 3], b.corner[j]));
      const Lanes along = Gap(RangeAlong(n, a.corner), RangeAlong(n, b.corner));
      // Squares may underflow: a direction that is as good as none tells as good as no gap.
      gap = Greater(along / Root(Dot(n, n) + All(kShortSquare)), gap);
    }
  }
  return gap;
}

/// The shadows of B's triangles on the direction.
WIDE inline WideRange AlongB(const KernelPose& pose, const TurnedBlock& turned) {
  const float* const n = pose.direction;
  const float* const o = pose.offset;
  const Lanes shift = All((n[0] * o[0] + n[1] * o[1]) + n[2] * o[2]);
  const Lanes p = OfFour(turned.along), q = OfFour(turned.along + 4), r = OfFour(turned.along + 8);
  return {Lesser(Lesser(p, q), r) + shift, Greater(Greater(p, q), r) + shift};
}

WIDE inline WideRange AlongA(const KernelPose& pose, const sphere_tree::TriangleBlock& block,
                             std::uint32_t row) {
  const WidePoint n = AllOf(pose.direction);
  WidePoint corner[3];
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    corner[k] = {RowsOfFour(block.x + 4 * k, row), RowsOfFour(block.y + 4 * k, row),
                 RowsOfFour(block.z + 4 * k, row)};
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

WIDE unsigned ScanTriangles(const KernelPose& pose, const BlockScanTask& task, float* beyond,
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
    const Lanes others = Greater(Beyond(lower, All(task.limit)), All(task.parent));
    least_beyond = Lesser(others, least_beyond);
    Store(lowers + g * kWidth, lower);
  }
  Store(beyond, least_beyond);
  return within;
}

const SpherePairKernel kPackScan = {&ScanBalls, &ScanTriangles};

}  // namespace
}  // namespace collision::narrow_phase

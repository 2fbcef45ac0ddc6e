// Pairs of balls in wide vectors. For sphere_pair_kernel_wide.h.
#pragma once

#include "collision_core/narrow_phase/sphere_pairs/kernel_pose_wide.h"

namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD {

struct WideBalls {
  Points c;
  Lanes radius, distance;
};

/// The arrays of balls of which one after the other is taken.
struct RowArrays {
  const float *x, *y, *z, *radius, *distance;
};

WIDE inline WideBalls BallsOf(const sphere_tree::BallPack& pack) {
  return {{LoadEight(pack.x), LoadEight(pack.y), LoadEight(pack.z)},
          LoadEight(pack.radius),
          LoadEight(pack.signed_distance)};
}

/// What turning may move the centres by belongs to the radii and to the signed distances.
WIDE inline void LetTurn(float turn, const float* from, WideBalls* balls) {
  const Points own = balls->c + AllOf(from);
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

/// Rows [first, first + task.rows), each of which is compared with all of `others`.
struct RowScan {
  const KernelPose& pose;
  const BallScanTask& task;
  RowArrays rows;
  std::uint32_t first;
  WideBalls others;
};

/// Where the results go, as SpherePairKernel::balls() is told.
struct ScanRoom {
  float* beyond;
  BallHits* hits;
  float* uppers;
};

/// The others against a row, or against this one and the next one.
struct BallDifferences {
  Points d;
  Lanes radii, depths;
};

WIDE inline BallDifferences DifferencesOf(const RowScan& scan, std::uint32_t row,
                                          std::uint32_t next) {
  const RowArrays& rows = scan.rows;
  const WideBalls& others = scan.others;
  return {
      {others.c.x - SpreadEights(rows.x, row, next), others.c.y - SpreadEights(rows.y, row, next),
       others.c.z - SpreadEights(rows.z, row, next)},
      others.radius + SpreadEights(rows.radius, row, next),
      others.distance + SpreadEights(rows.distance, row, next)};
}

/// All lower and upper bounds.
WIDE inline void ScanRows(const RowScan& scan, const ScanRoom& room) {
  const BallScanTask& task = scan.task;
  const Lanes slack = All(scan.pose.slack), parent = All(task.parent), limit = All(task.limit);
  const Lanes nowhere = All(sphere_tree::kFarDistance);
  Lanes least = nowhere, least_beyond = Load(room.beyond);
  std::uint64_t within = 0;
  for (std::uint32_t done = 0; done < task.rows; done += kWidth / 8) {
    // The last of an odd number of rows is compared twice at once, and reported once.
    const std::uint32_t row = scan.first + done;
    const bool is_last = done + 1 >= task.rows;
    const BallDifferences at = DifferencesOf(scan, row, is_last ? row : row + 1);
    const Lanes distance = Root(Dot(at.d, at.d));
    const Lanes lower = Greater((distance - at.radii) - slack, parent);
    const Lanes upper = (distance + at.depths) + slack;
    least = Lesser(upper, least);
    least_beyond = Lesser(WhereGreater(lower, limit, nowhere), least_beyond);
    const unsigned mask = NotGreater(lower, limit) & (is_last ? 0xffu : kAllLanes);
    within |= std::uint64_t{mask} << (8 * done);
    Store(room.hits->lowers + 8 * done, lower);
    if (room.uppers != nullptr) Store(room.uppers + 8 * done, upper);
  }
  Store(room.beyond, least_beyond);
  const bool is_news = NotGreater(All(task.upper), least) != kAllLanes;
  room.hits->upper = is_news ? LeastOf(least) : sphere_tree::kFarDistance;
  room.hits->within = within;
}

/// Where only the limit counts, by squares. False where an upper bound may be news, roughly: then
/// ScanRows() has to decide.
WIDE inline bool ScanRowsWithin(const RowScan& scan, const ScanRoom& room) {
  const BallScanTask& task = scan.task;
  const Lanes reach = All(scan.pose.slack + task.limit), news = All(task.upper - scan.pose.slack);
  const Lanes zero = All(0), nearest = All(kDistinctMin);
  std::uint64_t within = 0;
  unsigned is_news = 0;
  for (std::uint32_t done = 0; done < task.rows; done += kWidth / 8) {
    const std::uint32_t row = scan.first + done;
    const bool is_last = done + 1 >= task.rows;
    const BallDifferences at = DifferencesOf(scan, row, is_last ? row : row + 1);
    const Lanes square = Dot(at.d, at.d);
    const Lanes apart = Greater(at.radii + reach, nearest), deep = Greater(news - at.depths, zero);
    const unsigned mask = NotGreater(square, apart * apart) & (is_last ? 0xffu : kAllLanes);
    is_news |= NotGreater(deep * deep, square) ^ kAllLanes;
    within |= std::uint64_t{mask} << (8 * done);
    Store(room.hits->lowers + 8 * done, square - apart * apart);
  }
  if (is_news != 0) return false;
  room.beyond[0] = room.beyond[0] < task.limit ? room.beyond[0] : task.limit;
  room.hits->upper = sphere_tree::kFarDistance;
  room.hits->within = within;
  return true;
}

WIDE inline void ScanAll(const RowScan& scan, const ScanRoom& room) {
  const bool only_within = scan.task.only_within && room.uppers == nullptr;
  if (only_within && ScanRowsWithin(scan, room)) return;
  ScanRows(scan, room);
}

WIDE inline void ScanBalls(const KernelPose& pose, const BallScanTask& task, float* beyond,
                           BallHits* hits, float* uppers) {
  const ScanRoom to{beyond, hits, uppers};
  RowRoom room;
  if (task.opened == Opened::kA) {
    const RowArrays rows = Stored(BallsOfB(pose, *task.b), &room);
    return ScanAll({pose, task, rows, task.lane, BallsOfA(pose, *task.a)}, to);
  }
  const RowArrays rows = RowsOfA(pose, *task.a, &room);
  const std::uint32_t first = task.opened == Opened::kB ? task.lane : 0;
  ScanAll({pose, task, rows, first, BallsOfB(pose, *task.b)}, to);
}

}  // namespace collision::narrow_phase::sphere_pairs::COLLISION_SIMD

// Bounds of the distances of many balls, and of many triangles, at once: in wide vectors.
#pragma once

#include <cstdint>

#include "collision_core/shape/ball_pack.h"

namespace collision {

/// B's tree seen from A's, in single precision: a point y of B, seen from B's origin, is at
/// matrix y + offset, seen from A's.
struct ScanPose {
  float matrix[9];  ///< Row by row.
  float offset[3];
  float slack;           ///< Of balls: taken from lower bounds, added to upper ones.
  float triangle_slack;  ///< Of triangles, turning not included.
  float turn_a, turn_b;  ///< What turning moves a point by, per distance from the reference point.
  float from_a[3], from_b[3];  ///< The origins, seen from the reference points.
  float direction[3];  ///< About a unit vector from A to B, or zero: to project triangles on.
};

/// Which of two balls is opened.
enum class Opened : std::uint8_t { kA, kB, kBoth };

/// Every ball of pack `a` beside every one of `b`, or where only one is opened, its pack beside the
/// ball at `lane` of the other one.
struct BallScanTask {
  const BallPack* a;
  const BallPack* b;
  Opened opened;
  std::uint32_t lane;
  std::uint32_t rows;  ///< Balls in pack `a`; 1 where only one of the two is opened.
  float parent;        ///< A lower bound for all of them.
  float limit;         ///< Pairs with a greater lower bound are not told one by one.
  float upper;         ///< Only a lesser upper bound is news.
};

/// Every triangle of a block beside every one of another.
struct BlockScanTask {
  const TriangleBlock* a;
  const TriangleBlock* b;
  float slack;   ///< Turning included.
  float parent;  ///< As above.
  float limit;
};

inline constexpr std::uint32_t kPairsMax = kPackBalls * kPackBalls;
inline constexpr std::uint32_t kLanesOver = 16;  ///< Whole vectors are written.

/// The least lower bounds of pairs beyond the limit, lane by lane, over as many scans as there are.
using LeastBeyond = float[kLanesOver];

/// The pairs within the limit (or not numbers), in order; a code is 8 · row + lane.
struct BallHits {
  float upper;  ///< The least upper bound of all pairs if it is news, else kNowhere.
  std::uint32_t count;
  float lowers[kPairsMax + kLanesOver];
  std::uint32_t codes[kPairsMax + kLanesOver];
};

/// The kernels. All versions give the same bits: the order of the operations is one, none of them is
/// fused, and roots and quotients are rounded correctly.
///
/// With u = 2^-24, f the place of a ball's centre (or a corner) in its own pack, O the exact offset,
/// per coordinate of a posed point: the matrix is cast (u), three products (u), sums (2u): 4 u |f|
/// by Cauchy's inequality, as rows are unit vectors but for rounding; the offset is cast and summed:
/// 2u (|f| + |O|). In length less than √3 times that: 10.4 u |f| + 3.5 u |O|. The difference of two
/// such points adds u of itself, its square root 2.5 u of itself, the sum of radii, the difference
/// and taking the slack away u each of the largest: 6.5 u (|f_A| + |f_B| + |O| + radii). All in all
/// less than 17 u of S = extent_A + extent_B + |O|; that of turning, an arm of (2.5 + 1) u more times
/// a chord of at most 2, makes it 24 u S: kBallSlack.
///
/// Triangles: corners are cast (√3 u |f| each); a dot product with a direction of length at most
/// 1 + 2^-20 is off by 3 u |x|; `above` and `below` of B are those of its own frame, shifted by
/// normal · offset, and its normal is turned with an error below 8 u: in all less than
/// (10.4 + 1.8 + 3 + 8) u |f_B| + (1.8 + 3) u |f_A| + (3.5 + 3) u |O| + 2 u S for gap and division:
/// below 28 u S; directions that are up to 1 + 8 u long make gaps, below 2 S, too large by up to
/// 16 u S: kTriangleSlack.
struct PackScan {
  /// `uppers` (or null): room for 8 · rows + kLanesOver upper bounds.
  void (*balls)(const ScanPose& pose, const BallScanTask& task, float* beyond, BallHits* hits,
                float* uppers);
  /// Writes the lower bounds of 4 · 4 pairs: along the direction, and where that leaves one within
  /// `limit`, along both normals, and likewise across all pairs of edges. Returns which are within
  /// the limit, or not numbers: bit 4 · row + lane.
  unsigned (*triangles)(const ScanPose& pose, const BlockScanTask& task, float* beyond,
                        float* lowers);
};

inline constexpr double kBallSlack = 0x1p-24 * 24;
inline constexpr double kTriangleSlack = 0x1p-24 * 48;

/// The widest that this processor has.
const PackScan& WidestPackScan();

/// Each on its own, for tests; null where the processor or the compiler has none.
const PackScan* PlainPackScan();
const PackScan* Avx2PackScan();
const PackScan* Avx512PackScan();

}  // namespace collision

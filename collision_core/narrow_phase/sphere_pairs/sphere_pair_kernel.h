// Bounds of the distances of many balls, and of many triangles, at once: in wide vectors.
#pragma once

#include <cstdint>

#include "collision_core/sphere_tree/packed_layout.h"

namespace collision::narrow_phase {

/// B's tree seen from A's, in single precision: a point y of B, seen from B's origin, is at
/// matrix y + offset, seen from A's.
struct KernelPose {
  float matrix[9];  ///< Row by row.
  float offset[3];
  float slack;           ///< For balls: taken from lower bounds, added to upper ones.
  float triangle_slack;  ///< For triangles, turning not included.
  float turn_a, turn_b;  ///< What turning moves a point by, per distance from the reference point.
  float from_a[3], from_b[3];  ///< The origins, seen from the reference points.
  float direction[3];  ///< About a unit vector from A to B, or zero: to project triangles on.
};

/// Which of two balls is opened.
enum class Opened : std::uint8_t { kA, kB, kBoth };

/// Every ball of pack `a` against every ball of `b`; if only one is opened, its pack against the
/// ball at `lane` of the other.
struct BallScanTask {
  const sphere_tree::BallPack* a;
  const sphere_tree::BallPack* b;
  Opened opened;
  std::uint32_t lane;
  std::uint32_t rows;  ///< Balls in pack `a`; 1 where only one of the two is opened.
  float parent;        ///< A lower bound for all of them.
  float limit;         ///< Pairs with a greater lower bound are not reported.
  float upper;         ///< The least upper bound known; only a smaller one is reported.
  /// Reports only which pairs are within the limit. `beyond` is the limit then, and the value that
  /// is reported for a pair is no bound: it is 0 at most, and mostly less the nearer the two are.
  bool only_within = false;
};

/// Every triangle of a block against every one of another.
struct BlockScanTask {
  const sphere_tree::TriangleBlock* a;
  const sphere_tree::TriangleBlock* b;
  float slack;   ///< Turning included.
  float parent;  ///< A lower bound for all of them.
  float limit;
  bool only_within = false;  ///< Likewise; lower bounds leave out what edges tell.
};

inline constexpr std::uint32_t kPairsMax = sphere_tree::kPackBalls * sphere_tree::kPackBalls;
inline constexpr std::uint32_t kLanesOver = 16;  ///< Whole vectors are written.

/// The least lower bounds of pairs beyond the limit, lane by lane, over as many scans as there are.
using LeastBeyond = float[kLanesOver];

/// The pair of a row and a lane has bit 8 · row + lane in `within` and that index in `lowers`.
struct BallHits {
  float upper;           ///< The least upper bound if it is below the task's, else kFarDistance.
  std::uint64_t within;  ///< The pairs within the limit, or not numbers.
  float lowers[kPairsMax + kLanesOver];
};

/// The kernels. All versions give the same bits: the order of the operations is one, none of them
/// is fused, and roots and quotients are rounded correctly.
///
/// With u = 2^-24, f the place of a ball's centre (or a corner) in its own pack, O the exact
/// offset, per coordinate of a posed point: the matrix is cast (u), three products (u), sums (2u):
/// 4 u |f| by Cauchy's inequality, as rows are unit vectors but for rounding; the offset is cast
/// and summed: 2u (|f| + |O|). In length less than √3 times that: 10.4 u |f| + 3.5 u |O|. The
/// difference of two such points adds u of itself, its square root 2.5 u of itself, the sum of
/// radii, the difference and taking the slack away u each of the largest: 6.5 u (|f_A| + |f_B| +
/// |O| + radii). All in all less than 17 u of S = extent_A + extent_B + |O|; that of turning, an
/// arm of (2.5 + 1) u more times a chord of at most 2, makes it 24 u S: kBallSlack.
///
/// Triangles: corners are cast (√3 u |f| each); a dot product with a direction of length at most 1
/// + 2^-20 is off by 3 u |x|; `above` and `below` of B are those of its own frame, shifted by
/// normal · offset, and its normal is turned with an error below 8 u: in all less than (10.4 + 1.8
/// + 3 + 8) u |f_B| + (1.8 + 3) u |f_A| + (3.5 + 3) u |O| + 2 u S for gap and division: below 28 u
/// S; directions that are up to 1 + 8 u long make gaps, below 2 S, too large by up to 16 u S:
/// kTriangleSlack. Across edges that are short or parallel the direction's square may underflow,
/// and its products lose up to 2^-146 S: with kShortSquare that is 2^-96 S of the gap at most.
///
/// Where only the limit counts, L = slack + limit. Balls: a square is off by 5 u of itself, that of
/// the sum of radii and L by no more than the sum, rounded twice, and u: all in all by less than a
/// root, a difference and L taken away. Nothing is decided for distances below kDistinctMin, so
/// that squares keep their digits.
///
/// Triangles across edges, seen from A's origin, E and F the longest edges of the two: edges are
/// off by u of themselves, their moments and normals by (2.9 + 2) u of the lengths' product, dot
/// products by 3 u; D by 8.9 u S E F, as |p| + |q| <= S; the third corners by 8.9 u E F (E + F) <=
/// 17.8 u S E F; sums by 5 u S E F: 31.7 u S E F. The corners themselves are off by 10.4 u S at
/// most, and E F L by 9 u of itself, where L < 3 S or nothing is decided: in all 69.1 u S. So 3/2
/// of the slack of triangles is enough: kEdgeSlack. Products that underflow lose less than 2^-146
/// (1 + S) where S < 2^51: kProductLoss.
struct SpherePairKernel {
  /// `uppers` (or null): room for 8 · rows + kLanesOver upper bounds.
  void (*balls)(const KernelPose& pose, const BallScanTask& task, float* beyond, BallHits* hits,
                float* uppers);
  /// Writes the lower bounds of 4 · 4 pairs: along the direction, and where that leaves one within
  /// `limit`, along both normals, and likewise across all pairs of edges. Returns which are within
  /// the limit, or not numbers: bit 4 · row + lane.
  unsigned (*triangles)(const KernelPose& pose, const BlockScanTask& task, float* beyond,
                        float* lowers);
};

inline constexpr double kBallSlack = 0x1p-24 * 24;
inline constexpr double kTriangleSlack = 0x1p-24 * 48;
inline constexpr float kShortSquare = 0x1p-100f;  ///< [m⁴]
inline constexpr float kEdgeSlack = 1.5f;
inline constexpr float kDistinctMin = 0x1p-60f;  ///< [m]
inline constexpr float kProductLoss = 0x1p-90f;  ///< [m³]

/// The widest that this processor has.
const SpherePairKernel& WidestSpherePairKernel();

/// Each on its own, for tests; null where the processor or the compiler has none.
const SpherePairKernel* PlainSpherePairKernel();
const SpherePairKernel* Avx2SpherePairKernel();
const SpherePairKernel* Avx512SpherePairKernel();

}  // namespace collision::narrow_phase

// The separating axis test of two boxes at a pose; undecided where rounding might decide.
#pragma once

namespace collision::narrow_phase {

/// Two cores whose difference is a zonotope: d + Σ s_i g_i + Σ t_j m_j with factors in [−1, 1], the
/// half edges g_i of A and m_j = R h_j of B. Plain numbers: the kernel is built for several
/// processors. Matrices column by column.
struct BoxPair {
  const double* of_a;      ///< g_0, g_1, g_2.
  const double* of_b;      ///< h_0, h_1, h_2, in B's frame.
  const double* rotation;  ///< R, a rotation to within 2^-20.
  double d[3];             ///< From A's centre to B's; may be off by 2^-53 |d|.
  double span_a;           ///< At least the sum of the edges' lengths.
  double span_b;           ///< The same of B.
  double size;             ///< At least |d| + span_a + span_b (1 + 2^-19); S below.
  double apart;            ///< Cores further apart than this do not touch.
  double inside;  ///< A difference that holds the ball of this radius about 0 is contact; >= 0.
};

/// The result of the test.
enum class BoxSeparation { kUnknown, kApart, kTouching };

/// Tests the axes of all faces and of all pairs of edges; edges may be zero, as those of a segment
/// are. kTouching requires two boxes without parallel edges, and edges of A that are orthogonal to
/// within rounding; kUnknown where rounding might decide.
BoxSeparation TestSeparatingAxes(const BoxPair& pair);

/// The versions, for tests. All give the same bits; null where the processor has no such vectors.
using SeparatingAxisKernel = BoxSeparation (*)(const BoxPair&);
SeparatingAxisKernel PlainSeparatingAxisTest();
SeparatingAxisKernel Avx2SeparatingAxisTest();

}  // namespace collision::narrow_phase

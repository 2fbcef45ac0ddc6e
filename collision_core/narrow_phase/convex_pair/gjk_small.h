// GJK for small cores as plain numbers: where two polytopes are nearest, or that they overlap, with
// proof.
#pragma once

namespace collision::narrow_phase {

/// A core: its half edges, each in both directions, or few points; its centre does not count.
struct SmallGjkCore {
  bool is_hull = false;
  int edges = 0;   ///< Half edges: 0 to 3.
  double axes[9];  ///< The half edges, or the frame that a hull's points are seen in: columns,
                   ///< as A sees them.
  double reach[3] = {1, 1, 1};  ///< About how far it reaches along each of these, of their lengths.
  const double* points = nullptr;  ///< The points of a hull: x, y and z of four at a time.
  int blocks = 0;
};

/// Two cores and when the search may end.
struct SmallGjkPair {
  SmallGjkCore a, b;
  double d[3];    ///< From A's centre to B's; may be off by 2^-53 |d|.
  double size;    ///< S, as of a ConvexPair.
  double apart;   ///< Stop when the distance is known to exceed this [m].
  double near;    ///< Stop when the distance is known to be below this [m].
  double inside;  ///< Stop when the ball of this radius about 0 belongs to the difference [m]; > 0.
  /// Stop when the bracket is narrower than this share of |gap − rounding|.
  double relative_tolerance;
  double rounding;            ///< The rounding radii of both sets together [m].
  double absolute_tolerance;  ///< Stop when the bracket is narrower than this [m].
};

/// A certified bracket of the distance.
struct SmallGjkResult {
  double lower, upper;  ///< Bounds of the distance of the cores, rounding errors included.
  bool inside = false;  ///< The ball certainly belongs to the difference.
};

/// Searches with the widest kernel that this processor has.
SmallGjkResult RunSmallGjk(const SmallGjkPair& pair);

/// The versions, for tests. All give the same bits; null where the processor has no such vectors.
using SmallGjkKernel = SmallGjkResult (*)(const SmallGjkPair&);
SmallGjkKernel PlainSmallGjk();
SmallGjkKernel Avx2SmallGjk();

}  // namespace collision::narrow_phase

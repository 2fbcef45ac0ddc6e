// Where two polytopes are nearest, or that they overlap: a search with its own proof, for cores that
// are seen as plain numbers.
#pragma once

namespace collision {

/// A core: its half edges, each in both directions, or few points; its centre does not count.
struct QuickCore {
  bool is_hull = false;
  int edges = 0;   ///< Half edges: 0 to 3.
  double axes[9];  ///< The half edges, or the frame that a hull's points are seen in: columns,
                   ///< as A sees them.
  double reach[3] = {1, 1, 1};  ///< About how far it reaches along each of these, of their lengths.
  const double* points = nullptr;  ///< Of a hull: x, y and z of four, again and again.
  int blocks = 0;
};

struct QuickPair {
  QuickCore a, b;
  double d[3];      ///< From A's centre to B's; may be off by 2^-53 |d|.
  double size;      ///< S, as of a ConvexPair.
  double apart;     ///< It is enough to know that they are further apart than this,
  double near;      ///< or nearer,
  double inside;    ///< or that the ball of this radius about 0 belongs to the difference; > 0.
  double share;     ///< Ends as close to each other as this, relative to how much they differ
  double rounding;  ///< from this, are close enough,
  double width;     ///< or as this.
};

struct QuickDistance {
  double lower, upper;  ///< Of the cores, rounding counted in.
  bool inside = false;  ///< The ball certainly belongs to the difference.
};

QuickDistance SearchQuickly(const QuickPair& pair);

/// The same bits, the second faster; null where the processor has no such vectors.
using QuickKernel = QuickDistance (*)(const QuickPair&);
QuickKernel PlainQuickSearch();
QuickKernel Avx2QuickSearch();

}  // namespace collision

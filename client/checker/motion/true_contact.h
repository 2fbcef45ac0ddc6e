// One contact of a run, from the agents' exact motion.
#pragma once

#include <cstddef>
#include <vector>

#include "client/checker/motion/contact_spans.h"

namespace collision::checker {

/// The best accuracy of the checker's own times [ns]. It may miss contacts shorter than twice this,
/// so they are neither demanded nor forbidden.
inline constexpr long double kRootTolerance = 1;

/// A span of time during which two agents share a point without a gap: balls whose distance is at
/// most the sum of their radii; bodies with triangles as solids if closed and as surfaces if open.
struct TrueContact {
  std::size_t a = 0;  ///< Indices of the motions, a < b.
  std::size_t b = 0;
  long double begin_ns = 0;
  long double end_ns = 0;
  bool from_start = false;  ///< In contact already when the later of the two appeared.
  bool to_end = false;      ///< Still in contact when the first of the two left.
  /// False: a graze, so near or shallow (advancement.h) that it is neither demanded nor forbidden.
  bool certain = true;
  /// Accuracy of the two times [ns].
  long double begin_tolerance_ns = kRootTolerance;
  long double end_tolerance_ns = kRootTolerance;
  /// Where a gap may have stayed unseen, in order [ns]: an end and a new begin there are neither
  /// demanded nor forbidden.
  std::vector<Span> blind = {};
  /// Until then the agents' balls overlap without a gap [ns], so the service may be unable to
  /// certify that the contact is over.
  long double balls_until_ns = 0;
  /// Of a crossing of a level with hysteresis: numbers of times that the pair had been beyond the
  /// hysteresis before it (level_visits.h).
  std::size_t visit = 0, long_visit = 0;
};

}  // namespace collision::checker

// All contacts of a run, from the agents' exact motion.
#pragma once

#include <vector>

#include "client/simulators/checker/contact_spans.h"
#include "client/simulators/checker/motion_truth.h"

namespace collision::checker {

/// How exactly the checker knows its own times at best [ns]. Contacts that touch for less than twice
/// this may or may not be seen by it, so they are neither demanded nor forbidden.
inline constexpr long double kRootTolerance = 1;

/// Two agents that share a point, without a gap: balls at a distance of at most the sum of their
/// radii; of bodies with triangles, solids where closed and surfaces where open.
struct TrueContact {
  std::size_t a = 0;  ///< Indices of the motions, a < b.
  std::size_t b = 0;
  long double begin_ns = 0;
  long double end_ns = 0;
  bool from_start = false;  ///< In contact already when the later of the two appeared.
  bool to_end = false;      ///< Still in contact when the first of the two left.
  /// False: a graze, so near or shallow (advancement.h) that it may or may not be a contact: neither
  /// demanded nor forbidden.
  bool certain = true;
  /// How exactly the two times are known [ns].
  long double begin_tolerance_ns = kRootTolerance;
  long double end_tolerance_ns = kRootTolerance;
  /// Where a gap may have stayed unseen, in order [ns]: an end and a new begin there are neither
  /// demanded nor forbidden.
  std::vector<Span> blind = {};
  /// Until then the agents' balls overlap without a gap [ns]: so long it may be hard to say that
  /// there is no contact any more.
  long double balls_until_ns = 0;
};

/// In order of begin. Boxes swept over slabs of time leave only near pairs to the root finder, and
/// spans in which balls overlap to the triangles.
std::vector<TrueContact> TrueContacts(const std::vector<AgentMotion>& motions);

}  // namespace collision::checker

// The certified bracket of the distance between two posed bodies, by their sphere trees.
//
// A query opens pairs of nodes. `lower` is the least lower bound of what is not opened, `upper` a
// running minimum, so both ends hold at any moment and only become narrower. A query ends when its
// answer cannot change any more: certainly apart with at least half of the distance, certainly in
// contact, or resolved down to the triangles. Contact is certain by balls within the solids that
// overlap (upper <= 0; the depth is at least −upper), or by an edge that passes through a triangle
// wherever the corners lie within the uncertainty: the only way for open surfaces, and for solids
// the way that finds shallow contacts.
//
// Freedom also requires that one point of each component lies outside the other solid
// (TestContainment). One test per advance is enough: the surfaces stay apart after it, so no body
// can enter the other.
//
// A yes/no query (DecideAt) first tests the two roots: 20 ns for bodies whose balls are apart. Then
// the convex bodies around both (hull_gap.h): for bodies a tenth of their diameter apart they
// decide 85, 72 and 99 % of the poses on the first line (homer, spot, rocker-arm), nearly all on
// the others, in 0.1 µs instead of 0.4 µs; bodies that are deep in each other lose 0.1 µs by it.
// One inside the other is found at once where a body has an extreme vertex off the other's box. The
// search that follows compares squares instead of roots, because only the limit matters, and visits
// the newest pairs first.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"
#include "collision_core/narrow_phase/pose/verdict.h"
#include "collision_core/narrow_phase/separation/separation_bracket.h"

namespace collision::narrow_phase {

/// Queries the separation best-first over pairs of nodes: the pair that may be nearest is opened
/// next, ties by node number, so that the query may end at any moment with a bracket that only
/// became narrower. `hint`: leaves that are likely to be the nearest; what is farther away need not
/// be examined so closely.
SeparationBracket QuerySeparation(const PosedPair& pair, Goal goal, WorkBudget* work,
                                  const ContactWitness& hint = {});

/// Queries until the bracket of the distance is as narrow as `tolerance` asks for, or nothing makes
/// it narrower. It ends at once where contact is certain. Callers, none of them in the service: the
/// precision benchmark and tests (tests/bench/pairs/ours.cc).
SeparationBracket BracketSeparation(const PosedPair& pair, const BracketTolerance& tolerance,
                                    WorkBudget* work);

/// Re-tests this witness only: contact is reported in full, `lower` stays −infinity.
SeparationBracket RecheckWitness(const PosedPair& pair, const ContactWitness& witness,
                                 WorkBudget* work);

/// A verdict, and the bracket that was found on the way.
struct Decision {
  Verdict verdict = Verdict::kUndecided;
  SeparationBracket bracket;  ///< The bracket of the surfaces, as far as it was needed.
};

/// Goal::kYesNo, and where the surfaces are apart, whether one is inside the other. The uncertainty
/// of translation is counted in.
Decision DecideAt(const PosedPair& pair, WorkBudget* work);

}  // namespace collision::narrow_phase

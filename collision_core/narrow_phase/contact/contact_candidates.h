// Candidates for the first contact: where two surfaces that nearly touch will overlap first.
#pragma once

#include "collision_core/narrow_phase/separation/separation_bracket.h"
#include "collision_core/narrow_phase/separation/solid_point.h"

namespace collision::narrow_phase {

/// A candidate that may show an overlap that has just begun: a point or, where a convex solid is
/// involved, two elements.
struct ContactCandidate {
  SolidPoint point;
  ContactWitness pair;  ///< Kind::kElements: two elements; kNone: the point counts.

  bool is_pair() const { return !pair.is_none(); }
};

/// Proposes points of either body at which the two are within `within` [m] of each other at this
/// pose: in the middle of faces that lie on each other, of edges that coincide, and at corners; and
/// pairs of elements, 64 at most, that are so near and of which one is a convex solid. The
/// proposals are made in plain doubles; UpperBy() certifies them, so that a bad one does no harm.
///
/// Returns a few points of each kind, in the order of the kinds; within one, those of the largest
/// area or length first. The search begins at `first` if both are leaves. If one of the bodies is a
/// ball there are no candidates, because a ball and an element are measured exactly.
std::vector<ContactCandidate> FindContactCandidates(const PosedPair& pair, double within,
                                                    NodePair first, WorkBudget* work);

}  // namespace collision::narrow_phase

// Candidates for the first contact: where two surfaces that nearly touch will overlap first.
#pragma once

#include "collision_core/narrow_phase/separation/separation_bracket.h"
#include "collision_core/narrow_phase/separation/solid_point.h"

namespace collision::narrow_phase {

/// A candidate that may show an overlap that has just begun: a point or, where a convex solid is
/// involved, two elements.
struct ContactCandidate {
  SolidPoint point;
  ContactWitness pair;  ///< Kind::kTriangles; else it is the point.

  bool is_pair() const { return pair.kind != ContactWitness::Kind::kNone; }
};

/// Points of either body at which the two are within `within` [m] of each other at this pose: in
/// the middle of faces that lie on each other, of edges that do, of corners. A proposal in plain
/// doubles, to be certified by UpperBy(): nothing wrong can come of it. And all pairs of elements
/// so near of which one is a convex solid.
///
/// Of each kind of point a few, the widest first. `leaf_A`, `leaf_B`: where to look first. Of
/// bodies one of which is a ball there are none, since a ball and an element are judged exactly.
std::vector<ContactCandidate> FindContactCandidates(const PosedPair& pair, double within,
                                                    std::uint32_t leaf_A, std::uint32_t leaf_B,
                                                    WorkBudget* work);

}  // namespace collision::narrow_phase

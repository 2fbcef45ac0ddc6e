// The depth of a contact from above: a shift that certainly takes two bodies apart.
//
// Along any direction, the sum of the two bodies' reaches towards each other, less the distance of
// their reference points along it, is such a shift. The directions that are tried are the way
// between the reference points, the axes of both bodies, and the normals of the witness of contact,
// so that bodies that rest on a face are measured exactly. On a wide terrain that reach is its
// highest summit, however far away; so each way is tried once more with what is near only
// (local_separating_translation.h). The depth from below comes from balls within the solids,
// points, and for convex solids their difference.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"
#include "collision_core/narrow_phase/separation/separation_bracket.h"

namespace collision::narrow_phase {

/// Shifted by this along n [m], in A's body frame, B is certainly apart from A: the reach of A
/// along n and that of B against it, less what they are apart. Rounded up; the uncertainty of
/// rounding and turning is counted in, that of translation is not. +infinity where the work was
/// spent before. Requires IsUnit(n).
double SeparatingTranslationAlong(const PosedPair& pair, const Eigen::Vector3d& n,
                                  WorkBudget* work);

/// An upper bound of the translational penetration depth, rounding and turning included: the least
/// shift over the normals of the contact witness, the line of the reference points and the axes of
/// both bodies, each in both senses. Each is tried with SeparatingTranslationAlong() and, within a
/// shared budget, with LocalSeparatingTranslation().
double SeparatingTranslation(const PosedPair& pair, const ContactWitness& witness,
                             WorkBudget* work);

}  // namespace collision::narrow_phase

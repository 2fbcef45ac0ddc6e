// The depth of a contact from above, by what is near: a shift of one body out of its surroundings.
//
// Each direction is tried by queries at the shifted pose: where the two are certainly apart there,
// the shift is deep enough, whatever stands elsewhere. What shows the contact is followed first,
// because that costs next to nothing; then steps of four, then halves. A drone 50 mm deep in a hill
// (by a vertical shift) gets an upper bound of 37 mm in the median, for some 2,000 units beyond the
// reaches.
#pragma once

#include <cmath>

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/pose/posed_pair.h"
#include "collision_core/narrow_phase/separation/separation_bracket.h"

namespace collision::narrow_phase {

/// Normalising leaves a length that is off by 2.5 · 2^-53, and its norm is computed as well as that.
inline constexpr double kUnitLengthError = 0x1p-50;

/// Whether n has length 1 to within kUnitLengthError.
inline bool IsUnit(const Eigen::Vector3d& n) { return std::abs(n.norm() - 1) <= kUnitLengthError; }

/// Units for all directions of one pose: where they are spent what is known by then is the answer.
inline constexpr std::uint64_t kPastUnits = 3000;

/// Shifted by this along n [m], in A's body frame, B is certainly apart from A. Only what is near
/// the shifted body counts, where SeparatingTranslationAlong() counts all of A: the hills below,
/// and no summit far away. Rounded up; the uncertainty of rounding and turning is included, that of
/// translation is not.
///
/// `known`: a shift, along any direction, that takes the two apart. If B is not apart after three
/// quarters of it along n, or the work was spent before, the result is `known`; else a shift found
/// in steps of four, then by halves: at three quarters of it the two are not known to be apart, or
/// it is a 2^-16th of `known`. `witness` of contact, if there is any, saves work. Requires
/// IsUnit(n).
double LocalSeparatingTranslation(const PosedPair& pair, const Eigen::Vector3d& n, double known,
                                  const ContactWitness& witness, WorkBudget* work);

}  // namespace collision::narrow_phase

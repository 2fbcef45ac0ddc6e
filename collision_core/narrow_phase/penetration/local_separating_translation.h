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

/// Normalising leaves a length that is off by 2.5 · 2^-53, and its norm is computed as well as
/// that.
inline constexpr double kUnitLengthError = 0x1p-50;

/// Whether n has length 1 to within kUnitLengthError.
inline bool IsUnit(const Eigen::Vector3d& n) { return std::abs(n.norm() - 1) <= kUnitLengthError; }

/// Work units for all directions of one pose. When they are spent, the best shift so far is the
/// answer.
inline constexpr std::uint64_t kLocalTranslationUnits = 3000;

/// Shifted by this along n [m], in A's body frame, B is certainly apart from A. Only what is near
/// the shifted body counts, where SeparatingTranslationAlong() counts all of A: the hills below,
/// and no summit far away. Rounded up; the uncertainty of rounding and turning is included, that of
/// translation is not.
///
/// `known`: a shift, along any direction, that takes the two apart. Returns `known` if B is not
/// certainly apart at ¾ `known` along n, or if no work is left. Otherwise the shift is bracketed by
/// factors of four, then bisected, until the two are not known to be apart at ¾ of it, it is down
/// to 2^-16 `known`, or the work is spent. `witness` of contact, if there is any, saves work.
/// Requires IsUnit(n).
double LocalSeparatingTranslation(const PosedPair& pair, const Eigen::Vector3d& n, double known,
                                  const ContactWitness& witness, WorkBudget* work);

}  // namespace collision::narrow_phase

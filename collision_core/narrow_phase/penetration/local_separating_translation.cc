#include "collision_core/narrow_phase/penetration/local_separating_translation.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/separation/separation.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {
namespace {

/// A direction that saves less than a quarter is not worth a search.
constexpr double kWorthwhile = 0.75;

/// As a share of the answer: the search ends when it is so near to a shift at which the two are not
/// known to be apart.
constexpr double kNearEnough = 0.25;

/// As a share of the known shift: no smaller shift is tried.
constexpr double kFirstPlace = 0x1p-16;

class TranslationSearch {
 public:
  TranslationSearch(const PosedPair& pair, const Eigen::Vector3d& n, const ContactWitness& witness,
                    WorkBudget* work)
      : a_(pair.a), b_(pair.b), pose_(pair.pose), n_(n), witness_(witness), work_(*work) {}

  double Least(double known) {
    const double most = kWorthwhile * known;
    // As long as the witness shows contact no other query is needed.
    double shift = most;
    if (IsContactShown(shift)) return known;
    while (shift > kFirstPlace * known && !work_.exhausted() && !IsContactShown(shift / 2))
      shift /= 2;
    double touching = 0, apart = known;
    while (apart - touching > std::max(kNearEnough * apart, kFirstPlace * known) &&
           !work_.exhausted()) {
      const double spare = IsContactShown(shift) || work_.exhausted() ? -1 : Spare(shift);
      // Upwards: the length of n, and the difference.
      if (spare >= 0) apart = std::min(apart, (shift - spare) * numeric::kManyRoundingsUp);
      if (spare < 0) touching = shift;
      if (touching >= most) return known;
      shift = apart < known ? touching + (apart - touching) / 2 : std::min(4 * shift, most);
    }
    return apart;
  }

 private:
  // The pose with B shifted. Points posed with the new offset are rounded relative to it; the sum
  // that makes the offset loses less.
  RelativePose At(double shift) const {
    RelativePose shifted = pose_;
    shifted.p_AB += shift * n_;
    const double size = numeric::AddUp(pose_.p_AB.cwiseAbs().sum(), shift);
    shifted.offset_error =
        numeric::AddUp(pose_.offset_error,
                       numeric::MultiplyUp(2 * kPosingRounding * numeric::kManyRoundingsUp, size));
    shifted.translation = 0;
    return shifted;
  }

  bool IsContactShown(double shift) {
    const SeparationBracket bracket = RecheckWitness({a_, b_, At(shift)}, witness_, &work_);
    return bracket.CertainlyTouching(0);
  }

  /// By how much the shift may be reduced with the two still apart; negative: at this shift they
  /// are not known to be apart.
  double Spare(double shift) {
    const Decision decision = DecideAt({a_, b_, At(shift)}, &work_);
    if (!decision.bracket.witness.is_none()) witness_ = decision.bracket.witness;
    if (decision.verdict != Verdict::kApart) return -1;
    // Surfaces so far apart do not meet on the way back, and what is outside remains outside.
    return std::max(0.0, decision.bracket.lower);
  }

  const BodyTree& a_;
  const BodyTree& b_;
  const RelativePose& pose_;
  const Eigen::Vector3d n_;
  ContactWitness witness_;
  WorkBudget& work_;
};

}  // namespace

double LocalSeparatingTranslation(const PosedPair& pair, const Eigen::Vector3d& n, double known,
                                  const ContactWitness& witness, WorkBudget* work) {
  CORE_CHECK(IsUnit(n), "the direction has length 1", n.norm());
  if (!std::isfinite(known) || work->exhausted()) return known;
  return TranslationSearch(pair, n, witness, work).Least(known);
}

}  // namespace collision::narrow_phase

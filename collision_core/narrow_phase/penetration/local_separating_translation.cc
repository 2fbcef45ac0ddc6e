#include "collision_core/narrow_phase/penetration/local_separating_translation.h"

#include <algorithm>
#include <cmath>

#include "collision_core/narrow_phase/separation/separation.h"

namespace collision::narrow_phase {
namespace {

/// A direction that saves less than a quarter is not worth a search.
constexpr double kWorthwhile = 0.75;

/// Of the answer: nearer to a place where the two are not known to be apart no other is tried.
constexpr double kNearEnough = 0.25;

/// Of what is known: a place nearer than this is near enough.
constexpr double kFirstPlace = 0x1p-16;

class Shifting {
 public:
  Shifting(const PosedPair& pair, const Eigen::Vector3d& n, const ContactWitness& witness,
           WorkBudget* work)
      : a_(pair.a), b_(pair.b), pose_(pair.pose), n_(n), witness_(witness), work_(*work) {}

  double Least(double known) {
    const double most = kWorthwhile * known;
    // Before what shows the contact is gone nothing else need be asked.
    double shift = most;
    if (Shows(shift)) return known;
    while (shift > kFirstPlace * known && !work_.exhausted() && !Shows(shift / 2)) shift /= 2;
    double touching = 0, apart = known;
    while (apart - touching > std::max(kNearEnough * apart, kFirstPlace * known) &&
           !work_.exhausted()) {
      const double spare = Shows(shift) || work_.exhausted() ? -1 : Spare(shift);
      // 2^-40: the length of n, and the difference.
      if (spare >= 0) apart = std::min(apart, (shift - spare) * (1 + 0x1p-40));
      if (spare < 0) touching = shift;
      if (touching >= most) return known;
      shift = apart < known ? touching + (apart - touching) / 2 : std::min(4 * shift, most);
    }
    return apart;
  }

 private:
  // What is posed by the new offset is rounded relative to that; its own sum loses less.
  RelativePose At(double shift) const {
    RelativePose shifted = pose_;
    shifted.p_AB += shift * n_;
    const double size = numeric::AddUp(pose_.p_AB.cwiseAbs().sum(), shift);
    shifted.offset_error = numeric::AddUp(
        pose_.offset_error, numeric::MultiplyUp(2 * kPosingRounding * (1 + 0x1p-40), size));
    shifted.translation = 0;
    return shifted;
  }

  bool Shows(double shift) {
    const SeparationBracket bracket = RecheckWitness({a_, b_, At(shift)}, witness_, &work_);
    return bracket.CertainlyTouching(0);
  }

  /// How much less of a shift would do as well; negative: it may not do itself.
  double Spare(double shift) {
    const Decision decision = DecideAt({a_, b_, At(shift)}, &work_);
    if (decision.bracket.witness.kind != ContactWitness::Kind::kNone)
      witness_ = decision.bracket.witness;
    if (decision.verdict != Verdict::kApart) return -1;
    // Surfaces so far apart do not meet on the way, and what is outside remains outside.
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
  if (!std::isfinite(known) || work->exhausted()) return known;
  return Shifting(pair, n, witness, work).Least(known);
}

}  // namespace collision::narrow_phase

#include "client/checker/motion/advancement.h"

#include <algorithm>
#include <optional>

namespace collision::checker {
namespace {

constexpr long double kInstantWidth = 1e-11L;  // [s] how exactly a change is found
constexpr long double kStepMin = 1e-12L;       // [s]

// Bodies that stay very near, or barely in contact, would take very many steps. Below this margin
// [m] a step is at least this share of the time for which the margin has been so small, at the
// price of longer stretches of kNear and kBlind.
constexpr double kSlowMargin = 1e-5;
constexpr long double kSlowShare = 1.0L / 256;

class Advancement {
 public:
  Advancement(const Body& a, const Body& b, const PairMotion& motion)
      : a_(a), b_(b), motion_(motion) {}

  std::vector<Stretch> Run(long double begin, long double end) {
    long double t = begin;
    slow_since_ = begin;
    Standing now = Look(t);
    if (begin == end && now.contact) Add(Stretch::Kind::kContact, begin, end);
    while (t < end) {
      const auto [next, certain] = Step(t, end, now);
      outside_ = outside_ && certain;
      const Standing then = Look(next);
      if (then.contact == now.contact) {
        Add(KindOf(now, certain), t, next);
      } else {
        const long double change = ChangeIn(t, next, now.contact);
        Add(KindOf(now, certain), t, change);  // certain: rounding, at the step's end
        Add(KindOf(then, false), change, next);
      }
      if (then.contact) LookDeeper(next);
      if (then.margin >= kSlowMargin) slow_since_ = next;
      now = then;
      t = next;
    }
    return std::move(stretches_);
  }

 private:
  Standing Look(long double t) {
    const Standing standing = StandingOf(a_, b_, motion_.At(t), &hint_, outside_);
    outside_ = !standing.contact;
    return standing;
  }

  // The next step, and whether nothing can change in it.
  std::pair<long double, bool> Step(long double t, long double end, const Standing& now) const {
    const long double speed = motion_.SpeedMax(t, end, a_.reach(), b_.reach());
    if (!(speed > 0)) return {end, true};
    const long double certain = now.margin / speed;
    const double least = now.contact ? kMarginMinInContact : kMarginMinApart;
    long double shortest = std::max(kStepMin, least / speed);
    if (now.margin < kSlowMargin) shortest = std::max(shortest, (t - slow_since_) * kSlowShare);
    return {std::min(end, t + std::max(certain, shortest)), certain >= std::min(shortest, end - t)};
  }

  // An instant in [from, to] at which contact begins or ends.
  long double ChangeIn(long double from, long double to, bool contact) {
    while (to - from > kInstantWidth) {
      const long double middle = (from + to) / 2;
      if (InContact(a_, b_, motion_.At(middle), &hint_) == contact) {
        from = middle;
      } else {
        to = middle;
      }
    }
    return contact ? from : to;
  }

  void LookDeeper(long double t) {
    Stretch& last = stretches_.back();
    if (!last.deep) last.deep = InContactThrough(a_, b_, motion_.At(t), kGrazeDepth, &hint_);
  }

  static std::optional<Stretch::Kind> KindOf(const Standing& standing, bool certain) {
    if (standing.contact) return certain ? Stretch::Kind::kContact : Stretch::Kind::kBlind;
    if (certain) return std::nullopt;
    return Stretch::Kind::kNear;
  }

  void Add(std::optional<Stretch::Kind> kind, long double from, long double to) {
    if (!kind) return;
    const bool joins = !stretches_.empty() && stretches_.back().end == from;
    if (joins && stretches_.back().kind == *kind) {
      stretches_.back().end = to;
      return;
    }
    const bool deep = joins && *kind != Stretch::Kind::kNear && stretches_.back().deep;
    stretches_.push_back({*kind, from, to, deep});
  }

  const Body& a_;
  const Body& b_;
  const PairMotion& motion_;
  Hint hint_;
  bool outside_ = false;  // neither lies inside the other as long as the surfaces stay apart
  long double slow_since_ = 0;
  std::vector<Stretch> stretches_;
};

}  // namespace

std::vector<Stretch> StretchesOf(const Body& a, const Body& b, const PairMotion& motion,
                                 long double begin, long double end) {
  return Advancement(a, b, motion).Run(begin, end);
}

}  // namespace collision::checker

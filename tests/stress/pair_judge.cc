#include "tests/stress/pair_judge.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/support/truth/exact_balls.h"
#include "tests/support/truth/exact_meeting.h"

namespace collision::stress {
namespace {

std::string Named(const char* what, const motion::SpaceTimeBound& a,
                  const motion::SpaceTimeBound& b, double at) {
  const Eigen::Vector3d d = b.state.p_WA - a.state.p_WA, v = b.state.v_WA - a.state.v_WA;
  return std::string(what) + " at " + Show(at) + " s: distance " + Show(d.cwiseAbs().maxCoeff()) +
         " m, speed " + Show(v.cwiseAbs().maxCoeff()) + " m/s, radii " + Show(a.limits.radius) +
         " and " + Show(b.limits.radius) + " m, M " + Show(a.limits.acceleration_max) + " and " +
         Show(b.limits.acceleration_max) + " m/s2";
}

/// Near the denormals a unit in the last place is no share of anything: radius and M grow by so
/// many.
motion::SpaceTimeBound LargerBy(motion::SpaceTimeBound bound, double units) {
  bound.limits.radius += units * 0x1p-1074;
  if (bound.limits.acceleration_max > 0) {
    bound.limits.acceleration_max += units * 0x1p-1074;
  }
  return bound;
}

/// The least K of some tried for which the answer is the exact one; 1024: none of them.
double UnitsEarly(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b,
                  const intersection::IntersectionTime& time) {
  const Dyadic later = ExactMeeting::Nanoseconds(time.seconds) * Dyadic(1 + 1e-9);
  for (const double units : {0.0, 1.0, 2.0, 4.0, 8.0, kDenormalUnits, 64.0}) {
    const ExactMeeting larger(LargerBy(a, units), b, time.base, {false, units * 0x1p-52});
    if (larger.MetBy(later)) return units;
  }
  return 1024;
}

/// |Δp + Δv δ|² and (r ± u)² of two states with the same stamp, in seconds after it.
struct BoundGap : ExactGap {
  DyadicPolynomial size;  ///< What rounding is a share of: |Δp| + |Δv| δ + r + u.

  BoundGap(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, int sign_of_u) {
    const Dyadic half_M =
        Dyadic(0.5) * (Dyadic(a.limits.acceleration_max) + Dyadic(b.limits.acceleration_max));
    const Dyadic radii = Dyadic(a.limits.radius) + Dyadic(b.limits.radius);
    reach = {radii, {}, Dyadic(1.0 * sign_of_u) * half_M};
    size = {radii, {}, half_M};
    for (int i = 0; i < 3; ++i) {
      const Dyadic p = Dyadic(b.state.p_WA[i]) - Dyadic(a.state.p_WA[i]);
      const Dyadic v = Dyadic(b.state.v_WA[i]) - Dyadic(a.state.v_WA[i]);
      const DyadicPolynomial d = {p, v};
      square = square + d * d;
      size = size + DyadicPolynomial{p.Magnitude(), v.Magnitude()};
    }
  }

  /// Do bodies whose reach is larger by this share of all that counts touch at x?
  bool LargerTouchAt(double share, const Dyadic& x) const {
    return !ExactGap{square, reach + Dyadic(share) * size}.ApartAt(x);
  }

  /// Bodies that are smaller by a share of all that counts up to `end` (pair_judge.h). Requires
  /// sign_of_u < 0.
  bool SmallerApartOn(double share, const Dyadic& from, const Dyadic& until,
                      const Dyadic& end) const {
    DyadicPolynomial left = reach;
    const Dyadic largest = size[0] + size[1] * end + Dyadic(2.0) * reach[0];
    left[0] = left[0] - Dyadic(share) * largest - Dyadic(kContactUnits * 0x1p-1074);
    if (left[0].Sign() < 0) return true;
    // c0 + c2 x², where c2 is not positive: up to its root, rounded down.
    Dyadic to = until;
    if (left[2].Sign() < 0) {
      to = std::min(to, Dyadic::Root(Dyadic::Quotient(left[0], -left[2], false), false));
    }
    return to <= from || ExactGap{square, left}.ApartOn(from, to);
  }
};

/// Bodies that are larger by K units touch at the end of what is told to be free, and at its start
/// afterwards; and those that are smaller by as much do not before what is told to be contact, nor
/// after it.
void JudgeWidth(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b,
                const narrow_phase::SegmentResult& verdict, double duration, Outcome* outcome) {
  const BoundGap larger(LargerBy(a, kContactUnits), b, 1), smaller(a, b, -1);
  const double share = kContactUnits * 0x1p-52;
  const auto expect_near = [&](double at, double further) {
    outcome->Expect(larger.LargerTouchAt(share, further) || larger.LargerTouchAt(share, at),
                    Named("not free, though it is,", a, b, at));
  };
  const double until = std::max(0.0, verdict.free_until), from = std::max(0.0, verdict.free_from);
  if (until != numeric::kInfinity) expect_near(until, std::min(duration, until * (1 + 0x1p-50)));
  const double resolution = kContactResolution * duration;
  if (verdict.free_from != -numeric::kInfinity) expect_near(from, std::max(0.0, from - resolution));
  const bool found = verdict.contact_from <= verdict.contact_to;
  const double first = found ? std::max(0.0, verdict.contact_from - resolution) : duration;
  outcome->Expect(smaller.SmallerApartOn(share, Dyadic(), Dyadic(first), Dyadic(duration)),
                  Named("contact is late,", a, b, first));
  const double last = verdict.contact_to + resolution;
  if (!found || last >= duration) return;
  outcome->Expect(smaller.SmallerApartOn(share, Dyadic(last), Dyadic(duration), Dyadic(duration)),
                  Named("contact ends early,", a, b, last));
}

bool IsOrdered(const narrow_phase::SegmentResult& v, double duration) {
  const bool numbers = !std::isnan(v.free_until) && !std::isnan(v.free_from) &&
                       std::isfinite(v.contact_from) && std::isfinite(v.contact_to);
  if (!numbers) return false;
  if (v.free_until != numeric::kInfinity && v.free_until >= duration && duration > 0) return false;
  if (v.contact_from > v.contact_to) return true;
  return v.free_until <= v.contact_from && v.contact_to <= v.free_from && v.contact_from >= 0 &&
         v.contact_to <= duration;
}

}  // namespace

motion::SpaceTimeBound Ball(const Eigen::Vector3d& p, const Eigen::Vector3d& v, double radius,
                            double acceleration_max) {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

void JudgePair(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, Instant from,
               Outcome* outcome, double units_max) {
  const intersection::IntersectionTime time = intersection::EarliestIntersection(a, b, from);
  outcome->Add("pairs", 1);
  outcome->Expect(time.seconds >= 0, Named("not a time", a, b, time.seconds));
  outcome->Expect(time.seconds == intersection::EarliestIntersection(b, a, from).seconds,
                  Named("not the same for (B, A)", a, b, time.seconds));
  if (NeverMoves(a) && NeverMoves(b)) return;
  const ExactMeeting outer(a, b, time.base, {true, 0});
  std::optional<Dyadic> until;
  if (time.seconds != numeric::kInfinity) until = ExactMeeting::Nanoseconds(time.seconds);
  ProofCounts counts;
  outcome->Expect(outer.FreeBefore(until, &counts), Named("late", a, b, time.seconds));
  if (!until) return;
  outcome->Add("meetings", 1);
  const double units = UnitsEarly(a, b, time);
  outcome->Greatest("pair_units_early", units);
  outcome->Expect(units <= units_max,
                  Named(("idle by " + Show(units) + " units").c_str(), a, b, time.seconds));
}

void JudgeContact(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, double duration,
                  Outcome* outcome) {
  const Instant base = a.state.stamp;
  const narrow_phase::SegmentResult verdict =
      narrow_phase::EvaluateBallSegment({a.limits.radius, {ForwardBall(a, base)}},
                                        {b.limits.radius, {ForwardBall(b, base)}}, duration);
  outcome->Add("segments", 1);
  if (!outcome->Expect(IsOrdered(verdict, duration), Named("not ordered", a, b, duration))) return;
  const BoundGap outer(a, b, 1), inner(a, b, -1);
  const Dyadic end(duration);
  const bool throughout = verdict.free_until == numeric::kInfinity;
  if (throughout || verdict.free_until > 0) {
    outcome->Expect(outer.ApartOn(Dyadic(), throughout ? end : Dyadic(verdict.free_until)),
                    Named("late", a, b, verdict.free_until));
  }
  if (throughout) outcome->Expect(outer.ApartAt(end), Named("late at the end", a, b, duration));
  if (verdict.free_from < duration) {
    const Dyadic after(std::max(0.0, verdict.free_from));
    outcome->Expect(outer.ApartAt(end) && !(end <= after) &&
                        outer.ApartOn((after + (end - after).Scaled(-60)), end),
                    Named("not free afterwards", a, b, verdict.free_from));
  }
  if (verdict.contact_from <= verdict.contact_to) {
    outcome->Add("contacts", 1);
    for (const double at : {verdict.contact_from, verdict.contact_to}) {
      outcome->Expect(inner.TouchesAt(at), Named("no contact", a, b, at));
    }
  }
  JudgeWidth(a, b, verdict, duration, outcome);
}

void SayJudged(Outcome* outcome) {
  outcome->Say(Show(outcome->Get("pairs")) + " pairs (" + Show(outcome->Get("meetings")) +
               " that may meet, early by " + Show(outcome->Get("pair_units_early")) +
               " units at most), " + Show(outcome->Get("segments")) + " segments (" +
               Show(outcome->Get("contacts")) + " with contact)");
}

}  // namespace collision::stress

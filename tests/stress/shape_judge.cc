#include "tests/stress/shape_judge.h"

#include <algorithm>
#include <cmath>

#include "tests/support/meshes.h"
#include "tests/support/solids.h"

namespace collision::stress {
namespace {

/// The distance that counts for rounding: where they are, seen from A, and how large.
double ScaleOf(const Body& a, const Body& b) {
  const auto reach = [](const Body& body) {
    return body.shape ? body.shape->facts().radius : body.radius;
  };
  return (b.p - a.p).norm() + reach(a) + reach(b);
}

}  // namespace

motion::SpaceTimeBound Body::Bound() const {
  motion::SpaceTimeBound bound;
  bound.state.p_WA = p;
  bound.state.v_WA = v;
  bound.state.w_WB = w;
  bound.state.q_WB = q;
  bound.limits.radius = shape ? shape->facts().radius : radius;
  bound.limits.angular_acceleration_max = 0;
  return bound;
}

std::shared_ptr<const shape::Shape> BoxShape(const Eigen::Vector3d& half, bool solid) {
  if (solid) return shape::Shape::Compound(nullptr, {SolidBox(-half, half)});
  return shape::Shape::Build(Box(-half, half));
}

narrow_phase::TimeOfContactResult FindContact(const Body& a, const Body& b, double duration,
                                              std::uint64_t units) {
  const narrow_phase::BodyPair pair =
      narrow_phase::SegmentsOf({a.Bound(), {}, a.shape}, {b.Bound(), {}, b.shape}, Instant());
  WorkBudget work(units);
  return TimeOfContact(pair.a, pair.b, duration, {}, &work);
}

void JudgeForm(const narrow_phase::TimeOfContactResult& found, double duration, std::uint64_t units,
               const std::string& what, Outcome* outcome) {
  const numeric::Interval ends[] = {found.begin, found.end};
  for (const numeric::Interval& end : ends) {
    outcome->Expect(end.lower >= 0 && end.lower <= end.upper && end.upper <= duration,
                    what + ": the bracket is not ordered");
  }
  outcome->Expect(found.begin.lower <= found.end.upper, what + ": it ends before it begins");
  outcome->Expect(found.within >= 0, what + ": no distance");
  outcome->Expect(found.work <= units + kBatchUnits, what + ": more work than allowed");
  outcome->Greatest("work_max", static_cast<double>(found.work));
  outcome->Add("queries", 1);
}

void JudgeTimes(const ShapeMeeting& meeting, const std::string& what, Outcome* outcome) {
  const narrow_phase::TimeOfContactResult found =
      FindContact(meeting.a, meeting.b, meeting.duration, kPlenty);
  JudgeForm(found, meeting.duration, kPlenty, what, outcome);
  if (!outcome->Expect(found.status == narrow_phase::ContactStatus::kContact,
                       what + ": contact is not found")) {
    return;
  }
  const auto judge = [&](numeric::Interval bracket, long double truth, const char* which) {
    // The truth itself is known to long double.
    const long double slack = 0x1p-60L * truth;
    outcome->Expect(bracket.lower <= truth + slack && bracket.upper >= truth - slack,
                    what + ": the " + which + " is not in its bracket");
    const double unit = 0x1p-52 * ScaleOf(meeting.a, meeting.b) / meeting.speed +
                        1e-12 * static_cast<double>(truth) / kShapeUnits;
    outcome->Greatest("width_units", bracket.width() / unit);
    outcome->Expect(bracket.width() <= kShapeUnits * unit,
                    what + ": the " + which + "'s bracket is " + Show(bracket.width()) + " s wide");
  };
  judge(found.begin, meeting.begin, "begin");
  judge(found.end, meeting.end, "end");
}

void JudgeStay(const narrow_phase::TimeOfContactResult& found, const Stay& stay,
               const std::string& what, Outcome* outcome) {
  outcome->Expect(found.begin.lower <= stay.begin && found.end.upper >= stay.end,
                  what + ": missed");
  const auto longer =
      static_cast<double>(std::max(stay.begin - found.begin.lower, found.end.upper - stay.end));
  const double most = kShapeUnits * stay.unit + 1e-12 * static_cast<double>(stay.end);
  outcome->Greatest("stay_units", kShapeUnits * longer / most);
  outcome->Expect(longer <= most, what + ": not free for " + Show(longer) + " s before or after");
}

void SayTimes(Outcome* outcome) {
  outcome->Say(Show(outcome->Get("queries")) + " queries, the widest bracket " +
               Show(outcome->Get("width_units")) + " units, " + Show(outcome->Get("work_max")) +
               " units of work at most");
}

}  // namespace collision::stress
